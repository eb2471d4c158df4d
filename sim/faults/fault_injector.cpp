// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/faults/fault_injector.hpp"

#include <string>
#include <utility>

#include "sim/faults/fault_types.hpp"
#include "sim/lines/line.hpp"

namespace mb4::sim {

FaultInjector::FaultInjector(FaultTarget& target, EventQueue& queue,
                             const std::vector<FaultConfig>& faults, std::uint64_t seed)
    : target_(target), queue_(queue), faults_(faults), seed_(seed) {
  add_new();
}

// A fault that came earlier may act on this channel now. This fault must remember the cable as it
// is without that one.
void FaultInjector::remember_cable(Source& source) {
  const unsigned channel = faults_[source.config].channel;
  for (const auto& before : sources_) {
    const FaultConfig& fault = faults_[before->config];
    if (before.get() == &source || fault.kind->place != FaultPlace::kLine ||
        fault.channel != channel) {
      continue;
    }
    source.was = before->was;
    return;
  }
  const Line& line = target_.line(channel);
  for (unsigned wire = 0; wire < target_.wires(); ++wire) {
    source.was.push_back(line.wire_faults(wire));
  }
}

void FaultInjector::add_new() {
  for (std::size_t i = sources_.size(); i < faults_.size(); ++i) {
    const FaultConfig& fault = faults_[i];
    sources_.push_back(
        std::make_unique<Source>(Source{this, i, Random(derive_seed(seed_, i)), {}, {}, {}}));
    Source& source = *sources_.back();
    if (fault.kind->place == FaultPlace::kLine) remember_cable(source);
    for (const Time at : fault.at) queue_.post(at, &FaultInjector::begin, &source);
    if (fault.at.empty()) post_random(source, fault.from);
  }
}

// The distance between two faults is spread evenly over 0 to twice the mean, as with glitches.
void FaultInjector::post_random(Source& source, Time after) {
  const FaultConfig& fault = faults_[source.config];
  const auto mean = static_cast<Time>(static_cast<double>(kPsPerSecond) / fault.per_s);
  const Time at = after + 1 + source.random.up_to(2 * mean);
  if (at <= fault.to && at < kEndOfTime) queue_.post(at, &FaultInjector::begin, &source);
}

FaultScene FaultInjector::scene(Time now, Source& source, FaultRecord& record) const {
  return {faults_[source.config],        target_, source.random, source.was, now, record,
          {&FaultInjector::hit, &source}};
}

void FaultInjector::begin(Time now, void* receiver, std::uint64_t /*word*/) {
  auto& source = *static_cast<Source*>(receiver);
  FaultInjector& self = *source.injector;
  const FaultConfig& fault = self.faults_[source.config];
  const FaultType& type = *fault.kind;
  FaultRecord record;
  record.config = source.config;
  record.begin = now;
  record.end = type.momentary ? now + fault.width : kNever;
  record.what = type.begin(self.scene(now, source, record));
  if (fault.frame != 0) {
    source.waiting = std::move(record);
    return;
  }
  self.records_.push_back(std::move(record));
  if (!type.momentary) {
    source.lasting.push_back(self.records_.size() - 1);
    if (fault.duration != kNever) {
      self.queue_.post(now + fault.duration, &FaultInjector::end, &source,
                       self.records_.size() - 1);
    }
  }
  if (fault.at.empty()) self.post_random(source, now);
}

// The named frame has come.
void FaultInjector::hit(void* receiver) {
  auto& source = *static_cast<Source*>(receiver);
  FaultInjector& self = *source.injector;
  source.waiting.begin = source.waiting.end = self.target_.now();
  self.records_.push_back(source.waiting);
}

// If several faults of one table overlap, the effect continues until the last of them is over.
void FaultInjector::end(Time now, void* receiver, std::uint64_t record) {
  auto& source = *static_cast<Source*>(receiver);
  FaultInjector& self = *source.injector;
  self.records_[record].end = now;
  std::erase(source.lasting, record);
  if (!source.lasting.empty()) return;
  self.faults_[source.config].kind->end(self.scene(now, source, self.records_[record]));
}

}  // namespace mb4::sim
