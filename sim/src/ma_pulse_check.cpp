// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/ma_pulse_check.hpp"

#include <algorithm>

namespace mb4::sim {

std::optional<std::string> MaPulseCheck::edge(Time now, bool level, std::uint64_t clocks,
                                              unsigned half_clocks, Time min_clock) {
  if (level == level_) return std::nullopt;
  const bool was = level_;
  const Time width = now - since_;
  const std::uint64_t width_clocks = clocks - since_clocks_;
  const unsigned needed = was ? half_clocks : half_clocks_;
  const bool first = !started_;
  level_ = level;
  started_ = true;
  since_ = now;
  since_clocks_ = clocks;
  half_clocks_ = half_clocks;
  if (first) return std::nullopt;
  ++pulses_;
  shortest_ = std::min(shortest_, width);
  // Clock edges are rounded down to a picosecond: two of them may be one closer.
  const Time needed_ps = std::max(needed * min_clock, required_);
  if (width_clocks >= needed && width + 1 >= needed_ps) return std::nullopt;
  return std::string("short MA pulse: ") + (was ? "high" : "low") + " for " +
         std::to_string(width) + " ps (" + std::to_string(width_clocks) + " clocks) until " +
         std::to_string(now) + " ps, needed are " + std::to_string(needed) + " clocks and " +
         std::to_string(needed_ps) + " ps";
}

}  // namespace mb4::sim
