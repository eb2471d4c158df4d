// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/capi/frame_watch.hpp"

namespace mb4::sim {

FrameWatch::FrameWatch(Simulator& simulator)
    : simulator_(simulator),
      ner_(simulator.pin_by_name("NER")),
      eot_(simulator.pin_by_name("EOT")) {
  for (const ChannelConfig& channel : simulator.scenario().channels) {
    Line* const line = simulator.line(channel.number);
    channels_.push_back(std::make_unique<Channel>(Channel{this, channel.number, line}));
    Channel& last = *channels_.back();
    last.begun = line->monitor().frames();
    last.told = last.begun - (line->monitor().running(simulator.now()) ? 1 : 0);
    line->set_tap(&FrameWatch::on_edge, &last);
    plan(last);
  }
  simulator.set_observer(this);
}

FrameWatch::~FrameWatch() { simulator_.set_observer(nullptr); }

// Now the pins show the errors of the earlier frames.
void FrameWatch::take_ner() {
  if (!waiting_.empty() && ner_ && !simulator_.pin(*ner_)) {
    for (const std::size_t fault : waiting_) ++stories_[fault].ner_low;
  }
  waiting_.clear();
}

void FrameWatch::pin_changed(Pin pin, bool level) {
  if (pin == eot_ && level) take_ner();
}

const std::vector<FaultStory>& FrameWatch::stories() {
  stories_.resize(simulator_.faults().size());
  return stories_;
}

void FrameWatch::set_edges(EdgeCallback callback) {
  edges_ = std::move(callback);
  for (const auto& channel : channels_) {
    channel->line->set_probe(edges_ ? &FrameWatch::on_probe : nullptr, channel.get());
    if (!edges_) continue;
    const Time now = simulator_.now();
    channel->levels = {simulator_.ma(channel->number), simulator_.mo(channel->number),
                       channel->line->sl(), channel->line->chain().slo()};
    for (std::size_t place = 0; place < kEdgePlaces; ++place)
      edges_(channel->number, static_cast<EdgePlace>(place), now, channel->levels[place]);
  }
}

void FrameWatch::tell(Channel& channel, EdgePlace place, Time now, bool level) {
  bool& told = channel.levels[static_cast<std::size_t>(place)];
  if (told == level) return;
  told = level;
  edges_(channel.number, place, now, level);
}

void FrameWatch::on_probe(Time now, void* receiver) {
  auto& channel = *static_cast<Channel*>(receiver);
  channel.watch->tell(channel, EdgePlace::kSlo, now, channel.line->chain().slo());
}

// The monitor has seen the edge before.
void FrameWatch::on_edge(Time now, void* receiver, Line::Signal signal, bool level) {
  auto& channel = *static_cast<Channel*>(receiver);
  if (channel.watch->edges_) {
    constexpr EdgePlace kPlaces[] = {EdgePlace::kMa, EdgePlace::kMo, EdgePlace::kSl};
    channel.watch->tell(channel, kPlaces[static_cast<std::size_t>(signal)], now, level);
  }
  if (signal != Line::Signal::kMa) return;
  const std::uint64_t frames = channel.line->monitor().frames();
  if (frames != channel.begun) channel.watch->take_ner();
  channel.begun = frames;
  channel.watch->plan(channel);
}

// Plans a look at the time when the running frame may be over. An edge of MA moves this time later,
// and the look notices it. Only the second rising edge, which measures the period, moves it nearer.
void FrameWatch::plan(Channel& channel) {
  const Time end = channel.line->monitor().ends_at();
  if (!channel.line->monitor().running(simulator_.now()) || end >= channel.due) return;
  channel.due = end;
  simulator_.at(end, [this, &channel, end] {
    if (channel.due == end) look(channel);
  });
}

void FrameWatch::look(Channel& channel) {
  const Time now = simulator_.now();
  const MaMonitor& monitor = channel.line->monitor();
  channel.due = kNever;
  const std::uint64_t over = monitor.frames() - (monitor.running(now) ? 1 : 0);
  if (over > channel.told) {
    channel.told = over;
    SeenFrame frame{channel.number, over, monitor.last(now), false};
    frame.fault = touched(channel, frame.ma);
    if (eot_ && simulator_.pin(*eot_)) take_ner();
    if (callback_) callback_(frame);
  }
  plan(channel);
}

// Finds and counts the faults of this frame. A fault of the host touches no line.
bool FrameWatch::touched(Channel& channel, const MaFrame& frame) {
  const std::vector<FaultRecord>& records = simulator_.faults();
  stories_.resize(records.size());
  bool any = false;
  bool all_ended = true;
  for (std::size_t i = channel.settled; i < records.size(); ++i) {
    const FaultRecord& record = records[i];
    const FaultConfig& fault = simulator_.scenario().faults[record.config];
    const bool here = fault.channel == channel.number || fault.kind->place == FaultPlace::kClock;
    const bool waits = here && record.frame != 0;
    const bool ended = waits ? stories_[i].frames != 0 : record.end < frame.start;
    if (all_ended && ended) ++channel.settled;
    all_ended = all_ended && ended;
    if (!here || ended) continue;
    if (waits && channel.line->faults().frames() < record.frame) continue;
    any = true;
    ++stories_[i].frames;
    waiting_.push_back(i);
  }
  return any;
}

}  // namespace mb4::sim
