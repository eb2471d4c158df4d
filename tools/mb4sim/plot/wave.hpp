// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A recorded signal.
#ifndef MB4SIM_TOOL_WAVE_HPP_
#define MB4SIM_TOOL_WAVE_HPP_

#include <vector>

#include "sim/core/time.hpp"

namespace mb4::tool {

struct Edge {
  sim::Time time;
  bool level;
};

// One signal: its level before the first edge and its edges.
struct Wave {
  bool idle = true;
  std::vector<Edge> edges;

  void edge(sim::Time time, bool level);
  bool at(sim::Time time) const;  // an edge counts from its own time on
  bool last() const { return edges.empty() ? idle : edges.back().level; }
  Wave between(sim::Time from, sim::Time to) const;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_WAVE_HPP_
