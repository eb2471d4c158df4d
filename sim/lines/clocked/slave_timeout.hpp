// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The time for which MA must be constant until a slave ends the frame. It is fixed, or the slave
// measures it in every frame.
#ifndef MB4SIM_SLAVE_TIMEOUT_HPP_
#define MB4SIM_SLAVE_TIMEOUT_HPP_

#include <cstdint>

#include "sim/core/random.hpp"
#include "sim/core/time.hpp"

namespace mb4::sim {

struct SlaveTimeout {
  // Fixed: `fixed` ps after the last edge of MA.
  // Adaptive (fixed = 0): 1.5 periods of MA plus 0 to 3 sampling periods of the slave's own clock.
  // The slave measures the period in every frame from the first falling to the second rising edge.
  // The sampling periods are drawn in every frame.
  Time fixed = 0;
  Time sample_period = 0;  // ps
  // Adaptive only, ps: used until the period has been measured.
  Time initial = 40 * kPsPerUs;

  bool adaptive() const { return fixed == 0; }
};

// The timeout of one slave as it goes through its frames.
class TimeoutClock {
 public:
  TimeoutClock(const SlaveTimeout& config, std::uint64_t seed)
      : config_(config), random_(seed), value_(config.adaptive() ? config.initial : config.fixed) {}

  // The first falling edge of a frame has come.
  void begin(Time now) {
    begin_ = now;
    if (config_.adaptive()) value_ = config_.initial;
  }
  // The second rising edge of the frame has come.
  void measure(Time now) {
    if (!config_.adaptive()) return;
    value_ = now - begin_;
    if (config_.sample_period != 0) value_ += random_.up_to(3 * config_.sample_period);
  }
  // Timeout of the running or last frame, ps.
  Time value() const { return value_; }

 private:
  SlaveTimeout config_;
  Random random_;
  Time begin_ = 0;
  Time value_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_SLAVE_TIMEOUT_HPP_
