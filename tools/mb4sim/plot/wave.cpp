// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/wave.hpp"

#include <algorithm>
#include <iterator>

namespace mb4::tool {

void Wave::edge(sim::Time time, bool level) {
  if (level == last()) return;
  // A pulse without duration is none.
  if (!edges.empty() && edges.back().time == time) {
    edges.pop_back();
  } else {
    edges.push_back({time, level});
  }
}

bool Wave::at(sim::Time time) const {
  const auto next = std::upper_bound(edges.begin(), edges.end(), time,
                                     [](sim::Time t, const Edge& edge) { return t < edge.time; });
  return next == edges.begin() ? idle : std::prev(next)->level;
}

Wave Wave::between(sim::Time from, sim::Time to) const {
  Wave part{at(from), {}};
  for (const Edge& edge : edges) {
    if (edge.time > from && edge.time < to) part.edges.push_back(edge);
  }
  return part;
}

}  // namespace mb4::tool
