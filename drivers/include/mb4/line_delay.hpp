// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The delay of the lines (page 33), as Device::initialize() returns it.

#ifndef MB4_LINE_DELAY_HPP_
#define MB4_LINE_DELAY_HPP_

#include <array>
#include <cstdint>

#include "mb4/config.hpp"

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

}  // namespace mb4

#endif  // MB4_LINE_DELAY_HPP_
