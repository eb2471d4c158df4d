// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/line_recording.hpp"

#include "sim/lines/clocked/clocked_line.hpp"

namespace mb4::tool {

LineRecording::LineRecording(sim::ClockedLine& line) {
  sl_.idle = line.sl();
  line.set_tap(&LineRecording::on_edge, this);
}

void LineRecording::clear() {
  for (Wave* wave : {&ma_, &mo_, &sl_}) *wave = Wave{wave->last(), {}};
}

void LineRecording::on_edge(sim::Time now, void* receiver, sim::ClockedLine::Signal signal,
                            bool level) {
  auto* self = static_cast<LineRecording*>(receiver);
  switch (signal) {
    case sim::ClockedLine::Signal::kMa:
      return self->ma_.edge(now, level);
    case sim::ClockedLine::Signal::kMo:
      return self->mo_.edge(now, level);
    case sim::ClockedLine::Signal::kSl:
      return self->sl_.edge(now, level);
  }
}

std::vector<FrameTrace> LineRecording::frames(sim::Time now) const {
  std::vector<FrameTrace> frames;
  bool running = false;
  for (const Edge& edge : ma_.edges) {
    if (running) {
      FrameTrace& frame = frames.back();
      const sim::Time period = frame.period();
      running = period == 0 || edge.time - frame.clock_end <= period + period / 2;
    }
    if (!running && edge.level) continue;  // MA goes back to 1 between two frames
    if (!running) frames.emplace_back().begin = edge.time;
    running = true;
    FrameTrace& frame = frames.back();
    frame.clock_end = edge.time;
    frame.rest = edge.level;
    if (edge.level) {
      frame.rising.push_back(edge.time);
    } else {
      frame.last_falling = edge.time;
    }
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    FrameTrace& frame = frames[i];
    frame.end = i + 1 < frames.size() ? frames[i + 1].begin : now;
    // SL may be 1 when the clock stops, because of the line's delay: the end is where it stays 1.
    for (auto edge = sl_.edges.rbegin(); edge != sl_.edges.rend(); ++edge) {
      if (edge->time >= frame.end || edge->time <= frame.clock_end) continue;
      if (edge->level) frame.end = edge->time;
      break;
    }
  }
  if (!frames.empty()) {
    const FrameTrace& last = frames.back();
    if (last.period() == 0 || now <= last.clock_end + last.period() + last.period() / 2) {
      frames.pop_back();
    }
  }
  return frames;
}

}  // namespace mb4::tool
