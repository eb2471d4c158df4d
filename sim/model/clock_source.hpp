// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A clock without drift: edge k is at k / (2 f), rounded down to a whole picosecond. The functions
// are inline because they are called once per half period.
#ifndef MB4SIM_MODEL_CLOCK_SOURCE_HPP_
#define MB4SIM_MODEL_CLOCK_SOURCE_HPP_

#include <cstdint>

#include "sim/core/time.hpp"

namespace mb4::sim {

class ClockSource {
 public:
  // frequency_hz = 0: the clock never moves and stays 0.
  explicit ClockSource(std::uint64_t frequency_hz)
      : denominator_(2 * frequency_hz),
        whole_(denominator_ == 0 ? 0 : kPsPerSecond / denominator_),
        rest_(denominator_ == 0 ? 0 : kPsPerSecond % denominator_) {
    if (denominator_ == 0) {
      next_ = kNever;
    } else {
      step();
    }
  }

  Time next() const { return next_; }  // time of the next edge
  bool level() const { return level_; }

  // Changes the frequency from `now` on, which must not be before the last edge. The next edge
  // comes half a period later. With 0 the clock keeps its level.
  void retune(std::uint64_t frequency_hz, Time now) {
    denominator_ = 2 * frequency_hz;
    rest_sum_ = 0;
    if (denominator_ == 0) {
      next_ = kNever;
      return;
    }
    whole_ = kPsPerSecond / denominator_;
    rest_ = kPsPerSecond % denominator_;
    next_ = now;
    step();
  }

  // Makes the next edge happen. Returns the new level.
  bool edge() {
    level_ = !level_;
    step();
    return level_;
  }

  // Leaves out whole periods until the next edge is not before `now`. The level stays. For a clock
  // that was not used for a while.
  void skip_to(Time now) {
    if (denominator_ == 0 || next_ >= now) return;
    skip(whole_periods(now));
    while (next_ < now) {
      step();
      step();
    }
  }

  // Returns a number of whole periods that can be left out: the edge after them is certainly not
  // later than `limit`.
  std::uint64_t whole_periods(Time limit) const {
    if (denominator_ == 0 || limit <= next_) return 0;
    const Time period = 2 * whole_ + (2 * rest_) / denominator_;
    return (limit - next_) / (period + 1);
  }
  void skip(std::uint64_t periods) {
    const auto parts = static_cast<Wide>(2 * periods) * rest_ + rest_sum_;
    next_ += 2 * periods * whole_ + static_cast<Time>(parts / denominator_);
    rest_sum_ = static_cast<std::uint64_t>(parts % denominator_);
  }

 private:
  __extension__ using Wide = unsigned __int128;

  void step() {
    next_ += whole_;
    if (rest_ == 0) return;
    rest_sum_ += rest_;
    if (rest_sum_ >= denominator_) {
      rest_sum_ -= denominator_;
      ++next_;
    }
  }

  std::uint64_t denominator_;
  Time whole_;
  std::uint64_t rest_;
  std::uint64_t rest_sum_ = 0;
  Time next_ = 0;
  bool level_ = false;
};

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_CLOCK_SOURCE_HPP_
