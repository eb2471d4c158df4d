// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The imperfections of one direction of a real cable and its transceivers other than delay. These
// are plain data: Wire applies them.
#ifndef MB4SIM_WIRE_FAULTS_HPP_
#define MB4SIM_WIRE_FAULTS_HPP_

#include <cstdint>

#include "sim/core/time.hpp"

namespace mb4::sim {

// With all members 0 the wire is ideal.
struct WireFaults {
  // Jitter, peak to peak, ps: every edge comes 0 to `jitter` later, evenly spread, independent of
  // the other edges. So two edges deviate from one another by at most `jitter`. This is the
  // quantity of item I305.
  Time jitter = 0;
  // Duty distortion, ps: falling edges come later by this. A negative value delays rising edges.
  std::int64_t skew = 0;
  // Glitches: the level is inverted for `glitch_width` ps, on average `glitches_per_s` times a
  // second, independent of the edges. 0 = none.
  std::uint64_t glitches_per_s = 0;
  Time glitch_width = 0;

  bool any() const { return jitter != 0 || skew != 0 || glitches_per_s != 0; }
};

}  // namespace mb4::sim

#endif  // MB4SIM_WIRE_FAULTS_HPP_
