// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Guards one MA pin of the chip in every simulation. No level may be shorter than half of the
// configured period of MA. It does not matter what shortens it: BREAK, a reset, a change of FREQS
// or of the clock. The simulator calls the guard at every edge and ends the run at a violation. It
// only counts a pulse that a reset cut if the master is built so (MasterClock::take_cut()).
//
// Source: iC-MB4 Rev D2, I302, I303.
#ifndef MB4SIM_MA_PULSE_CHECK_HPP_
#define MB4SIM_MA_PULSE_CHECK_HPP_

#include <cstdint>
#include <string>

#include "sim/core/time.hpp"

namespace mb4::sim {

class MaPulseCheck {
 public:
  // The level after the chip's reset is 1. It may last any time.
  MaPulseCheck() = default;

  // MA changes at `now`.
  //   clocks       rising edges of the system clock so far
  //   half_clocks  configured half period of MA in system clocks
  //   min_clock    shortest period that the system clock may have, ps. 0: not known because pin CLK
  //                is driven by hand; then only clocks are counted
  // A frame takes its configuration before its first falling edge. So a low pulse is compared with
  // the configuration at its beginning, a high pulse with the configuration at its end.
  // Returns one line that describes the violation, valid until the next call; null without one.
  const std::string* edge(Time now, bool level, std::uint64_t clocks, unsigned half_clocks,
                          Time min_clock) {
    if (level == level_) return nullptr;
    const Time width = now - since_;
    const std::uint64_t width_clocks = clocks - since_clocks_;
    // A high level needs the present configuration, a low level that of its beginning.
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
    // Clock edges are rounded down to a picosecond, so two of them may be 1 ps closer.
    const Time needed_ps = needed * min_clock < required_ ? required_ : needed * min_clock;
    if (width_clocks >= needed && width + 1 >= needed_ps) return nullptr;
    return describe(width, width_clocks, needed, needed_ps);
  }

  // MA gets this level for another reason than a pulse: the beginning of the level is not known.
  void restart(bool level) {
    level_ = level;
    started_ = false;
  }

  // Adds a limit from now on: no level may be shorter than `minimum` ps. It can be what the
  // encoders on the line can follow. 0 = none.
  void require(Time minimum) { required_ = minimum; }

  // Shortest pulse so far in ps; kNever before the first pulse.
  Time shortest() const { return shortest_; }
  // The level that has just ended was too short because a reset cut it, and the master says that
  // its reset does so.
  void count_cut() { ++cut_; }
  std::uint64_t cut() const { return cut_; }
  // Number of pulses checked.
  std::uint64_t pulses() const { return pulses_; }

 private:
  const std::string* describe(Time width, std::uint64_t clocks, unsigned needed, Time needed_ps);

  bool level_ = true;
  bool started_ = false;  // an edge has come
  Time since_ = 0;
  std::uint64_t since_clocks_ = 0;
  unsigned half_clocks_ = 0;  // configured when the level began
  Time required_ = 0;
  Time shortest_ = kNever;
  std::uint64_t pulses_ = 0;
  std::uint64_t cut_ = 0;
  std::string violation_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_MA_PULSE_CHECK_HPP_
