// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/duplex/duplex_line.hpp"

#include <algorithm>
#include <cassert>

#include "sim/core/random.hpp"
#include "sim/lines/line_kind.hpp"

namespace mb4::sim {
namespace {

constexpr std::uint64_t kOutPart = 1;  // part numbers of derive_seed()
constexpr std::uint64_t kInPart = 2;
constexpr std::uint64_t kAnswerPart = 3;
constexpr std::uint64_t kMasterPart = 4;
constexpr unsigned kLevel = 1;  // bits of a Wire
constexpr unsigned kDriven = 2;
constexpr unsigned kFirstPlace = 4;  // MB4SIM_EDGE_OUT

}  // namespace

// ---- What the device does -----------------------------------------------------------------------

void DuplexSlave::set_drive(Time now, DuplexDrive drive) {
  drive_ = drive;
  if (line_ != nullptr) line_->set_pins(now, DuplexLine::kDevice, drive);
}

void DuplexSlave::call_at(Time time, std::uint64_t word) {
  line_->queue_.post(time, &DuplexLine::on_timer, line_, word);
}

void DuplexSlave::announce_frame(Time start) {
  ++begun_;
  if (line_ != nullptr) line_->frame_begins(start);
}

std::vector<unsigned> DuplexSlave::begin_frame(Time now) {
  announce_frame(now);
  return take_flips(begun_);
}

void DuplexSlave::end_frame(Time end, std::optional<std::uint64_t> edges) {
  if (line_ != nullptr) line_->frame_ends(end, edges);
}

Time DuplexSlave::enable_time() const { return line_ == nullptr ? 0 : line_->enable_; }
Time DuplexSlave::disable_time() const { return line_ == nullptr ? 0 : line_->disable_; }

// ---- The line -----------------------------------------------------------------------------------

DuplexLine::DuplexLine(const LineSetup& setup)
    : queue_(setup.queue),
      out_(setup.queue, setup.config.delay / 2, duplex(setup.config).out,
           derive_seed(setup.seed, kOutPart), kLevel, &DuplexLine::at_device, this),
      in_(setup.queue, setup.config.delay - setup.config.delay / 2, duplex(setup.config).in,
          derive_seed(setup.seed, kInPart), kLevel, &DuplexLine::at_master, this),
      enable_(duplex(setup.config).enable),
      disable_(duplex(setup.config).disable),
      answer_errors_(duplex(setup.config).answer_errors, derive_seed(setup.seed, kAnswerPart)),
      master_errors_(duplex(setup.config).master_errors, derive_seed(setup.seed, kMasterPart)),
      master_(setup.master),
      index_(setup.index),
      events_(setup.config.events) {
  for (std::size_t i = 0; i < events_.size(); ++i) {
    queue_.post(events_[i].time, &DuplexLine::on_event, this, i);
  }
}

DuplexLine::~DuplexLine() = default;

void DuplexLine::add(std::unique_ptr<DuplexSlave> slave) {
  assert(slave_ == nullptr);
  slave_ = std::move(slave);
  slave_->line_ = this;
  slave_->errors_.answer = answer_errors_;
  slave_->errors_.master = master_errors_;
}

void DuplexLine::drive(Time now, unsigned levels) {
  set_pins(now, kMaster, {(levels & kOutPin) != 0, (levels & kEnablePin) != 0});
}

// The driver follows its pin late, the level at once.
void DuplexLine::set_pins(Time now, unsigned end, DuplexDrive pins) {
  End& here = ends_[end];
  const bool switches = pins.enable != here.pins.enable;
  here.pins = pins;
  if (switches) {
    ++here.switches;
    if (const Time after = pins.enable ? enable_ : disable_; after != 0) {
      queue_.post(now + after, &DuplexLine::on_switch, this,
                  (std::uint64_t{here.switches} << 1U) | end);
    } else {
      here.on = pins.enable;
    }
  }
  changed(now, end);
}

void DuplexLine::on_switch(Time now, void* receiver, std::uint64_t word) {
  auto* line = static_cast<DuplexLine*>(receiver);
  const unsigned end = word & 1U;
  End& here = line->ends_[end];
  if (here.switches != static_cast<unsigned>(word >> 1U)) return;  // a later one follows
  here.on = here.pins.enable;
  line->changed(now, end);
}

// What an end drives may have changed.
void DuplexLine::changed(Time now, unsigned end) {
  End& here = ends_[end];
  here.mute = end == kDevice && slave_ != nullptr && slave_->silent();
  const bool drives = here.drives() && (end == kMaster || connected());
  const unsigned levels = (drives ? kDriven : 0U) | (!drives || here.pins.level ? kLevel : 0U);
  (end == kMaster ? out_ : in_).drive(now, levels);
  look(now, end);
}

void DuplexLine::on_arrival(Time now, void* receiver, unsigned levels, unsigned end) {
  auto* line = static_cast<DuplexLine*>(receiver);
  line->ends_[end].far = (levels & kLevel) != 0;
  line->ends_[end].far_on = (levels & kDriven) != 0;
  line->look(now, end);
}
void DuplexLine::at_master(Time now, void* receiver, unsigned levels) {
  on_arrival(now, receiver, levels, kMaster);
}
void DuplexLine::at_device(Time now, void* receiver, unsigned levels) {
  on_arrival(now, receiver, levels, kDevice);
}

// What an end sees may have changed.
void DuplexLine::look(Time now, unsigned end) {
  End& here = ends_[end];
  const bool cable = end == kMaster || connected();
  const bool seen = here.stuck.value_or(here.sends() && (!cable || here.far));
  const bool changes = seen != here.seen;
  here.seen = seen;
  watch_contention(now);
  if (edges_) tell_edges(now);
  if (end == kDevice) {
    if (changes && frame_) ++frame_->edges;
    for (const auto& [probe, receiver] : probes_) probe(now, receiver);
  }
  if (!changes) return;
  if (end == kMaster) {
    master_.set_inputs(now, index_, seen ? 1U : 0U);
  } else if (slave_ != nullptr) {
    slave_->line_changed(now, seen);
  }
}

void DuplexLine::watch_contention(Time now) {
  const bool both = (ends_[kMaster].drives() && ends_[kMaster].far_on) ||
                    (ends_[kDevice].drives() && ends_[kDevice].far_on && connected());
  if (both == both_) return;
  both_ = both;
  if (!both) {
    contention_.total += now - both_since_;
    contention_.longest = std::max(contention_.longest, now - both_since_);
    return;
  }
  both_since_ = now;
  if (contention_.times++ == 0) contention_.first = now;
}

DuplexContention DuplexLine::contention(Time now) const {
  DuplexContention all = contention_;
  if (both_) {
    all.total += now - both_since_;
    all.longest = std::max(all.longest, now - both_since_);
  }
  return all;
}

// ---- The cable ----------------------------------------------------------------------------------

void DuplexLine::detach(Time now, std::size_t index) {
  attached_ = index != 0;
  changed(now, kDevice);
}

Time DuplexLine::round_trip() const { return out_.delay() + in_.delay(); }

void DuplexLine::set_round_trip(Time round_trip) {
  out_.set_delay(round_trip / 2);
  in_.set_delay(round_trip - round_trip / 2);
}

WireFaults DuplexLine::wire_faults(unsigned wire) const {
  return wire == kOut ? out_.faults() : in_.faults();
}

void DuplexLine::set_wire_faults(unsigned wire, const WireFaults& faults) {
  if (wire != kIn) out_.set_faults(faults);
  if (wire != kOut) in_.set_faults(faults);
}

void DuplexLine::glitch(Time now, unsigned wire, Time width) {
  if (wire != kIn) out_.glitch(now, width);
  if (wire != kOut) in_.glitch(now, width);
}

void DuplexLine::on_timer(Time now, void* receiver, std::uint64_t word) {
  static_cast<DuplexLine*>(receiver)->slave_->timer(now, word);
}

void DuplexLine::on_event(Time now, void* receiver, std::uint64_t event) {
  auto* line = static_cast<DuplexLine*>(receiver);
  line->act(now, line->events_[event].action);
}

void DuplexLine::act(Time now, LineAction action) {
  using What = LineAction::What;
  if (action.what == What::kUnplug || action.what == What::kPlug) {
    plugged_ = action.what == What::kPlug;
    changed(now, kDevice);
    return;
  }
  const std::optional<bool> level =
      action.what == What::kFree ? std::nullopt : std::optional(action.what == What::kHigh);
  for (const unsigned end : {kMaster, kDevice}) {
    if (action.wire == (end == kMaster ? kOut : kIn)) continue;
    ends_[end].stuck = level;
    look(now, end);
  }
}

// ---- Frames and edges ---------------------------------------------------------------------------

void DuplexLine::flip(std::uint64_t frame, std::vector<unsigned> bits, FlipWatch watch) {
  if (slave_ != nullptr) slave_->flip(frame, bits, watch);
}

void DuplexLine::frame_begins(Time now) {
  if (frame_) frame_ends(now);
  frame_ = LineFrame{slave_->begun(), now, 0, 0, false};
  if (observer_ != nullptr) observer_->frame_begun();
}

void DuplexLine::frame_ends(Time now, std::optional<std::uint64_t> edges) {
  if (!frame_) return;
  frame_->end = now;
  frame_->edges = edges.value_or(frame_->edges);
  const LineFrame over = *std::exchange(frame_, std::nullopt);
  if (observer_ != nullptr) observer_->frame_over(over);
}

void DuplexLine::observe(Time now, LineObserver* observer, bool edges) {
  observer_ = observer;
  edges_ = observer != nullptr && edges;
  if (!edges_) return;
  told_ = levels();
  for (bool& level : told_) level = !level;  // so that each is told
  tell_edges(now);
}

// In the order of MB4SIM_EDGE_OUT, _EN, _IN, _ENCODER.
std::array<bool, 4> DuplexLine::levels() const {
  const End& master = ends_[kMaster];
  return {master.pins.level, master.pins.enable, master.seen, ends_[kDevice].sends()};
}

void DuplexLine::tell_edges(Time now) {
  const std::array<bool, 4> present = levels();
  for (unsigned i = 0; i < present.size(); ++i) {
    if (present[i] == told_[i]) continue;
    told_[i] = present[i];
    observer_->edge(now, kFirstPlace + i, present[i]);
  }
}

void DuplexLine::set_probe(Probe probe, void* receiver) {
  std::erase_if(probes_, [&](const auto& each) { return each.second == receiver; });
  if (probe != nullptr) probes_.emplace_back(probe, receiver);
}

}  // namespace mb4::sim
