// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/clocked/clocked_frames.hpp"

namespace mb4::sim {

ClockedFrames::ClockedFrames(Time now, EventQueue& queue, ClockedLine& line)
    : queue_(queue), line_(line) {
  const MaMonitor& monitor = line.monitor();
  begun_ = monitor.frames();
  told_ = begun_ - (monitor.running(now) ? 1 : 0);
  line.set_tap(&ClockedFrames::on_edge, this);
  plan(now);
}

void ClockedFrames::tell(Time now, LineObserver* observer, bool edges) {
  observer_ = observer;
  edges_ = edges && observer != nullptr;
  line_.set_probe(edges_ ? &ClockedFrames::on_probe : nullptr, this);
  if (!edges_) return;
  levels_ = {(line_.pins() & kMaPin) != 0, (line_.pins() & kMoPin) != 0, line_.sl(),
             line_.chain().slo()};
  for (unsigned place = 0; place < kPlaces; ++place) observer_->edge(now, place, levels_[place]);
}

void ClockedFrames::tell_edge(Time now, Place place, bool level) {
  if (levels_[place] == level) return;
  levels_[place] = level;
  observer_->edge(now, place, level);
}

void ClockedFrames::on_probe(Time now, void* receiver) {
  auto& frames = *static_cast<ClockedFrames*>(receiver);
  frames.tell_edge(now, kSlo, frames.line_.chain().slo());
}

// The monitor has seen the edge before.
void ClockedFrames::on_edge(Time now, void* receiver, ClockedLine::Signal signal, bool level) {
  auto& frames = *static_cast<ClockedFrames*>(receiver);
  if (frames.edges_) {
    constexpr Place kOfSignal[] = {kMa, kMo, kSl};
    frames.tell_edge(now, kOfSignal[static_cast<std::size_t>(signal)], level);
  }
  if (signal != ClockedLine::Signal::kMa) return;
  const std::uint64_t begun = frames.line_.monitor().frames();
  if (begun != frames.begun_ && frames.observer_ != nullptr) frames.observer_->frame_begun();
  frames.begun_ = begun;
  frames.plan(now);
}

// Plans a look at the time when the running frame may be over. An edge of MA moves this time later,
// and the look notices it. Only the second rising edge, which measures the period, moves it nearer.
void ClockedFrames::plan(Time now) {
  const Time end = line_.monitor().ends_at();
  if (!line_.monitor().running(now) || end >= due_) return;
  due_ = end;
  queue_.post(end, &ClockedFrames::on_look, this, end);
}

void ClockedFrames::on_look(Time now, void* receiver, std::uint64_t due) {
  auto& frames = *static_cast<ClockedFrames*>(receiver);
  if (frames.due_ == due) frames.look(now);
}

void ClockedFrames::look(Time now) {
  const MaMonitor& monitor = line_.monitor();
  due_ = kNever;
  const std::uint64_t over = monitor.frames() - (monitor.running(now) ? 1 : 0);
  if (over > told_) {
    told_ = over;
    const MaFrame frame = monitor.last(now);
    if (observer_ != nullptr) {
      observer_->frame_over(
          {over, frame.start, frame.last_edge, frame.rising + frame.falling, !frame.rest_level});
    }
  }
  plan(now);
}

}  // namespace mb4::sim
