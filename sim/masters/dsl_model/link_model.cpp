// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/link_model.hpp"

namespace mb4::sim::dsl_model {

LinkModel::LinkModel(const LinkRules& rules, std::uint64_t hz, Time start)
    : link_(rules), hz_(hz), next_(hz == 0 ? kNever : start) {
  outputs_ = of_line(0, kOut);
  min_clock_ = period_of(hz);
}

// Moves the next edge by a few edges.
void LinkModel::pass(std::uint64_t edges) {
  const std::uint64_t whole = kPsPerSecond / hz_;
  const std::uint64_t part = kPsPerSecond % hz_;
  rest_ += part * edges;
  next_ += whole * edges + rest_ / hz_;
  rest_ %= hz_;
}

// Clocks without effect are left out, but none beyond the limit.
Time LinkModel::run_clocks(Time limit) {
  if (hz_ == 0) return kNever;
  const std::uint64_t most = kPsPerSecond / hz_ + 1;
  while (next_ <= limit) {
    if (const unsigned idle = link_.idle_ticks(); idle != 0) {
      if (limit - next_ >= idle * most) {
        link_.skip(idle);
        cycles_ += idle;
        pass(idle);
        continue;
      }
    }
    const Time now = next_;
    link_.tick(in_);
    ++cycles_;
    pass(1);
    const Outputs levels = of_line(0, (link_.out() ? kOut : 0U) | (link_.enable() ? kEnable : 0U));
    if (levels != outputs_) {
      outputs_ = levels;
      return now;
    }
  }
  return kNever;
}

void LinkModel::set_clock(Time now, std::uint64_t hz) {
  may_run_at(hz);
  if (hz == 0 && hz_ != 0) {
    stopped_next_ = next_;
    stopped_hz_ = hz_;
  }
  hz_ = hz;
  rest_ = 0;
  next_ = hz == 0 ? kNever : now + kPsPerSecond / hz;
}

Time LinkModel::time_of(std::uint64_t tick) const {
  const std::uint64_t ago = link_.ticks() - tick;
  if (hz_ != 0) return next_ - ago * kPsPerSecond / hz_;
  return stopped_hz_ == 0 ? next_ : stopped_next_ - ago * kPsPerSecond / stopped_hz_;
}

}  // namespace mb4::sim::dsl_model
