// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/clocked/ma_monitor.hpp"

namespace mb4::sim {

void MaMonitor::begin(Time now) {
  active_ = true;
  ++frames_;
  rest_limit_ = 0;
  current_ = MaFrame{};
  current_.start = now;
  current_.last_edge = now;
  current_.falling = 1;
}

void MaMonitor::end(Time now, bool level) {
  active_ = false;
  finished_ = current_;
  finished_.rest_level = !level;
  finished_.rest = now - current_.last_edge;
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
