// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/line.hpp"

namespace mb4::sim {

Line::Line(EventQueue& queue, Time round_trip, Output output, void* receiver)
    : out_(queue, round_trip / 2, &Line::at_slaves, this),
      back_(queue, round_trip - round_trip / 2, &Line::at_master, this),
      chain_(queue, &Line::slo_changed, this),
      output_(output),
      receiver_(receiver) {}

void Line::drive(Time now, bool ma, bool mo) {
  monitor_.edge(now, ma);
  out_.drive(now, (ma ? kMa : 0U) | (mo ? kMo : 0U));
}

void Line::at_slaves(Time now, void* receiver, unsigned levels) {
  auto* line = static_cast<Line*>(receiver);
  const bool ma = (levels & kMa) != 0;
  if (ma && !line->chain_.ma()) line->faults_.rising_edge();
  line->driving_ = true;
  line->chain_.drive(now, ma, (levels & kMo) != 0);
  line->driving_ = false;
  line->send_back(now);
}

void Line::slo_changed(Time now, void* receiver, bool /*slo*/) {
  auto* line = static_cast<Line*>(receiver);
  if (!line->driving_) line->send_back(now);
}

void Line::send_back(Time now) {
  if (probe_ != nullptr) probe_(now, probe_receiver_);
  faults_.levels(chain_.slo(), chain_.idle());
  const bool level = faults_.wire(chain_.slo());
  if (level == sent_) return;
  sent_ = level;
  back_.drive(now, level ? 1U : 0U);
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
  output_(now, receiver_, value);
}

}  // namespace mb4::sim
