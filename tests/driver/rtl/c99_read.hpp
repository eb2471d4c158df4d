// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A read by mb4_cyclic.h alone, as a program in C makes it.

#ifndef TESTS_DRIVER_RTL_C99_READ_HPP_
#define TESTS_DRIVER_RTL_C99_READ_HPP_

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/mb4.hpp"

namespace mb4test {

inline constexpr std::uint8_t kCounting = MB4_WITH_ALL | MB4_WITH_COUNTS | MB4_WITH_TABLE;

// A read by mb4_cyclic.h alone, with buffers of its own, as a program in C has it.
struct C99Read {
  C99Read() { mb4_plan_memory(&plan, tx.data(), rx.data()); }

  void set_up(const mb4::Config& config) {
    read = {};
    watch = {};
    count = 0;
    for (unsigned slave = 1; slave <= mb4::kSlaves; ++slave) {
      const mb4::SlaveConfig& from = config.slaves[slave - 1];
      if (!from.enabled || from.actuator) continue;
      mb4_slave_config one{};
      one.data_bits = from.data_bits;
      one.crc_polynomial = from.crc_polynomial;
      one.gray = from.gray;
      mb4_word_set(&words[count], static_cast<std::uint8_t>(slave), &one,
                   static_cast<std::uint8_t>(config.spi_check));
      const bool second = slave > 4 && config.channels[1].protocol != mb4::Protocol::kUnused;
      if (config.channels[0].protocol == mb4::Protocol::kBissC) {
        mb4_word_biss_c(&words[count], &one, second ? 2 : 1);
      }
      if (words[count].crc_bits != 0) mb4_crc_table(&words[count], tables[count].data());
      ++count;
    }
    read.words = words.data();
    read.slots = slots.data();
    read.watch = &watch;
    read.count = count;
    read.spi_check = static_cast<std::uint8_t>(config.spi_check);
    read.chain = config.spi_check < mb4::SpiCheck::kFull;
    watch.several = count > 1;
    watch.lines =
        mb4::regs::SL1::kMask |
        (config.channels[1].protocol == mb4::Protocol::kUnused ? 0 : mb4::regs::SL2::kMask);
    const std::uint32_t period_us = config.frame_period_clk / (config.f_clk_hz / 1'000'000U) + 1;
    watch.omitted_us = 2 * period_us + 1;
    watch.silent_us = 16 * period_us + 1;
    watch.held = true;
    watch.counts = &counts;
    counts.period_ns = static_cast<std::uint32_t>(std::uint64_t{config.frame_period_clk} *
                                                  1'000'000'000U / config.f_clk_hz);
    EXPECT_EQ(mb4_cyclic_check(&read, &plan, static_cast<std::uint16_t>(tx.size()), kCounting),
              MB4_OK);
  }
  void started(std::uint32_t now_us) {
    watch.news_us = now_us;
    for (std::uint32_t& good_us : watch.good_us) good_us = now_us;
  }

  // The whole read.
  template <class Bus, class Clock>
  std::uint8_t run(Bus& bus, Clock& clock) {
    mb4_cyclic_plan(&read, &plan, kCounting);
    std::uint8_t code = MB4_MORE;
    do {
      bool done = true;
      for (std::uint8_t i = 0; i < plan.frames && done; ++i) {
        const std::size_t size = plan.size[i];
        done = bus.transfer({mb4_plan_tx(&plan, i), size},
                            {mb4_plan_rx(&plan, i), mb4_plan_reads(&plan, i) ? size : 0U});
      }
      code = mb4_cyclic_finish(&read, &plan, done, clock.now_us(), kCounting);
    } while (code == MB4_MORE);
    return code;
  }

  mb4_cyclic read{};
  mb4_plan plan{};
  mb4_watch watch{};
  mb4_counts counts{};
  std::uint8_t count = 0;
  std::array<mb4_word, mb4::kSlaves> words{};
  std::array<mb4_slot, mb4::kSlaves> slots{};
  std::array<std::array<std::uint32_t, 16>, mb4::kSlaves> tables{};
  std::array<std::uint32_t, MB4_PLAN_WORDS(mb4::kSlaves)> tx{};
  std::array<std::uint32_t, MB4_PLAN_WORDS(mb4::kSlaves)> rx{};
};

}  // namespace mb4test

#endif  // TESTS_DRIVER_RTL_C99_READ_HPP_
