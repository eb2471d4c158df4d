// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Writes the words of actuators (pages 15, 25, 31).

#ifndef MB4_DETAIL_ACTUATOR_WRITE_HPP_
#define MB4_DETAIL_ACTUATOR_WRITE_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/detail/checked_registers.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

// Used through Device::write_actuator() and Automatic::write_actuator(), which document the errors.
//
// A frame sends the word in the chip's bank. The host writes into the other bank, and each end of a
// frame switches the banks. So a word that is to stay must be written to both banks:
//  * Without automatic frames no frame switches the banks; the driver does it with SWBANK.
//  * With automatic frames the driver writes each bank under HOLDBANK, so that no frame sends half
//    a word. It writes the second bank when the end of a frame has switched the banks. It sees this
//    when it reads another word than it has written.
template <typename Bus, typename Clock>
class ActuatorWrite {
 public:
  explicit constexpr ActuatorWrite(Chip<Bus, Clock>& chip) : chip_(chip) {}

  // The chip must be configured, and no control communication may run. `both_banks` = false: with
  // automatic frames only the host's bank is written.
  Result<void> write(std::uint8_t slave, std::uint64_t word, bool both_banks) {
    if (!is_in(chip_.actuators, slave)) {
      return Error::kInvalidArgument;
    }
    std::array<std::uint8_t, regs::kScdataStride> bytes{};
    unsigned bits_left = chip_.config.slaves[slave - 1U].data_bits;
    for (std::uint8_t& byte : bytes) {
      byte = static_cast<std::uint8_t>(word);
      word >>= 8;
      if (bits_left < 8 && byte >> bits_left != 0) {
        return Error::kInvalidArgument;
      }
      bits_left -= bits_left < 8 ? bits_left : 8;
    }
    const Span<const std::uint8_t> used(bytes.data(), data_bytes(chip_.config.slaves[slave - 1U]));
    const std::uint8_t address = regs::scdata_address(slave);
    if (!chip_.automatic) {
      return write_both(address, used);
    }
    const Result<void> written = write_held(address, used);
    return written && both_banks ? write_other(address, used) : written;
  }

 private:
  static constexpr std::uint8_t kAgs = regs::AGS::encode<1>();

  Result<void> write_held(std::uint8_t address, Span<const std::uint8_t> bytes) {
    Result<void> written = instruct(kHoldAndAgs);
    if (written) {
      written = write_checked(chip_, address, bytes);
    }
    Result<void> released = chip_.write_instruction(kAgs);
    // What has waited in a bank that an earlier call could not release is old. No bank was switched
    // meanwhile, so nobody could see frames.
    if (released && chip_.watch.held) {
      released = chip_.clear_valid(chip_.sensor_flags);
      chip_.watch.news_us = chip_.clock->now_us();
    }
    chip_.watch.held = !released;
    return written ? released : written;
  }

  // Reads until the word differs, which shows the other bank, and writes this bank. If no reading
  // differs, both banks hold the word.
  Result<void> write_other(std::uint8_t address, Span<const std::uint8_t> bytes) {
    Deadline<Clock> deadline(*chip_.clock, chip_.frame_us + chip_.pitch_us);
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      // Deadline counts a poll as five cycles of the parallel bus; a word may have one byte.
      for (unsigned readings = 5; readings > 0; --readings) {
        const Result<void> same = compare_registers(chip_, address, bytes);
        if (!same) {
          return same.error() == Error::kCorrupted ? write_held(address, bytes) : same;
        }
      }
    }
    return {};
  }

  Result<void> write_both(std::uint8_t address, Span<const std::uint8_t> bytes) {
    if (chip_.recover_first) {
      if (const Result<void> recovered = chip_.recover(); !recovered) {
        return recovered;
      }
    }
    chip_.recover_first = true;
    // Each change of SWBANK switches the banks (page 33). After two changes SWBANK is 0 again.
    for (const std::uint8_t next : {regs::SWBANK::encode<1>(), std::uint8_t{0}}) {
      Result<void> done = write_checked(chip_, address, bytes);
      if (chip_.config.single_bank) {
        chip_.recover_first = !done;
        return done;
      }
      done = done ? instruct(next) : done;
      if (!done) {
        return done;
      }
      // The switch takes some system clocks, each at most 1 us.
      pause(*chip_.clock, kSwitchUs);
    }
    chip_.recover_first = false;
    return {};
  }

  Result<void> instruct(std::uint8_t instruction) {
    const Result<void> written = chip_.write_instruction(instruction);
    return written ? chip_.confirm_instruction(instruction) : written;
  }

  static constexpr std::uint32_t kSwitchUs = 10;

  Chip<Bus, Clock>& chip_;
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_ACTUATOR_WRITE_HPP_
