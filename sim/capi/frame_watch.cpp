// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/capi/frame_watch.hpp"

namespace mb4::sim {

FrameWatch::FrameWatch(Simulator& simulator)
    : simulator_(simulator),
      error_(simulator.pin_by_name(simulator.scenario().master->error_pin)),
      end_(simulator.pin_by_name(simulator.scenario().master->end_pin)) {
  for (const ChannelConfig& channel : simulator.scenario().channels) {
    channels_.push_back(
        std::make_unique<Channel>(*this, channel.number, *simulator.line(channel.number)));
    channels_.back()->line.observe(simulator.now(), channels_.back().get(), false);
  }
  simulator.set_observer(this);
}

FrameWatch::~FrameWatch() { simulator_.set_observer(nullptr); }

// Now the pin shows the errors of the earlier frames.
void FrameWatch::take_error() {
  if (!waiting_.empty() && error_ && !simulator_.pin(*error_)) {
    for (const std::size_t fault : waiting_) ++stories_[fault].error_low;
  }
  waiting_.clear();
}

void FrameWatch::pin_changed(Pin pin, bool level) {
  if (pin == end_ && level) take_error();
}

const std::vector<FaultStory>& FrameWatch::stories() {
  stories_.resize(simulator_.faults().size());
  return stories_;
}

void FrameWatch::set_edges(EdgeCallback callback) {
  edges_ = std::move(callback);
  for (const auto& channel : channels_) {
    channel->line.observe(simulator_.now(), channel.get(), static_cast<bool>(edges_));
  }
}

void FrameWatch::frame_over(Channel& channel, const LineFrame& frame) {
  SeenFrame seen{channel.number, frame, false};
  seen.fault = touched(channel, frame);
  if (end_ && simulator_.pin(*end_)) take_error();
  if (callback_) callback_(seen);
}

// Finds and counts the faults of this frame. A fault of the host touches no line.
bool FrameWatch::touched(Channel& channel, const LineFrame& frame) {
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
    if (record.begin > frame.end) continue;  // a line may tell of a frame late
    if (waits && channel.line.flip_frames() < record.frame) continue;
    any = true;
    ++stories_[i].frames;
    waiting_.push_back(i);
  }
  return any;
}

}  // namespace mb4::sim
