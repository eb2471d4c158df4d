// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/replay/replay_slave.hpp"

#include <algorithm>

namespace mb4::sim {

std::unique_ptr<Slave> ReplaySlaveConfig::make_slave(std::uint64_t /*seed*/) const {
  return std::make_unique<ReplaySlave>(*this);
}

// It counts as the protocol that can be recorded, BiSS C.
DeviceTraits ReplaySlaveConfig::traits() const {
  Time longest = 0;
  for (const auto& frame : recording.frames) longest = std::max(longest, frame.edges.back().time);
  return {.protocol = {.key = "biss-c", .title = "BiSS C", .control = true},
          .timeout = longest,
          .alone = "a replay slave"};
}

std::string_view ReplaySlaveConfig::refuses(const SlaveFault& fault) const {
  return fault == slave_fault::kWrongCrc ? "a recording cannot be changed"
                                         : DeviceConfig::refuses(fault);
}

ReplaySlave::ReplaySlave(const ReplaySlaveConfig& config)
    : config_(config),
      timeout_(config.timeout.adaptive() ? config.timeout.initial : config.timeout.fixed) {}

const std::vector<ReplayRecording::Edge>& ReplaySlave::edges() const {
  return config_.recording.frames[frame_].edges;
}

void ReplaySlave::ma_edge(Time now, bool ma, bool /*sli_before*/, bool /*sli*/) {
  ma_ = ma;
  last_edge_ = now;
  if (!active_) {
    if (ma) return;
    active_ = true;
    first_falling_ = now;
    next_ = 0;
    risings_.clear();
    if (config_.timeout.adaptive()) timeout_ = config_.timeout.initial;
  } else if (ma) {
    risings_.push_back(now);
    if (risings_.size() == 2 && config_.timeout.adaptive()) timeout_ = now - first_falling_;
    if (risings_.size() == 3) count_frame();
  }
  play_due(now);
  wait();
}

ReplaySlave::Place ReplaySlave::place(std::size_t index) const {
  const Time time = edges()[index].time;
  const Time period = kPsPerSecond / config_.recording.ma_hz;
  // Rising edge n comes (n - 1/2) periods after the first falling edge.
  const std::uint64_t rising = (time + period / 2) / period;
  if (rising == 0) return {0, time};
  return {rising, time - (rising * period - period / 2)};
}

// Time of the next recorded edge if it is known, else kNever.
Time ReplaySlave::next_edge() const {
  if (next_ >= edges().size()) return kNever;
  if (config_.play == ReplaySlaveConfig::Play::kTime) {
    return first_falling_ + edges()[next_].time;
  }
  const Place at = place(next_);
  if (at.rising > risings_.size()) return kNever;
  return (at.rising == 0 ? first_falling_ : risings_[static_cast<std::size_t>(at.rising - 1)]) +
         at.after;
}

void ReplaySlave::wait() {
  const Time end = config_.play == ReplaySlaveConfig::Play::kTime ? kNever : last_edge_ + timeout_;
  set_deadline(active_ ? std::min(next_edge(), end) : kNever);
  set_idle(!active_);
}

void ReplaySlave::play_due(Time now) {
  while (next_edge() <= now) set_slo(edges()[next_++].level);
}

void ReplaySlave::timer(Time now, bool /*sli*/) {
  play_due(now);
  const bool time_mode = config_.play == ReplaySlaveConfig::Play::kTime;
  const bool over = time_mode ? next_ == edges().size() : now >= last_edge_ + timeout_;
  if (over) {
    if (risings_.size() >= 3) take_cdm(!ma_);
    active_ = false;
    set_slo(true);
    // A few clocks, as INIT makes them, are no reading of the frame.
    if (2 * risings_.size() >= config_.recording.frames[frame_].rising) {
      frame_ = (frame_ + 1) % config_.recording.frames.size();
    }
  }
  wait();
}

}  // namespace mb4::sim
