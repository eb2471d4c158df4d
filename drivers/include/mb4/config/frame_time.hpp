// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// How long a frame lasts with a Config. All functions are constexpr.

#ifndef MB4_CONFIG_FRAME_TIME_HPP_
#define MB4_CONFIG_FRAME_TIME_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/config/members.hpp"
#include "mb4/config/slaves.hpp"
#include "mb4/crc.hpp"

namespace mb4 {

namespace detail {

// As frame_periods(), for one channel (1 or 2).
[[gnu::noinline]] constexpr std::uint32_t channel_periods(const Config& config,
                                                          std::uint8_t channel) {
  const Protocol protocol = config.channels[channel - 1U].protocol;
  std::uint32_t periods = 5U + config.mo_busy;
  if (protocol != Protocol::kBissC) {
    periods = protocol == Protocol::kSsi ? 1U : 4U + config.mo_busy;
  }
  for (std::size_t slave = 1; slave <= kSlaves; ++slave) {
    const SlaveConfig& one = config.slaves[slave - 1];
    if (one.enabled && channel_of(config, slave) == channel) {
      periods += one.data_bits + std::uint32_t{crc_width_bits(one.crc_polynomial)};
      periods += one.actuator && one.stop_bit ? 1U : 0U;
    }
  }
  return periods;
}

}  // namespace detail

// Periods of MA in a frame without processing time, for the channel with the longer frame. A frame
// has 5 periods in BiSS C (acknowledge, start, CDS), 4 in BiSS B (no CDS), 1 in SSI. Data, CRC and
// an actuator's stop bit are added, and in BiSS MO_BUSY.
[[nodiscard]] constexpr std::uint32_t frame_periods(const Config& config) {
  const std::uint32_t first = detail::channel_periods(config, 1);
  const std::uint32_t second = detail::channel_periods(config, 2);
  return first > second ? first : second;
}

// The calculated timeout adds this time to the MA periods of the frame. It covers the slaves'
// timeout of the previous frame (up to 40 us), the slave's processing time, the line delay and the
// SPI transfers.
inline constexpr std::uint32_t kFrameMarginUs = 200;

namespace detail {

// Adds the spread of the internal oscillator, which may run at 10 MHz while f_clk_hz says 25 MHz
// (D05).
[[gnu::noinline]] constexpr std::uint32_t with_spread(const Config& config, std::uint32_t time) {
  return config.clock_source == ClockSource::kInternal ? 3 * time : time;
}

// Converts up to 4 million periods of MA to microseconds, rounded up. It does without a division of
// 64 bits, which costs 1 KB on a small core.
[[gnu::noinline]] constexpr std::uint32_t periods_us(const Config& config, std::uint32_t periods) {
  return periods * 1000U / (config.ma_hz / 1000U) + 1U;
}

}  // namespace detail

// The timeout of a frame in microseconds: Config::frame_timeout_us, or, if that is 0, the time of
// the frame plus kFrameMarginUs. For a valid `config`.
[[nodiscard]] constexpr std::uint32_t frame_timeout_us(const Config& config) {
  if (config.frame_timeout_us != 0) {
    return config.frame_timeout_us;
  }
  // Eight slaves need at most 908 * 3 periods; 2'724'000'000 fits 32 bits.
  return detail::with_spread(config, frame_periods(config)) * 1'000'000U / config.ma_hz + 1 +
         kFrameMarginUs;
}

namespace detail {

// Longest time from one automatic frame to the next, in microseconds. With FrameStart::kOnPin the
// pulses at the pin decide: without Config::pin_period_us the function returns the timeout of a
// frame.
constexpr std::uint32_t frame_pitch_us(const Config& config) {
  if (config.pin_period_us != 0) {
    return config.pin_period_us;
  }
  return config.frame_start != FrameStart::kPeriodic
             ? frame_timeout_us(config)
             : with_spread(config, config.frame_period_clk / (config.f_clk_hz / 1'000'000U) + 1U);
}

}  // namespace detail
}  // namespace mb4

#endif  // MB4_CONFIG_FRAME_TIME_HPP_
