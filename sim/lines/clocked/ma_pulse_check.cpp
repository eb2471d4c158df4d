// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/clocked/ma_pulse_check.hpp"

namespace mb4::sim {

// Describes the pulse that has just ended.
const std::string* MaPulseCheck::describe(Time width, std::uint64_t clocks, unsigned needed,
                                          Time needed_ps) {
  violation_ = std::string("short MA pulse: ") + (level_ ? "low" : "high") + " for " +
               std::to_string(width) + " ps (" + std::to_string(clocks) + " clocks) until " +
               std::to_string(since_) + " ps, needed are " + std::to_string(needed) +
               " clocks and " + std::to_string(needed_ps) + " ps";
  return &violation_;
}

}  // namespace mb4::sim
