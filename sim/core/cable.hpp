// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The imperfections of a real cable and its transceivers other than delay, and events at given
// times. These are plain data: Wire and Line apply them.
#ifndef MB4SIM_CABLE_HPP_
#define MB4SIM_CABLE_HPP_

#include <cstdint>
#include <vector>

#include "sim/core/time.hpp"

namespace mb4::sim {

// Faults of one direction. With all members 0 the wire is ideal.
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

struct CableEvent {
  enum class Action {
    kUnplug,  // both pairs open at the slaves' end: the slaves see MA = 1, the chip `open_level`
    kPlug,
    kSlLow,  // pin SL shorted
    kSlHigh,
    kSlFree,
    kMaLow,  // MA shorted at the slaves' end
    kMaHigh,
    kMaFree,
  };
  Time time = 0;  // since power-on, ps
  Action action = Action::kUnplug;
};

struct CableConfig {
  WireFaults ma;           // chip to slaves
  WireFaults sl;           // slaves to chip
  bool open_level = true;  // level that the chip's receiver gives for an open SL pair
  std::vector<CableEvent> events;
  // Bus connection: MO is wired to SLI of the last slave. Without it this SLI is tied to 0.
  bool mo = false;
  Time mo_late = 0;  // how much later than MA an edge of MO arrives at the slaves, ps
};

}  // namespace mb4::sim

#endif  // MB4SIM_CABLE_HPP_
