// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Watches MA of one line at the chip's pin: the edges of each frame, the widths of its levels and
// MA in the timeout. The monitor needs nothing from the slaves. A frame starts with a falling edge
// after a rest. A rest is 1.5 periods without an edge. The monitor measures them in the frame, from
// its first falling to its second rising edge.
#ifndef MB4SIM_MA_MONITOR_HPP_
#define MB4SIM_MA_MONITOR_HPP_

#include <algorithm>
#include <cstdint>

#include "sim/core/time.hpp"

namespace mb4::sim {

// One frame as seen on MA, times in ps. A width lies between two edges inside the frame; 0 if there
// was no such level.
struct MaFrame {
  Time start = 0;  // first falling edge
  Time last_edge = 0;
  std::uint64_t rising = 0;   // rising edges
  std::uint64_t falling = 0;  // falling edges, the first one included
  Time min_high = 0;
  Time max_high = 0;
  Time min_low = 0;
  Time max_low = 0;
  // Rest after the frame: its level, and its duration until the next edge or until now.
  bool rest_level = true;
  Time rest = 0;
};

class MaMonitor {
 public:
  // Duration of the rest that ends a frame without a second rising edge, ps.
  static constexpr Time kUnmeasuredRest = 40 * kPsPerUs;

  // This function is inline because it is called at every edge.
  void edge(Time now, bool level) {
    if (level == level_) return;
    level_ = level;
    if (active_ && now >= ends_at()) end(now, level);
    if (!active_) {
      if (!level) begin(now);  // else MA returns to 1 between two frames
      return;
    }
    const Time width = now - current_.last_edge;
    current_.last_edge = now;
    if (level) {
      widen(width, current_.min_low, current_.max_low);
      if (++current_.rising == 2) rest_limit_ = now - current_.start;
    } else {
      widen(width, current_.min_high, current_.max_high);
      ++current_.falling;
    }
  }

  // Number of frames that have started.
  std::uint64_t frames() const { return frames_; }
  // True while a frame is being clocked.
  bool running(Time now) const { return active_ && now < ends_at(); }
  // The time at which the running frame is over if MA has no more edge; in the past if it is over.
  Time ends_at() const { return current_.last_edge + rest_limit(); }
  // The last frame whose clock has ended. If there is none yet, the running frame.
  MaFrame last(Time now) const;

 private:
  static void widen(Time width, Time& minimum, Time& maximum) {
    minimum = minimum == 0 ? width : std::min(minimum, width);
    maximum = std::max(maximum, width);
  }
  void begin(Time now);
  void end(Time now, bool level);
  Time rest_limit() const { return rest_limit_ == 0 ? kUnmeasuredRest : rest_limit_; }

  std::uint64_t frames_ = 0;
  bool active_ = false;  // current_ has started, and since then no rest was seen at an edge
  bool level_ = true;
  Time rest_limit_ = 0;
  MaFrame current_;
  MaFrame finished_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_MA_MONITOR_HPP_
