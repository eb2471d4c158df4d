// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// INIT, which makes the slaves ready and measures the line delay in BiSS C (pages 32, 33).

#ifndef MB4_DETAIL_INITIALIZATION_HPP_
#define MB4_DETAIL_INITIALIZATION_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/config.hpp"
#include "mb4/detail/checked_registers.hpp"
#include "mb4/detail/chip.hpp"
#include "mb4/detail/control_time.hpp"
#include "mb4/line_delay.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

// INIT measures something.
[[nodiscard]] inline bool measures(const ChipState& chip) {
  return any_channel_is(chip.config, Protocol::kBissC);
}
// It measures `channel` (0, 1).
[[nodiscard]] inline bool measures(const ChipState& chip, unsigned channel) {
  const Protocol protocol = chip.config.channels[channel].protocol;
  return measures(chip) && protocol != Protocol::kUnused && protocol != Protocol::kSsi;
}

// Longest time of INIT: the limits of the delay and of the slaves' timeout (docs/choices.md), or,
// without BiSS C, the limit of the hand-over.
[[nodiscard]] inline std::uint32_t initialization_us(const ChipState& chip) {
  constexpr std::uint32_t kPeriods = 255 + 64 + 1024;
  const Config& config = chip.config;
  const std::uint32_t us =
      measures(chip) ? periods_us(config, kPeriods) : register_limit_us(config);
  return with_spread(config, us) + kFrameMarginUs;
}

// Used through Device::initialize(), which documents the errors.
template <typename Bus, typename Clock>
class Initialization {
 public:
  explicit constexpr Initialization(Chip<Bus, Clock>& chip) : chip_(chip) {}

  // The chip must be configured, and no frames and no control communication may run.
  Result<void> run(LineDelay& delay) {
    if (chip_.recover_first) {
      if (const Result<void> recovered = chip_.recover(); !recovered) {
        return recovered;
      }
    }
    chip_.recover_first = true;
    // SCDATA1 and SCDATA5 become 0, so that an old value cannot look like a new one.
    Result<void> done = write_zero(regs::scdata_address(1));
    if (done) {
      done = write_zero(regs::scdata_address(5));
    }
    if (done) {
      done = set_protocol();
    }
    if (done) {
      done = chip_.write_instruction(regs::INIT::encode<1>());
    }
    if (done) {
      done = wait();
    }
    for (unsigned channel = 0; done && channel < kChannels; ++channel) {
      done = read_delay(channel, delay.quarters[channel]);
    }
    if (done) {
      done = chip_.clear_valid_checked(chip_.sensor_flags);
    }
    chip_.recover_first = !done;
    return done;
  }

 private:
  // A register access may have left another protocol in REGVERS.
  Result<void> set_protocol() {
    const std::uint8_t control = encode_ctrl(chip_.config, only_biss_b(chip_.config));
    return any_channel_is(chip_.config, Protocol::kBissB)
               ? write_checked(chip_, regs::kAddrCtrl, Span<const std::uint8_t>(&control, 1))
               : Result<void>();
  }

  Result<void> write_zero(std::uint8_t address) {
    constexpr std::uint8_t kZero = 0;
    return chip_.opcodes.write_registers(address, Span<const std::uint8_t>(&kZero, 1));
  }

  // SCDATA1 and SCDATA5 (page 33) of the channels that INIT has measured.
  Result<void> read_delay(unsigned channel, std::uint8_t& quarters) {
    constexpr unsigned kSlavesOfChannel = kSlaves / kChannels;
    if (!measures(chip_, channel)) {
      return {};
    }
    const Result<void> read =
        read_checked(chip_, regs::scdata_address(1 + channel * kSlavesOfChannel),
                     Span<std::uint8_t>(&quarters, 1));
    // An ideal line and slave give 1.
    return read && quarters == 0 ? Error::kNoData : read;
  }

  Result<void> wait() {
    Deadline<Clock> deadline(*chip_.clock, initialization_us(chip_));
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      Status status;
      if (const Result<void> look = chip_.look(status); !look) {
        return look;
      }
      if (status.idle() && status.get<regs::INIT>() == 0) {
        // INIT has set the flags to 1 at its beginning.
        if (status.start_error()) {
          return measures(chip_) ? Error::kLineDelay : Error::kLineError;
        }
        // INIT also ends with a line that is stuck low (page 33), so the line is checked here. In
        // BiSS B the slaves are in register mode now and first need their timeout.
        if (!measures(chip_)) {
          pause(*chip_.clock, chip_.recovery_us());
        }
        return chip_.diagnose_line();
      }
    }
    return chip_.stop_frame(Error::kTimeout);
  }

  Chip<Bus, Clock>& chip_;
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_INITIALIZATION_HPP_
