// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Reads of positions in steps, without bus and clock.

#ifndef MB4_DETAIL_READS_HPP_
#define MB4_DETAIL_READS_HPP_

#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/cyclic.hpp"
#include "mb4/detail/chip_state.hpp"
#include "mb4/result.hpp"

namespace mb4::detail {

// Automatic documents the calls and their errors.
struct Reads {
  // Of one slave. `With`: the parts that the caller's code has.
  template <std::uint8_t With>
  static Result<void> plan(ChipState& chip, CyclicRead& read, std::uint8_t slave, bool chain) {
    const Result<void> allowed = begin(chip, read, slave, chain, With);
    if (allowed) {
      mb4_cyclic_plan(&read.read_, &read.plan_, With);
    }
    return allowed;
  }
  [[gnu::noinline]] static Result<void> begin(ChipState& chip, CyclicRead& read, std::uint8_t slave,
                                              bool chain, std::uint8_t with) {
    read.code_ = MB4_NO_DATA;
    if (!is_in(chip.sensors, slave)) {
      return Error::kInvalidArgument;
    }
    if (const Result<void> allowed = chip.read_allowed(); !allowed) {
      return allowed;
    }
    if ((chip.needs & ~unsigned{with}) != 0) {
      return Error::kUnsupported;
    }
    begin(chip, read, chip.word_of(slave), 1, chain, with);
    return {};
  }

  // Of all sensors. `wide`: SPI frames of up to 66 bytes.
  static Result<void> begin(ChipState& chip, FrameRead& read, bool chain, bool wide) {
    read.read_.built = read.read_.wide == wide ? read.read_.built : nullptr;
    read.read_.wide = wide;
    read.code_ = MB4_NO_DATA;
    read.read_.told = false;
    if (const Result<void> allowed = chip.read_allowed(); !allowed) {
      return allowed;
    }
    begin(chip, read, chip.words.data(), chip.count, chain, MB4_WITH_ALL);
    mb4_cyclic_plan(&read.read_, &read.plan_, MB4_WITH_ALL);
    return {};
  }

  template <std::uint8_t With>
  [[gnu::noinline]] static bool take(ChipState& chip, ReadSteps& steps, bool transferred,
                                     std::uint32_t now_us) {
    steps.code_ = mb4_cyclic_finish(&steps.read_, &steps.plan_, transferred, now_us, With);
    if (steps.code_ == MB4_MORE) {
      return false;
    }
    if (steps.code_ == MB4_UNSUPPORTED) {
      // Parts that the plan needs may not be here. The next read releases the bank.
      chip.watch.held = true;
      return true;
    }
    chip.control.seen_running = steps.read_.running;
    // A disturbed byte of 0xF4 with another INSTR may have started an access that nobody asked for.
    if ((With & MB4_WITH_FULL) != 0 &&
        (steps.code_ == MB4_CORRUPTED || (chip.proves_release() && chip.watch.held))) {
      chip.control.stray = true;
    }
    return true;
  }

  static Result<void> crc_table(ChipState& chip, std::uint8_t slave, std::uint32_t* table) {
    if (!chip.configured) {
      return Error::kNotConfigured;
    }
    for (std::uint8_t i = 0; i < chip.count; ++i) {
      if (chip.words[i].slave == slave && chip.words[i].crc_bits != 0) {
        mb4_crc_table(&chip.words[i], table);
        chip.needs |= MB4_WITH_TABLE;
        return {};
      }
    }
    return Error::kInvalidArgument;
  }

  template <std::uint8_t With>
  static bool finish(ChipState& chip, CyclicRead& read, bool transferred, std::uint32_t now_us) {
    if (!take<With>(chip, read, transferred, now_us)) {
      return false;
    }
    if (has_reading(read.code_)) {
      mb4_slot_reading(read.read_.words, &read.slot_, &read.reading_, With);
    }
    return true;
  }

 private:
  static void begin(ChipState& chip, ReadSteps& steps, const mb4_word* words, std::uint8_t count,
                    bool chain, std::uint8_t with) {
    mb4_cyclic& read = steps.read_;
    const bool unheld = chip.control_runs() && !chip.config.hold_beside_access;
    chain = chain && !unheld;
    // The frames of the plan depend on this alone. So a plan of another configuration, or of a
    // Device that was made anew at the same place, is not taken for one of this.
    std::uint32_t shape = 0;
    for (std::uint8_t i = 0; i < count; ++i) {
      shape |= std::uint32_t{words[i].bytes} << (4U * (words[i].slave - 1U));
    }
    if (steps.shape_ != shape || read.chain != chain) {
      read.built = nullptr;
    }
    steps.shape_ = shape;
    read.parts = mb4_cyclic_parts(with);  // the configuration has been checked
    read.words = words;
    read.count = count;
    read.watch = &chip.watch;
    read.spi_check = static_cast<std::uint8_t>(chip.config.spi_check);
    read.unheld = unheld;
    read.access = chip.control_runs() || (chip.checks_all() && chip.control.waits);
    read.chain = chain;
  }
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_READS_HPP_
