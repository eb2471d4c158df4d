// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Simulated time: a 64-bit count of picoseconds since power-on.
#ifndef MB4SIM_TIME_HPP_
#define MB4SIM_TIME_HPP_

#include <cstdint>
#include <limits>

namespace mb4::sim {

using Time = std::uint64_t;  // ps

inline constexpr Time kNever = std::numeric_limits<Time>::max();
// End of time (106 days). No wait goes beyond it, so sums with it do not overflow.
inline constexpr Time kEndOfTime = Time{1} << 63U;
inline constexpr Time kPsPerNs = 1000;
inline constexpr Time kPsPerUs = 1'000'000;
inline constexpr Time kPsPerSecond = 1'000'000'000'000;

// Rounds to the nearest picosecond. `ns` must not be negative.
constexpr Time from_ns(double ns) { return static_cast<Time>(ns * 1e3 + 0.5); }
constexpr Time from_us(double us) { return static_cast<Time>(us * 1e6 + 0.5); }
constexpr double to_ns(Time t) { return static_cast<double>(t) / 1e3; }
constexpr double to_us(Time t) { return static_cast<double>(t) / 1e6; }

}  // namespace mb4::sim

#endif  // MB4SIM_TIME_HPP_
