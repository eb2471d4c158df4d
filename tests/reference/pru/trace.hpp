// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The recorded levels of one pin, as edges in ascending order of their time in picoseconds.
#ifndef TESTS_REFERENCE_PRU_TRACE_HPP_
#define TESTS_REFERENCE_PRU_TRACE_HPP_

#include <cstdint>
#include <vector>

namespace pru_judge {

using Time = std::int64_t;  // ps

struct Edge {
  Time at;
  bool level;
};

class Trace {
 public:
  explicit Trace(bool initial = true) : initial_(initial) {}

  // The pin has `level` from the instant `at` on. Times ascend; a level that the pin has already
  // adds nothing. Several edges at one instant are a pulse that nobody sees.
  void edge(Time at, bool level);

  // The level just before the instant, which a flop takes whose clock rises then.
  bool before(Time at) const;
  // The level from the instant on.
  bool from(Time at) const;
  // True if the pin has one level from just before `first` until just after `last`.
  bool steady(Time first, Time last) const;
  // The edges from `first` on and up to and including `last`.
  std::vector<Edge> within(Time first, Time last) const;

  // Long recordings: edges before the instant count as the initial level from now on.
  void forget(Time before);

 private:
  bool level_at(std::vector<Edge>::const_iterator next) const;

  bool initial_;
  std::vector<Edge> edges_;
};

}  // namespace pru_judge

#endif  // TESTS_REFERENCE_PRU_TRACE_HPP_
