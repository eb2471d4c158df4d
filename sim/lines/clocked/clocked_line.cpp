// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/clocked/clocked_line.hpp"

#include <optional>

#include "sim/core/random.hpp"
#include "sim/lines/clocked/clocked_frames.hpp"
#include "sim/lines/line_kind.hpp"

namespace mb4::sim {
namespace {

constexpr std::uint64_t kMaPart = 1;  // part numbers of derive_seed()
constexpr std::uint64_t kSlPart = 2;

}  // namespace

ClockedLine::ClockedLine(EventQueue& queue, const ClockedConfig& config, Output output,
                         void* receiver, std::uint64_t seed)
    : out_(queue, config.delay / 2, config.ma, derive_seed(seed, kMaPart), kMa,
           &ClockedLine::at_slaves, this),
      mo_late_(queue, config.mo_late, {}, 0, 0U, &ClockedLine::mo_at_slaves, this),
      back_(queue, config.delay - config.delay / 2, config.sl, derive_seed(seed, kSlPart), 1U,
            &ClockedLine::at_master, this),
      chain_(queue, &ClockedLine::slo_changed, this),
      output_(output),
      receiver_(receiver),
      queue_(queue),
      events_(config.events),
      open_level_(config.open_level),
      mo_wired_(config.mo) {
  for (std::size_t i = 0; i < events_.size(); ++i) {
    queue.post(events_[i].time, &ClockedLine::on_event, this, i);
  }
}

ClockedLine::ClockedLine(const LineSetup& setup)
    : ClockedLine(
          setup.queue, clocked(setup.config),
          [](Time now, void* receiver, bool sl) {
            auto* line = static_cast<ClockedLine*>(receiver);
            line->master_->set_inputs(now, line->index_, sl ? 1U : 0U);
          },
          this, setup.seed) {
  master_ = &setup.master;
  index_ = setup.index;
  guard_.attach(setup.master, setup.index);
  if (!setup.protocol.start_bit) faults_.set_no_start_bit();
}

ClockedLine::~ClockedLine() = default;

void ClockedLine::drive_all(Time now, bool ma, bool mo, unsigned levels) {
  if (tap_ != nullptr) {
    tap_(now, tap_receiver_, Signal::kMa, ma);
    tap_(now, tap_receiver_, Signal::kMo, mo);
  }
  out_.drive(now, levels);
  lane_ = tap_ == nullptr && probes_.empty() && plugged_ && out_.ideal();
}

void ClockedLine::set_probe(Probe probe, void* receiver) {
  lane_ = false;
  std::erase_if(probes_, [&](const auto& each) { return each.second == receiver; });
  if (probe != nullptr) probes_.emplace_back(probe, receiver);
}

void ClockedLine::set_round_trip(Time round_trip) {
  lane_ = false;
  out_.set_delay(round_trip / 2);
  back_.set_delay(round_trip - round_trip / 2);
}

void ClockedLine::set_faults(const WireFaults& ma, const WireFaults& sl) {
  set_wire_faults(kMaWire, ma);
  set_wire_faults(kSlWire, sl);
}

void ClockedLine::set_wire_faults(unsigned wire, const WireFaults& faults) {
  lane_ = false;
  (wire == kMaWire ? out_ : back_).set_faults(faults);
}

void ClockedLine::glitch(Time now, unsigned wire, Time width) {
  lane_ = false;
  (wire == kMaWire ? out_ : back_).glitch(now, width);
}

void ClockedLine::observe(Time now, LineObserver* observer, bool edges) {
  if (frames_ == nullptr && observer != nullptr) {
    frames_ = std::make_unique<ClockedFrames>(now, queue_, *this);
  }
  if (frames_ != nullptr) frames_->tell(now, observer, edges);
}

// send_back() and to_slaves() run at least once at every edge. They stand before their callers so
// that the compiler can inline them.
inline void ClockedLine::send_back(Time now) {
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
inline void ClockedLine::to_slaves(Time now) {
  const bool ma = !plugged_ || ma_arrived_;
  if (ma && !chain_.ma()) faults_.rising_edge();
  driving_ = true;
  chain_.drive(now, ma, plugged_ && mo_arrived_);
  driving_ = false;
  send_back(now);
}

void ClockedLine::on_event(Time now, void* receiver, std::uint64_t event) {
  auto* line = static_cast<ClockedLine*>(receiver);
  line->act(now, line->events_[event].action);
}

void ClockedLine::act(Time now, LineAction action) {
  using What = LineAction::What;
  lane_ = false;
  if (action.what == What::kUnplug || action.what == What::kPlug) {
    plugged_ = action.what == What::kPlug;
    to_slaves(now);
    return;
  }
  const std::optional<bool> level =
      action.what == What::kFree ? std::nullopt : std::optional(action.what == What::kHigh);
  if (action.wire == kMaWire) {
    out_.stick(now, level);
  } else {
    faults_.stick(level);
    refresh(now);
  }
}

void ClockedLine::at_slaves(Time now, void* receiver, unsigned levels) {
  auto* line = static_cast<ClockedLine*>(receiver);
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

void ClockedLine::mo_at_slaves(Time now, void* receiver, unsigned levels) {
  auto* line = static_cast<ClockedLine*>(receiver);
  line->mo_arrived_ = levels != 0;
  line->to_slaves(now);
}

void ClockedLine::slo_changed(Time now, void* receiver, bool /*slo*/) {
  auto* line = static_cast<ClockedLine*>(receiver);
  if (!line->driving_) line->send_back(now);
}

void ClockedLine::at_master(Time now, void* receiver, unsigned levels) {
  auto* line = static_cast<ClockedLine*>(receiver);
  line->received_ = levels != 0;
  line->set_pin(now, line->received_);
}

void ClockedLine::set_pin(Time now, bool level) {
  const bool value = faults_.stuck().value_or(level);
  if (value == pin_) return;
  pin_ = value;
  if (tap_ != nullptr) tap_(now, tap_receiver_, Signal::kSl, value);
  output_(now, receiver_, value);
}

}  // namespace mb4::sim
