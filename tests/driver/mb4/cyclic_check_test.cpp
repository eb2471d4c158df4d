// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What mb4_cyclic.h is set up with: each slip has an answer. And what it counts when a clock or the
// period is wrong.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <utility>
#include <vector>

#include "mb4_cyclic.h"

namespace {
namespace cyclic_check_test {

// Two slaves on one line, all right.
struct Parts {
  std::array<mb4_word, 2> words{};
  std::array<mb4_slot, 2> slots{};
  mb4_watch watch{};
  mb4_counts counts{};
  mb4_cyclic read{};
  mb4_plan plan{};
  std::array<std::uint32_t, MB4_PLAN_WORDS(2)> tx{};
  std::array<std::uint32_t, MB4_PLAN_WORDS(2)> rx{};
  std::array<std::uint32_t, 16> table{};
  std::uint16_t memory = MB4_PLAN_WORDS(2);
  std::uint8_t with = MB4_WITH_ALL;

  explicit Parts(std::uint8_t count = 2, std::uint8_t check = MB4_SPI_CHECK_CRC) {
    mb4_slave_config slave{};
    slave.data_bits = 28;
    slave.crc_polynomial = 0x43;
    for (std::uint8_t i = 0; i < 2; ++i) {
      mb4_word_set(&words[i], static_cast<std::uint8_t>(i + 1), &slave, check);
    }
    watch.omitted_us = 200;
    watch.silent_us = 1600;
    watch.lines = 1;
    watch.several = count > 1;
    read.words = words.data();
    read.slots = slots.data();
    read.watch = &watch;
    read.count = count;
    read.spi_check = check;
    read.chain = check < MB4_SPI_CHECK_FULL;
    mb4_plan_memory(&plan, tx.data(), rx.data());
  }
  std::uint8_t check() { return mb4_cyclic_check(&read, &plan, memory, with); }
};

TEST(CyclicCheck, RightSetUp_IsAllowedAndTheSlotsAreNotOk) {
  for (const std::uint8_t count : {std::uint8_t{1}, std::uint8_t{2}}) {
    for (const std::uint8_t check :
         std::array<std::uint8_t, 4>{MB4_SPI_CHECK_OFF, MB4_SPI_CHECK_CRC, MB4_SPI_CHECK_FULL,
                                     MB4_SPI_CHECK_FULL_AND_RELEASE}) {
      Parts setup(count, check);
      EXPECT_EQ(setup.check(), MB4_OK);
      for (std::uint8_t i = 0; i < count; ++i) EXPECT_EQ(setup.slots[i].code, MB4_NO_DATA);
    }
  }
  Parts one(1);
  one.with = 0;
  EXPECT_EQ(one.check(), MB4_OK);
}

struct Slip {
  const char* what;
  std::uint8_t code;
  std::function<void(Parts&)> make;
};

TEST(CyclicCheck, EachSlip_HasItsCode) {
  const auto without = [](unsigned part) {
    return static_cast<std::uint8_t>(MB4_WITH_ALL & ~part);
  };
  const std::vector<Slip> slips{
      {"two words without SEVERAL", MB4_UNSUPPORTED,
       [&](Parts& s) { s.with = without(MB4_WITH_SEVERAL); }},
      {"another slave delivers data", MB4_UNSUPPORTED,
       [&](Parts& s) {
         s.read.count = 1;
         s.with = without(MB4_WITH_SEVERAL);
       }},
      {"FULL without FULL", MB4_UNSUPPORTED,
       [&](Parts& s) {
         s = Parts(2, MB4_SPI_CHECK_FULL);
         mb4_plan_memory(&s.plan, s.tx.data(), s.rx.data());
         s.with = without(MB4_WITH_FULL);
       }},
      {"33 bits without LONG", MB4_UNSUPPORTED,
       [&](Parts& s) {
         s.words[1].bits = 33;
         s.with = without(MB4_WITH_LONG);
       }},
      {"Gray code without GRAY", MB4_UNSUPPORTED,
       [&](Parts& s) {
         s.words[0].gray = true;
         s.with = without(MB4_WITH_GRAY);
       }},
      {"unheld without UNHELD", MB4_UNSUPPORTED,
       [&](Parts& s) {
         s.read.chain = false;
         s.read.unheld = true;
         s.with = without(MB4_WITH_UNHELD);
       }},
      {"a table without TABLE", MB4_UNSUPPORTED,
       [&](Parts& s) {
         mb4_crc_table(&s.words[0], s.table.data());
         s.with = without(MB4_WITH_TABLE);
       }},
      {"counts without COUNTS", MB4_UNSUPPORTED,
       [&](Parts& s) {
         s.watch.counts = &s.counts;
         s.with = without(MB4_WITH_COUNTS);
       }},
      {"no words", MB4_INVALID_ARGUMENT, [](Parts& s) { s.read.words = nullptr; }},
      {"no slots", MB4_INVALID_ARGUMENT, [](Parts& s) { s.read.slots = nullptr; }},
      {"no watch", MB4_INVALID_ARGUMENT, [](Parts& s) { s.read.watch = nullptr; }},
      {"no tx", MB4_INVALID_ARGUMENT, [](Parts& s) { s.plan.tx = nullptr; }},
      {"no rx", MB4_INVALID_ARGUMENT, [](Parts& s) { s.plan.rx = nullptr; }},
      {"memory for one", MB4_INVALID_ARGUMENT, [](Parts& s) { s.memory = MB4_PLAN_WORDS(1); }},
      {"tx is rx", MB4_INVALID_ARGUMENT, [](Parts& s) { s.plan.rx = s.plan.tx; }},
      {"tx reaches into rx", MB4_INVALID_ARGUMENT, [](Parts& s) { s.plan.rx = s.plan.tx + 44; }},
      {"no word", MB4_INVALID_CONFIG, [](Parts& s) { s.read.count = 0; }},
      {"nine words", MB4_INVALID_CONFIG,
       [](Parts& s) {
         s.read.count = 9;
         s.memory = MB4_PLAN_WORDS(9);
         static std::array<std::uint32_t, 2 * MB4_PLAN_WORDS(9)> memory;
         mb4_plan_memory(&s.plan, memory.data(), memory.data() + MB4_PLAN_WORDS(9));
       }},
      {"no such check", MB4_INVALID_CONFIG,
       [](Parts& s) {
         s.read.chain = false;
         s.read.spi_check = 4;
       }},
      {"chain with FULL", MB4_INVALID_CONFIG,
       [](Parts& s) { s.read.spi_check = MB4_SPI_CHECK_FULL; }},
      {"chain and unheld", MB4_INVALID_CONFIG, [](Parts& s) { s.read.unheld = true; }},
      {"two words, and not several", MB4_INVALID_CONFIG, [](Parts& s) { s.watch.several = false; }},
      {"no line", MB4_INVALID_CONFIG, [](Parts& s) { s.watch.lines = 0; }},
      {"no such line", MB4_INVALID_CONFIG, [](Parts& s) { s.watch.lines = 2; }},
      {"silent_us forgotten", MB4_INVALID_CONFIG, [](Parts& s) { s.watch.silent_us = 0; }},
      {"omitted_us forgotten", MB4_INVALID_CONFIG, [](Parts& s) { s.watch.omitted_us = 0; }},
      {"period above 1 s", MB4_INVALID_CONFIG,
       [](Parts& s) {
         s.watch = {0, MB4_NEVER, MB4_NEVER, 1, true, false, 0, {}, &s.counts, {}, false};
         s.counts.period_ns = 1'000'000'001;
       }},
      {"limits in periods", MB4_INVALID_CONFIG,
       [](Parts& s) {
         s.watch.counts = &s.counts;
         s.counts.period_ns = 201'000;
       }},
      {"words in the wrong order", MB4_INVALID_CONFIG,
       [](Parts& s) { std::swap(s.words[0], s.words[1]); }},
      {"the same slave twice", MB4_INVALID_CONFIG, [](Parts& s) { s.words[1].slave = 1; }},
      {"slave 0", MB4_INVALID_CONFIG, [](Parts& s) { s.words[0].slave = 0; }},
      {"slave 9", MB4_INVALID_CONFIG, [](Parts& s) { s.words[1].slave = 9; }},
      {"a word that was not set", MB4_INVALID_CONFIG, [](Parts& s) { s.words[1] = {}; }},
      {"65 bits", MB4_INVALID_CONFIG, [](Parts& s) { s.words[1].bits = 65; }},
      {"a CRC of 17 bits", MB4_INVALID_CONFIG, [](Parts& s) { s.words[1].crc_bits = 17; }},
      {"no room for the CRC", MB4_INVALID_CONFIG, [](Parts& s) { s.words[1].bits = 57; }},
      {"a byte too few", MB4_INVALID_CONFIG, [](Parts& s) { s.words[1].bytes = 7; }},
      {"flags of one bit", MB4_INVALID_CONFIG,
       [](Parts& s) {
         s.words[1].bits = 1;
         s.words[1].flags = true;
       }},
  };
  for (const Slip& slip : slips) {
    Parts setup;
    setup.check();
    slip.make(setup);
    EXPECT_EQ(setup.check(), slip.code) << slip.what;
    // Then no read works, with no `with`.
    EXPECT_EQ(mb4_cyclic_finish(&setup.read, &setup.plan, true, 0, setup.with), MB4_UNSUPPORTED)
        << slip.what;
  }
}

// Nobody has called mb4_cyclic_check(), or for other parts.
TEST(CyclicCheck, NotCalled_EachReadIsUnsupported) {
  Parts setup;
  for (const unsigned with : {0U, unsigned{MB4_WITH_SEVERAL}, unsigned{MB4_WITH_ALL}}) {
    EXPECT_EQ(mb4_cyclic_finish(&setup.read, &setup.plan, true, 0, static_cast<std::uint8_t>(with)),
              MB4_UNSUPPORTED);
  }
  ASSERT_EQ(setup.check(), MB4_OK);
  EXPECT_EQ(mb4_cyclic_finish(&setup.read, &setup.plan, true, 0, MB4_WITH_SEVERAL),
            MB4_UNSUPPORTED);
}

// ---- Counts -------------------------------------------------------------------------------------

// A loop with frames of `period_ns` of a clock that is the caller's, or not; sample `n` is ready at
// n periods. Counts what the loop has really lost, and compares.
struct Loop {
  mb4_watch watch{};
  mb4_counts counts{};
  mb4_cyclic read{};
  std::uint64_t begun = 0;
  std::uint64_t seen = 0;
  std::uint64_t lost = 0;

  explicit Loop(std::uint32_t period_ns) {
    read.watch = &watch;
    read.status[0] = 0xFF;
    watch.counts = &counts;
    counts.period_ns = period_ns;
  }
  // A read at `time_ns` of the caller's clock, when `sample` is the last one that has ended.
  void look(double time_ns, std::uint64_t sample) {
    const auto now_us = static_cast<std::uint32_t>(static_cast<std::uint64_t>(time_ns / 1000));
    if (sample == seen) {
      mb4_cyclic_count_read(&read, MB4_NO_DATA, now_us);
      return;
    }
    if (seen != 0) lost += sample - seen - 1;
    seen = sample;
    mb4_cyclic_count_read(&read, MB4_OK, now_us);
  }
};

// One clock makes frames and tells the time. 2 * 10^6 frames, every 123rd read is left out.
TEST(Counts, OneClock_AreExact) {
  Loop loop(62'500);
  for (std::uint64_t i = 1; i <= 2'000'000; ++i) {
    if (i % 123 == 0) continue;
    loop.look(static_cast<double>(i) * 62'500 + 20'000, i);
  }
  EXPECT_EQ(loop.counts.lost, loop.lost);
  EXPECT_GT(loop.lost, 16'000U);
  EXPECT_EQ(loop.counts.doubtful, 0U);
}

// The chip makes the frames and the caller's clock is 50 ppm slower or faster. A loop that ticks
// with its own clock drifts over the frames: every 20,000 periods it meets one frame twice, which
// looks like a lost one, or misses one, which nothing shows.
TEST(Counts, TwoClocks50PpmApart_AreWrongByOneIn20000) {
  constexpr std::int64_t kFrames = 2'000'000;
  for (const double drift : {-50e-6, 50e-6}) {
    Loop loop(62'500);
    for (std::int64_t i = 1; i <= kFrames; ++i) {
      if (i % 123 == 0) continue;
      const double tick_ns = static_cast<double>(i) * 62'500 + 20'000;  // of the caller
      loop.look(tick_ns, static_cast<std::uint64_t>(tick_ns * (1 + drift) / 62'500));
    }
    const std::int64_t error =
        std::int64_t{loop.counts.lost} - static_cast<std::int64_t>(loop.lost);
    EXPECT_LE(std::abs(error), kFrames / 20'000 + 1) << drift;
    EXPECT_GE(std::abs(error), kFrames / 20'000 - 1) << drift;
  }
}

// A wrong period_ns, as 63 us for 62.5 (0.8 %), hides what is lost or counts what is not: by no
// more than `doubtful` says.
TEST(Counts, PeriodWrong_IsDoubtful) {
  for (const std::uint32_t period_ns : {62'000U, 62'400U, 62'450U, 62'550U, 62'600U, 63'000U}) {
    for (const std::uint64_t every : {50U, 123U, 700U, 3000U}) {
      Loop loop(period_ns);
      for (std::uint64_t i = 1; i <= 20'000; ++i) {
        if (i % every == 0) continue;
        loop.look(static_cast<double>(i) * 62'500 + 20'000, i);
      }
      const std::int64_t error =
          std::int64_t{loop.counts.lost} - static_cast<std::int64_t>(loop.lost);
      EXPECT_LE(std::abs(error), loop.counts.doubtful) << period_ns << ", " << every;
      EXPECT_GT(loop.counts.doubtful, 0U) << period_ns << ", " << every;
    }
  }
}

}  // namespace cyclic_check_test
}  // namespace
