// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/line.hpp"

#include <optional>

#include "sim/core/random.hpp"

namespace mb4::sim {
namespace {

constexpr std::uint64_t kMaPart = 1;  // part numbers of derive_seed()
constexpr std::uint64_t kSlPart = 2;

}  // namespace

Line::Line(EventQueue& queue, Time round_trip, Output output, void* receiver,
           const CableConfig& cable, std::uint64_t seed)
    : out_(queue, round_trip / 2, cable.ma, derive_seed(seed, kMaPart), kMa, &Line::at_slaves,
           this),
      mo_late_(queue, cable.mo_late, {}, 0, 0U, &Line::mo_at_slaves, this),
      back_(queue, round_trip - round_trip / 2, cable.sl, derive_seed(seed, kSlPart), 1U,
            &Line::at_master, this),
      chain_(queue, &Line::slo_changed, this),
      output_(output),
      receiver_(receiver),
      open_level_(cable.open_level),
      mo_wired_(cable.mo) {
  for (const CableEvent& event : cable.events) {
    queue.post(event.time, &Line::on_event, this, static_cast<std::uint64_t>(event.action));
  }
}

void Line::drive_all(Time now, bool ma, bool mo, unsigned levels) {
  if (tap_ != nullptr) {
    tap_(now, tap_receiver_, Signal::kMa, ma);
    tap_(now, tap_receiver_, Signal::kMo, mo);
  }
  out_.drive(now, levels);
  lane_ = tap_ == nullptr && probes_.empty() && plugged_ && out_.ideal();
}

void Line::set_probe(Probe probe, void* receiver) {
  lane_ = false;
  std::erase_if(probes_, [&](const auto& each) { return each.second == receiver; });
  if (probe != nullptr) probes_.emplace_back(probe, receiver);
}

void Line::set_round_trip(Time round_trip) {
  lane_ = false;
  out_.set_delay(round_trip / 2);
  back_.set_delay(round_trip - round_trip / 2);
}

void Line::set_faults(const WireFaults& ma, const WireFaults& sl) {
  lane_ = false;
  out_.set_faults(ma);
  back_.set_faults(sl);
}

// send_back() and to_slaves() run at least once at every edge. They stand before their callers so
// that the compiler can inline them.
inline void Line::send_back(Time now) {
  for (const auto& [probe, receiver] : probes_) probe(now, receiver);
  const bool slo = chain_.slo();
  faults_.levels(slo, chain_.idle());
  const bool level = plugged_ ? faults_.wire(slo) : open_level_;
  if (level == sent_) return;
  sent_ = level;
  back_.drive(now, level ? 1U : 0U);
}

// Slaves that are not plugged in see a resting line. So they end their frame by timeout and become
// idle.
inline void Line::to_slaves(Time now) {
  const bool ma = !plugged_ || ma_arrived_;
  if (ma && !chain_.ma()) faults_.rising_edge();
  driving_ = true;
  chain_.drive(now, ma, plugged_ && mo_arrived_);
  driving_ = false;
  send_back(now);
}

void Line::on_event(Time now, void* receiver, std::uint64_t action) {
  static_cast<Line*>(receiver)->act(now, static_cast<CableEvent::Action>(action));
}

void Line::act(Time now, CableEvent::Action action) {
  lane_ = false;
  switch (action) {
    case CableEvent::Action::kUnplug:
    case CableEvent::Action::kPlug:
      plugged_ = action == CableEvent::Action::kPlug;
      to_slaves(now);
      break;
    case CableEvent::Action::kSlLow:
    case CableEvent::Action::kSlHigh:
      faults_.stick(action == CableEvent::Action::kSlHigh);
      refresh(now);
      break;
    case CableEvent::Action::kSlFree:
      faults_.stick(std::nullopt);
      refresh(now);
      break;
    case CableEvent::Action::kMaLow:
    case CableEvent::Action::kMaHigh:
      out_.stick(now, action == CableEvent::Action::kMaHigh);
      break;
    case CableEvent::Action::kMaFree:
      out_.stick(now, std::nullopt);
      break;
  }
}

void Line::at_slaves(Time now, void* receiver, unsigned levels) {
  auto* line = static_cast<Line*>(receiver);
  if (line->plugged_ && line->probes_.empty() && line->shifts(levels)) {
    line->shift(now, levels);
    return;
  }
  line->ma_arrived_ = (levels & kMa) != 0;
  const bool mo = (levels & kMo) != 0;
  const bool mo_changes = mo != line->mo_leaving_;
  const bool late = line->mo_late_.delay() != 0;
  line->mo_leaving_ = mo;
  if (mo_changes && !late) line->mo_arrived_ = mo;
  line->to_slaves(now);
  if (mo_changes && late) line->mo_late_.drive(now, mo ? 1U : 0U);
}

void Line::mo_at_slaves(Time now, void* receiver, unsigned levels) {
  auto* line = static_cast<Line*>(receiver);
  line->mo_arrived_ = levels != 0;
  line->to_slaves(now);
}

void Line::slo_changed(Time now, void* receiver, bool /*slo*/) {
  auto* line = static_cast<Line*>(receiver);
  if (!line->driving_) line->send_back(now);
}

void Line::at_master(Time now, void* receiver, unsigned levels) {
  auto* line = static_cast<Line*>(receiver);
  line->received_ = levels != 0;
  line->set_pin(now, line->received_);
}

void Line::set_pin(Time now, bool level) {
  const bool value = faults_.stuck().value_or(level);
  if (value == pin_) return;
  pin_ = value;
  if (tap_ != nullptr) tap_(now, tap_receiver_, Signal::kSl, value);
  output_(now, receiver_, value);
}

}  // namespace mb4::sim
