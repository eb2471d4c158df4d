// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Records the edges that arrive at the end of a wire.
#ifndef TESTS_UNIT_CORE_ARRIVALS_HPP_
#define TESTS_UNIT_CORE_ARRIVALS_HPP_

#include <utility>
#include <vector>

#include "sim/core/time.hpp"

namespace mb4test {

using namespace mb4::sim;

using Arrivals = std::vector<std::pair<Time, unsigned>>;

inline void record(Time now, void* receiver, unsigned levels) {
  static_cast<Arrivals*>(receiver)->emplace_back(now, levels);
}

}  // namespace mb4test

#endif  // TESTS_UNIT_CORE_ARRIVALS_HPP_
