// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a real cable with its transceivers does to the edges beside delaying them, and what happens
// to it at given times. Plain data: Wire and Line act on it.
#ifndef MB4SIM_CABLE_HPP_
#define MB4SIM_CABLE_HPP_

#include <cstdint>
#include <vector>

#include "mb4sim/time.hpp"

namespace mb4::sim {

// One direction. All zero: an ideal wire.
struct WireFaults {
  // Peak to peak: every edge comes 0 to `jitter` ps later, evenly spread, each on its own. So two
  // edges deviate from one another by at most `jitter`: the quantity of item I305.
  Time jitter = 0;
  // Duty distortion: falling edges come this much later than rising ones; negative: rising later.
  std::int64_t skew = 0;
  // Glitches: the level is inverted for `glitch_width` ps, on average `glitches_per_s` times a
  // second, whatever else is going on. 0 = none.
  std::uint64_t glitches_per_s = 0;
  Time glitch_width = 0;

  bool any() const { return jitter != 0 || skew != 0 || glitches_per_s != 0; }
};

struct CableEvent {
  enum class Action {
    kUnplug,  // both pairs open at the slaves' end: they see MA = 1, the chip sees `open_level`
    kPlug,
    kSlLow,  // pin SL shorted
    kSlHigh,
    kSlFree,
    kMaLow,  // MA shorted at the slaves' end
    kMaHigh,
    kMaFree,
  };
  Time time = 0;
  Action action = Action::kUnplug;
};

struct CableConfig {
  WireFaults ma;           // chip to slaves
  WireFaults sl;           // slaves to chip
  bool open_level = true;  // what the chip's receiver makes of an open SL pair
  std::vector<CableEvent> events;
  // Bus connection: MO is wired to SLI of the last slave, which else is tied to 0.
  bool mo = false;
  Time mo_late = 0;  // edges of MO arrive at the slaves this much later than those of MA, ps
};

}  // namespace mb4::sim

#endif  // MB4SIM_CABLE_HPP_
