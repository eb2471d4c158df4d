// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// How long a slave is busy with a register, in frames and in time, and a timer for it.
#ifndef MB4SIM_BUSY_TIME_HPP_
#define MB4SIM_BUSY_TIME_HPP_

#include <cstdint>

#include "sim/core/time.hpp"

namespace mb4::sim {

// The slave is ready when both the frames and the time have passed. kForever frames never pass.
struct BusyTime {
  static constexpr std::uint32_t kForever = UINT32_MAX;
  std::uint32_t frames = 0;
  Time time = 0;  // ps
};

class BusyTimer {
 public:
  // Starts to wait for `busy` and `extra` more frames. The time counts from `now`.
  void start(Time now, const BusyTime& busy, std::uint32_t extra = 0) {
    until_ = now + busy.time;
    left_ = busy.frames == BusyTime::kForever ? busy.frames : busy.frames + extra;
  }
  // One frame has passed.
  void frame() {
    if (left_ != 0 && left_ != BusyTime::kForever) --left_;
  }
  bool over(Time now) const { return left_ == 0 && now >= until_; }

 private:
  std::uint32_t left_ = 0;
  Time until_ = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_BUSY_TIME_HPP_
