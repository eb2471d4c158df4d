// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The loop over the edges of a master's clocks, which all masters with a clock share. It ends with
// the first edge that changes an output, because others wait for that.
#ifndef MB4SIM_MODEL_CLOCK_LOOP_HPP_
#define MB4SIM_MODEL_CLOCK_LOOP_HPP_

#include <algorithm>

#include "sim/core/time.hpp"
#include "sim/model/clock_source.hpp"

namespace mb4::sim {

// One clock is the hot path, so its `edge` is inlined too: a lambda with
// __attribute__((always_inline)). Without it the iC-MB4 takes 2 to 3 % more instructions.

// Runs the edges of `clock` up to and including `limit`. `edge(now, rises)` computes one; if it
// returns true the loop ends. Returns the time of that edge, or kNever.
template <typename Edge>
[[gnu::always_inline]] inline Time run_edges(ClockSource& clock, Time limit, Edge edge) {
  while (clock.next() <= limit) {
    const Time now = clock.next();
    if (edge(now, clock.edge())) return now;
  }
  return kNever;
}

// The same for two clocks. `edge(now, of_first, of_second)` says whose edge it is; both may be. It
// makes the edges of the clocks happen itself.
template <typename Edge>
inline Time run_edges(ClockSource& first, ClockSource& second, Time limit, Edge edge) {
  while (true) {
    const Time now = std::min(first.next(), second.next());
    if (now > limit) return kNever;
    if (edge(now, first.next() == now, second.next() == now)) return now;
  }
}

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_CLOCK_LOOP_HPP_
