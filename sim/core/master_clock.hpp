// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a line can ask of the clock of its master at each edge that the master makes. Most of it is
// data: an edge of a line is the hot path of the simulator.
#ifndef MB4SIM_MASTER_CLOCK_HPP_
#define MB4SIM_MASTER_CLOCK_HPP_

#include <cstdint>

#include "sim/core/time.hpp"

namespace mb4::sim {

class MasterClock {
 public:
  static constexpr unsigned kBitsOfLine = 2;  // that a master drives on a line, at most

  // Number of rising edges of the system clock so far.
  std::uint64_t cycles() const { return cycles_; }
  // Shortest period that the system clock can have had so far, ps; 0 = unknown.
  Time min_clock() const { return min_clock_; }
  // Half a period of the line's clock in system clocks, as the running or last frame of this line
  // has it.
  virtual unsigned half_clocks(unsigned line) const = 0;
  // True once for each edge of a pin, a bit of LineEnd::drive(), that is none of a pulse: a reset
  // that may cut pulses short has made it.
  bool take_cut(unsigned line, unsigned pin) {
    const std::uint64_t output = std::uint64_t{pin} << (kBitsOfLine * line);
    const bool cut = (cut_ & output) != 0;
    cut_ &= ~output;
    return cut;
  }

 protected:
  ~MasterClock() = default;

  std::uint64_t cycles_ = 0;
  Time min_clock_ = 0;
  std::uint64_t cut_ = 0;  // bits of all lines
};

}  // namespace mb4::sim

#endif  // MB4SIM_MASTER_CLOCK_HPP_
