// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/wire.hpp"

#include <algorithm>
#include <cassert>

namespace mb4::sim {
namespace {

constexpr std::uint64_t kJitterPart = 1;  // part numbers of derive_seed()
constexpr std::uint64_t kGlitchPart = 2;

}  // namespace

Wire::Wire(EventQueue& queue, Time delay, const WireFaults& faults, std::uint64_t seed,
           unsigned idle, Output output, void* receiver)
    : queue_(queue),
      delay_(delay),
      faults_(faults),
      random_(derive_seed(seed, kJitterPart)),
      glitch_random_(derive_seed(seed, kGlitchPart)),
      output_(output),
      receiver_(receiver),
      sent_(idle),
      arrived_(idle),
      shown_(idle) {
  if (faults_.glitches_per_s != 0) post_glitch(0);
}

void Wire::set_faults(const WireFaults& faults) {
  assert(faults.glitches_per_s == faults_.glitches_per_s);
  faults_ = faults;
}

void Wire::send(Time now, unsigned levels) {
  Time at = now + delay_;
  if (((levels ^ sent_) & kFaulty) != 0) at += extra((levels & kFaulty) != 0);
  sent_ = levels;
  at = std::max(at, last_);
  last_ = at;
  if (at == now && in_flight_ == 0) {
    deliver(now, levels);
  } else {
    ++in_flight_;
    queue_.post(at, &Wire::arrive, this, levels);
  }
}

Time Wire::extra(bool rising) {
  Time time = 0;
  if (faults_.skew > 0 && !rising) time += static_cast<Time>(faults_.skew);
  if (faults_.skew < 0 && rising) time += static_cast<Time>(-faults_.skew);
  if (faults_.jitter != 0) time += random_.up_to(faults_.jitter);
  return time;
}

void Wire::arrive(Time now, void* receiver, std::uint64_t levels) {
  auto* wire = static_cast<Wire*>(receiver);
  --wire->in_flight_;
  wire->deliver(now, static_cast<unsigned>(levels));
}

void Wire::stick(Time now, std::optional<bool> level) {
  stuck_ = level;
  emit(now);
}

void Wire::glitch(Time now, Time width) {
  ++single_glitches_;
  queue_.post(now + width, &Wire::end_single_glitch, this);
  emit(now);
}

void Wire::end_single_glitch(Time now, void* receiver, std::uint64_t /*word*/) {
  auto* wire = static_cast<Wire*>(receiver);
  --wire->single_glitches_;
  wire->emit(now);
}

// The distance between two glitches is spread evenly over 0 to twice the mean.
void Wire::post_glitch(Time after) {
  const Time mean = kPsPerSecond / faults_.glitches_per_s;
  queue_.post(after + 1 + glitch_random_.up_to(2 * mean), &Wire::begin_glitch, this);
}

void Wire::begin_glitch(Time now, void* receiver, std::uint64_t /*word*/) {
  auto* wire = static_cast<Wire*>(receiver);
  wire->glitch_ = true;
  wire->queue_.post(now + wire->faults_.glitch_width, &Wire::end_glitch, wire);
  wire->emit(now);
}

void Wire::end_glitch(Time now, void* receiver, std::uint64_t /*word*/) {
  auto* wire = static_cast<Wire*>(receiver);
  wire->glitch_ = false;
  wire->post_glitch(now);
  wire->emit(now);
}

}  // namespace mb4::sim
