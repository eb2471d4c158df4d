// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "tests/reference/pru/trace.hpp"

#include <algorithm>
#include <stdexcept>

namespace pru_judge {
namespace {

std::vector<Edge>::const_iterator first_at(const std::vector<Edge>& edges, Time at) {
  return std::lower_bound(edges.begin(), edges.end(), at,
                          [](const Edge& edge, Time time) { return edge.at < time; });
}

std::vector<Edge>::const_iterator first_after(const std::vector<Edge>& edges, Time at) {
  return std::upper_bound(edges.begin(), edges.end(), at,
                          [](Time time, const Edge& edge) { return time < edge.at; });
}

}  // namespace

void Trace::edge(Time at, bool level) {
  if (!edges_.empty() && at < edges_.back().at) {
    throw std::invalid_argument("Trace: an edge is earlier than the edge before it");
  }
  if (level == level_at(edges_.end())) return;
  if (!edges_.empty() && edges_.back().at == at) {
    edges_.pop_back();
  } else {
    edges_.push_back({at, level});
  }
}

bool Trace::level_at(std::vector<Edge>::const_iterator next) const {
  return next == edges_.begin() ? initial_ : std::prev(next)->level;
}

bool Trace::before(Time at) const { return level_at(first_at(edges_, at)); }

bool Trace::from(Time at) const { return level_at(first_after(edges_, at)); }

bool Trace::steady(Time first, Time last) const {
  return first_at(edges_, first) == first_after(edges_, last);
}

std::vector<Edge> Trace::within(Time first, Time last) const {
  const auto begin = first_at(edges_, first);
  const auto end = first_after(edges_, last);
  return begin < end ? std::vector<Edge>(begin, end) : std::vector<Edge>();
}

void Trace::forget(Time before) {
  const auto next = first_at(edges_, before);
  initial_ = level_at(next);
  edges_.erase(edges_.begin(), next);
}

}  // namespace pru_judge
