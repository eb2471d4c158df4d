// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The gap by which biss_frame_sampler takes a frame, computed from the levels of SL as
// docs/samplers.md tells it: what tests judge the RTL by.
#ifndef TESTS_BLOCK_BISS_WIDEST_GAP_HPP_
#define TESTS_BLOCK_BISS_WIDEST_GAP_HPP_

#include <cstddef>
#include <vector>

namespace mb4test {

struct Gap {
  unsigned width = 0;  // clocks
  unsigned last = 0;   // its last place
};

// The widest gap between the places of all edges before `end`, of several the first one. A bit has
// `period` places; place 0 is at `rise`.
inline Gap widest_gap(const std::vector<bool>& levels, std::size_t rise, std::size_t end,
                      unsigned period) {
  std::vector<bool> marks(period);
  for (std::size_t i = 1; i < end; ++i) {
    const auto apart = static_cast<long>(i) - static_cast<long>(rise);
    const long place = (apart % static_cast<long>(period) + period) % period;
    if (levels[i] != levels[i - 1]) marks[static_cast<std::size_t>(place)] = true;
  }
  Gap found;
  for (unsigned from = 0; from < period; ++from) {
    unsigned to = from + 1;
    while (to < period && !marks[to]) ++to;
    if (marks[from] && to - from > found.width) found = {to - from, to - 1};
  }
  return found;
}

}  // namespace mb4test

#endif  // TESTS_BLOCK_BISS_WIDEST_GAP_HPP_
