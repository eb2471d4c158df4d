// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/ma_monitor.hpp"

#include <algorithm>

namespace mb4::sim {
namespace {

void widen(Time width, Time& minimum, Time& maximum) {
  minimum = minimum == 0 ? width : std::min(minimum, width);
  maximum = std::max(maximum, width);
}

}  // namespace

void MaMonitor::edge(Time now, bool level) {
  if (level == level_) return;
  level_ = level;
  if (active_ && now >= current_.last_edge + rest_limit()) {
    active_ = false;
    finished_ = current_;
    finished_.rest_level = !level;
    finished_.rest = now - current_.last_edge;
  }
  if (!active_) {
    if (level) return;  // MA returns to 1 between two frames
    active_ = true;
    ++frames_;
    rest_limit_ = 0;
    current_ = MaFrame{};
    current_.start = now;
    current_.last_edge = now;
    current_.falling = 1;
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

MaFrame MaMonitor::last(Time now) const {
  if (active_ && (frames_ == 1 || !running(now))) {
    MaFrame frame = current_;
    frame.rest_level = level_;
    frame.rest = now - frame.last_edge;
    return frame;
  }
  return finished_;
}

}  // namespace mb4::sim
