// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Layer 3: INIT of BiSS C, which makes the slaves ready and measures the lines (pages 32, 33).

#ifndef MB4_INITIALIZATION_HPP_
#define MB4_INITIALIZATION_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/chip.hpp"
#include "mb4/config.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// What INIT has measured: from the second rising edge of MA to the falling edge of SL, in quarters
// of a period of MA (page 33). 0 for a channel that is not in use.
struct LineDelay {
  std::array<std::uint8_t, kChannels> quarters{};  // [0] is channel 1
};

// The same in nanoseconds, rounded down: 4 * ma_hz quarters are a second. The measurement is
// coarse: the delay is at most this and more than one quarter less. For a valid `config`.
[[nodiscard]] constexpr std::uint32_t line_delay_ns(const Config& config, std::uint8_t quarters) {
  // Two steps, so that 32 bits do: 255 * 250'000'000 does not fit.
  const std::uint32_t quarter_ns = 250'000'000U / config.ma_hz;
  const std::uint32_t rest = 250'000'000U % config.ma_hz;
  return quarters * quarter_ns + quarters * (rest / 256U) / (config.ma_hz / 256U);
}

// Used through Device::initialize(), which documents the errors.
template <typename Bus, typename Clock>
class Initialization {
 public:
  explicit constexpr Initialization(detail::Chip<Bus, Clock>& chip) : chip_(chip) {}

  // The chip is configured, and nothing runs that may.
  Result<LineDelay> run() {
    if (chip_.recover_first) {
      if (const Result<void> recovered = chip_.recover(); !recovered) {
        return recovered.info();
      }
    }
    chip_.recover_first = true;
    if (const Result<void> emptied = empty(); !emptied) {
      return emptied.info();
    }
    if (const Result<void> begun = chip_.write_instruction(regs::INIT::encode<1>()); !begun) {
      return begun.info();
    }
    const Result<void> ended = wait();
    if (!ended) {
      return ended.info();
    }
    LineDelay delay;
    for (unsigned channel = 0; channel < kChannels; ++channel) {
      constexpr unsigned kSlavesOfChannel = kSlaves / kChannels;
      if (chip_.config.channels[channel].protocol == Protocol::kUnused) {
        continue;
      }
      // SCDATA1 and SCDATA5 (page 33).
      const Result<std::uint8_t> quarters =
          read_twice(regs::scdata_address(1 + channel * kSlavesOfChannel));
      if (!quarters) {
        return quarters.info();
      }
      // An ideal line and slave give 1.
      if (*quarters == 0) {
        return Error::kNoData;
      }
      delay.quarters[channel] = *quarters;
    }
    if (const Result<void> cleared = chip_.clear_valid_checked(enabled_slaves(chip_.config));
        !cleared) {
      return cleared.info();
    }
    chip_.recover_first = false;
    return delay;
  }

 private:
  // SCDATA1 and SCDATA5 = 0, so that an old figure cannot pass for a new one.
  Result<void> empty() {
    constexpr std::uint8_t kZero = 0;
    for (const unsigned slave : {1U, 5U}) {
      if (const Result<void> written = chip_.opcodes.write_registers(
              regs::scdata_address(slave), Span<const std::uint8_t>(&kZero, 1));
          !written) {
        return written;
      }
    }
    return {};
  }

  // The limit of the delay, and of the slaves' timeout after it (docs/choices.md); three times as
  // long with the internal oscillator (D05).
  [[nodiscard]] std::uint32_t timeout_us() const {
    constexpr std::uint32_t kPeriods = 255 + 64 + 1024;
    const std::uint32_t factor = chip_.config.clock_source == ClockSource::kInternal ? 3 : 1;
    return kPeriods * factor * (1'000'000'000U / chip_.config.ma_hz) / 1000 + kFrameMarginUs;
  }

  Result<void> wait() {
    detail::Deadline<Clock> deadline(*chip_.clock, timeout_us());
    for (bool last = false; !last;) {
      last = deadline.last_poll();
      const Result<Status> status = chip_.read_status();
      if (!status) {
        return status.info();
      }
      if (status->idle() && status->get<regs::INIT>() == 0) {
        // INIT has set the flags to 1 at its beginning.
        if (status->start_error()) {
          return Error::kLineDelay;
        }
        // INIT goes by with a line that is stuck low, too (page 33).
        const ErrorInfo line = chip_.diagnose_line();
        return line.code == Error::kTimeout ? Result<void>() : Result<void>(line);
      }
    }
    return chip_.stop_frame(Error::kTimeout);
  }

  Result<std::uint8_t> read_twice(std::uint8_t address) {
    std::uint8_t bytes[2] = {0, 0};
    const unsigned looks = chip_.checks_all() ? 2 : 1;
    for (unsigned look = 0; look < looks; ++look) {
      if (const Result<void> read =
              chip_.opcodes.read_registers(address, Span<std::uint8_t>(&bytes[look], 1));
          !read) {
        return read.info();
      }
    }
    return looks == 2 && bytes[0] != bytes[1] ? Result<std::uint8_t>(Error::kCorrupted)
                                              : Result<std::uint8_t>(bytes[0]);
  }

  detail::Chip<Bus, Clock>& chip_;
};

}  // namespace mb4

#endif  // MB4_INITIALIZATION_HPP_
