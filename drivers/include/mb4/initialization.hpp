// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Layer 3: INIT, which makes the slaves ready and measures the line delay in BiSS C (pages 32, 33).

#ifndef MB4_INITIALIZATION_HPP_
#define MB4_INITIALIZATION_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/checked_registers.hpp"
#include "mb4/chip.hpp"
#include "mb4/config.hpp"
#include "mb4/control_data.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// The delay that INIT measures, from the second rising edge of MA to the falling edge of SL, in
// quarters of a period of MA (page 33). 0 for a channel that is not in use, for SSI, and if no
// channel is BiSS C.
struct LineDelay {
  std::array<std::uint8_t, kChannels> quarters{};  // [0] is channel 1
};

// The measured delay in nanoseconds. 4 * ma_hz quarters are one second. The measurement has a
// resolution of one quarter: the real delay is at most this value and more than this value minus
// one quarter. For a valid `config`.
[[nodiscard]] constexpr std::uint32_t line_delay_ns(const Config& config, std::uint8_t quarters) {
  // Both factors are divided by 16 to fit 32 bits: 255 * 250'000'000 does not fit.
  return quarters * 15'625'000U / (config.ma_hz / 16U);
}

// Used through Device::initialize(), which documents the errors.
template <typename Bus, typename Clock>
class Initialization {
 public:
  explicit constexpr Initialization(detail::Chip<Bus, Clock>& chip) : chip_(chip) {}

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
      done = chip_.clear_valid_checked(chip_.sensors);
    }
    chip_.recover_first = !done;
    return done;
  }

 private:
  // A register access may have left another protocol in REGVERS.
  Result<void> set_protocol() {
    const std::uint8_t control = detail::encode_ctrl(chip_.config, only_biss_b(chip_.config));
    return any_channel_is(chip_.config, Protocol::kBissB)
               ? detail::write_checked(chip_, regs::kAddrCtrl,
                                       Span<const std::uint8_t>(&control, 1))
               : Result<void>();
  }

  Result<void> write_zero(std::uint8_t address) {
    constexpr std::uint8_t kZero = 0;
    return chip_.opcodes.write_registers(address, Span<const std::uint8_t>(&kZero, 1));
  }

  // SCDATA1 and SCDATA5 (page 33) of the channels that INIT has measured.
  Result<void> read_delay(unsigned channel, std::uint8_t& quarters) {
    constexpr unsigned kSlavesOfChannel = kSlaves / kChannels;
    const Protocol protocol = chip_.config.channels[channel].protocol;
    if (!measures() || protocol == Protocol::kUnused || protocol == Protocol::kSsi) {
      return {};
    }
    const Result<void> read =
        detail::read_checked(chip_, regs::scdata_address(1 + channel * kSlavesOfChannel),
                             Span<std::uint8_t>(&quarters, 1));
    // An ideal line and slave give 1.
    return read && quarters == 0 ? Error::kNoData : read;
  }

  [[nodiscard]] bool measures() const { return any_channel_is(chip_.config, Protocol::kBissC); }

  // Longest time of INIT: the limits of the delay and of the slaves' timeout (docs/choices.md), or,
  // without BiSS C, the limit of the hand-over.
  [[nodiscard]] std::uint32_t timeout_us() const {
    constexpr std::uint32_t kPeriods = 255 + 64 + 1024;
    const Config& config = chip_.config;
    const std::uint32_t us =
        measures() ? detail::periods_us(config, kPeriods) : detail::register_limit_us(config);
    return detail::with_spread(config, us) + kFrameMarginUs;
  }

  Result<void> wait() {
    detail::Deadline<Clock> deadline(*chip_.clock, timeout_us());
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      Status status;
      if (const Result<void> look = chip_.look(status); !look) {
        return look;
      }
      if (status.idle() && status.get<regs::INIT>() == 0) {
        // INIT has set the flags to 1 at its beginning.
        if (status.start_error()) {
          return measures() ? Error::kLineDelay : Error::kLineError;
        }
        // INIT also ends with a line that is stuck low (page 33), so the line is checked here. In
        // BiSS B the slaves are in register mode now and first need their timeout.
        if (!measures()) {
          detail::pause(*chip_.clock, chip_.recovery_us());
        }
        return chip_.diagnose_line();
      }
    }
    return chip_.stop_frame(Error::kTimeout);
  }

  detail::Chip<Bus, Clock>& chip_;
};

}  // namespace mb4

#endif  // MB4_INITIALIZATION_HPP_
