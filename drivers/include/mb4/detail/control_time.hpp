// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// How long a control communication may last with a Config. All functions are constexpr.

#ifndef MB4_DETAIL_CONTROL_TIME_HPP_
#define MB4_DETAIL_CONTROL_TIME_HPP_

#include <cstdint>

#include "mb4/config.hpp"

namespace mb4::detail {

// Frames of an access to `count` registers without busy time: 14 with CDM = 0, 18 for the header,
// 14 for each register, one for the last CDS, and two as a reserve. A command needs fewer frames
// than a register.
constexpr std::uint32_t control_frames(std::uint8_t count) {
  return 14U + 18U + 14U * count + 1U + 2U;
}

// The chip's time limit for a slave's answer: 4096 register clocks (pages 30, 34).
constexpr std::uint32_t register_limit_us(const Config& config) {
  return periods_us(config, 4096U * config.register_divider);
}

// Time that a slave may take beyond the frames of its access: Config::register_busy_us, or, if that
// is 0, the chip's limit plus a quarter. The chip then reports nDELAYERR before the driver's time
// is over.
constexpr std::uint32_t register_busy_us(const Config& config) {
  return config.register_busy_us != 0
             ? config.register_busy_us
             : with_spread(config, periods_us(config, 5120U * config.register_divider));
}

// Longest time of an access of BiSS B, which needs no frames: the hand-over, 18 register clocks for
// the address, 14 for each register.
constexpr std::uint32_t biss_b_timeout_us(const Config& config, std::uint8_t count) {
  const std::uint32_t clocks = 5120U + 18U + 14U * count;
  return with_spread(config, periods_us(config, clocks * config.register_divider)) +
         register_busy_us(config) + kFrameMarginUs;
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_CONTROL_TIME_HPP_
