// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Guards one MA pin of the chip in every simulation: no level may be shorter than half of the
// configured period of MA (iC-MB4 Rev D2, I302, I303), whatever cuts it: BREAK, a reset, a change
// of FREQS or of the clock. The simulator asks it at every edge and ends the run on a violation.
#ifndef MB4SIM_MA_PULSE_CHECK_HPP_
#define MB4SIM_MA_PULSE_CHECK_HPP_

#include <cstdint>
#include <string>

#include "mb4sim/time.hpp"

namespace mb4::sim {

class MaPulseCheck {
 public:
  // Level after the chip's reset: 1, for as long as one likes.
  MaPulseCheck() = default;

  // MA changes at `now`. `clocks`: rising system clock edges so far. `half_clocks`: configured half
  // period in system clocks. `min_clock`: shortest period that the system clock may have, ps; 0 if
  // it is not known (pin CLK driven by hand), then only clocks are counted. A frame takes its
  // configuration before its first falling edge: a low pulse is held against what was configured
  // when it began, a high one against what is configured when it ends.
  // Returns one line that says what is wrong, kept until the next call; null if nothing is.
  const std::string* edge(Time now, bool level, std::uint64_t clocks, unsigned half_clocks,
                          Time min_clock) {
    if (level == level_) return nullptr;
    const Time width = now - since_;
    const std::uint64_t width_clocks = clocks - since_clocks_;
    // Of a high level what is configured now, of a low one what was when it began.
    const unsigned needed = level ? half_clocks_ : half_clocks;
    const bool first = !started_;
    level_ = level;
    started_ = true;
    since_ = now;
    since_clocks_ = clocks;
    half_clocks_ = half_clocks;
    if (first) return nullptr;
    ++pulses_;
    shortest_ = width < shortest_ ? width : shortest_;
    // Clock edges are rounded down to a picosecond: two of them may be one closer.
    const Time needed_ps = needed * min_clock < required_ ? required_ : needed * min_clock;
    if (width_clocks >= needed && width + 1 >= needed_ps) return nullptr;
    return describe(width, width_clocks, needed, needed_ps);
  }

  // MA has this level for another reason than a pulse: the level's beginning is not known.
  void restart(bool level) {
    level_ = level;
    started_ = false;
  }

  // A limit beside it from now on: no level shorter than `minimum` ps, say what the encoders on the
  // line can follow. 0 = none.
  void require(Time minimum) { required_ = minimum; }

  // Shortest pulse so far in ps; kNever before there was one.
  Time shortest() const { return shortest_; }
  // Pulses looked at.
  std::uint64_t pulses() const { return pulses_; }

 private:
  const std::string* describe(Time width, std::uint64_t clocks, unsigned needed, Time needed_ps);

  bool level_ = true;
  bool started_ = false;  // there was an edge
  Time since_ = 0;
  std::uint64_t since_clocks_ = 0;
  unsigned half_clocks_ = 0;  // configured when the level began
  Time required_ = 0;
  Time shortest_ = kNever;
  std::uint64_t pulses_ = 0;
  std::string violation_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_MA_PULSE_CHECK_HPP_
