// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/live_mb4.hpp"

#include <utility>

#include "sim/core/trace_error.hpp"
#include "sim/masters/mb4/hints/setup_hints.hpp"
#include "sim/masters/mb4/model/preset_chips.hpp"
#include "sim/masters/mb4/model/watched_chip.hpp"

namespace mb4::sim {
namespace {

constexpr std::size_t index_of(Pin pin) { return static_cast<std::size_t>(pin); }

std::unique_ptr<ChipModel> make_chip(const MasterSetup& setup) {
  if (setup.chip.features != 0) {
    if (setup.trace != nullptr) {
      throw TraceError(setup.trace->path + ": only the full chip writes a waveform");
    }
    return make_preset_chip(setup.chip, setup.seed);
  }
  if (setup.trace != nullptr) return make_traced_chip(setup.chip, setup.seed, *setup.trace);
  return setup.plain ? make_plain_chip(setup.chip, setup.seed)
                     : make_fast_chip(setup.chip, setup.seed);
}

}  // namespace

LiveMb4::LiveMb4(const MasterSetup& setup)
    : outside_(setup.outside),
      config_(setup.chip),
      interface_(setup.host.interface),
      lines_(setup.lines),
      clk_connected_(setup.chip.f_clk_hz != 0),
      spi_(outside_, SpiTiming::for_frequency(setup.host.sclk_hz), kSpiPins),
      spi2_(outside_, SpiTiming::for_frequency(setup.host.sclk2_hz), kSpi2Pins),
      bus_(outside_,
           interface_ == HostInterface::kMotorola ? ParallelMode::kMotorola : ParallelMode::kIntel,
           ParallelTiming::for_cycle(setup.host.cycle), kParallelPins),
      chip_(make_chip(setup)) {
  for (std::size_t index = 0; index < index_of(Pin::kEot); ++index) {
    const Pin pin = static_cast<Pin>(index);
    levels_[index] = pulled_up(pin) || pin == Pin::kCfgspi;  // CFGSPI is a strap
    if (levels_[index]) host_check_.edge(0, pin, true);
  }
}

LiveMb4::~LiveMb4() = default;

void LiveMb4::start_trace(const TraceFile& file) {
  auto traced = make_traced_chip(config_, *chip_, file);
  const bool pair = drives_pair();
  auto watched = std::make_unique<WatchedChip>(std::move(chip_), std::move(traced));
  watched->drive_pair(pair);
  watched_ = watched.get();
  chip_ = std::move(watched);
}

void LiveMb4::stop_trace() {
  if (watched_ == nullptr) return;
  const bool pair = drives_pair();
  std::unique_ptr<ChipModel> chip = std::exchange(watched_, nullptr)->release();
  chip->drive_pair(pair);
  chip_ = std::move(chip);
}

void LiveMb4::power_on() {
  if (interface_.parallel) {
    bus_.rest();
  } else if (interface_ == HostInterface::kSpi2) {
    outside_.set_pin(Pin::kDb4, true);  // NCS of SPI2
    outside_.set_pin(Pin::kNwrE, false);
  }
  outside_.run_until(kResetLow);
  outside_.set_pin(Pin::kNres, true);
}

HostModel* LiveMb4::host(std::string_view name) {
  if (name == "spi") return &spi_;
  if (name == "spi2") return &spi2_;
  return name == "bus" ? &bus_ : nullptr;
}

bool LiveMb4::can_set(Pin pin) const {
  if (is_output(pin)) return false;
  if (pin == Pin::kSl1) return !has_line(0);
  if (pin == Pin::kSl2) return !has_line(1) && !drives_pair();
  if (pin == Pin::kClk) return !clk_connected_;
  return true;
}

// Level of an input pin as it is driven.
bool LiveMb4::input(Pin pin) const {
  if (pin == Pin::kSl1) return chip_->sl(0);
  if (pin == Pin::kSl2) return chip_->sl(1);
  return levels_[index_of(pin)];
}

inline void LiveMb4::drive(Time now, Pin pin, bool level) {
  const bool was_paired = chip_->paired();
  chip_->set_input(now, pin, level);
  // CFGIF decides whether MA2 is the inverse of another pin.
  if (chip_->paired() == was_paired) return;
  chip_->drive_pair(drives_pair());
  if (!has_line(1)) chip_->set_input(now, Pin::kSl2, !(drives_pair() && chip_->sl(0)));
}

void LiveMb4::set_pin(Time now, Pin pin, bool level) {
  if (pin < Pin::kClk) {  // these are always inputs
    if (levels_[index_of(pin)] == level) return;
  } else {
    if (!can_set(pin)) return;
    if (pin == Pin::kClk) clk_by_hand_ = true;
    if (pin == Pin::kNer) {
      ner_pulled_ = !level;
      drive(now, pin, this->pin(pin));
      return;
    }
    if (input(pin) == level) return;
  }
  levels_[index_of(pin)] = level;
  host_check_.edge(now, pin, level);
  if (pin == Pin::kNres) {
    setup_.restart();
  } else {
    writes_.edge(pin, level, levels_, setup_);
  }
  if (observer_ != nullptr) observer_->pin_changed(pin, level);
  drive(now, pin, level);
}

void LiveMb4::own_outputs_changed(Time now, MasterModel::Outputs changed) {
  if ((changed & ChipModel::kEot) != 0 && !pin(Pin::kEot)) setup_.frame();
  if ((changed & ChipModel::kEot) != 0 && observer_ != nullptr) {
    observer_->pin_changed(Pin::kEot, pin(Pin::kEot));
  }
  if ((changed & ChipModel::kNerLow) != 0) chip_->set_input(now, Pin::kNer, pin(Pin::kNer));
}

std::vector<Hint> LiveMb4::hints(std::span<const HintLine> lines, std::uint64_t missed) {
  std::vector<Hint> found = host_hints(setup_.opcodes(), host_check_);
  if (setup_.setup() == nullptr) return found;
  const SetupClock clock{clk_by_hand_ ? std::nullopt : std::optional(config_.f_clk_hz),
                         config_.f_osc_hz};
  for (Hint& hint : setup_hints(*setup_.setup(), config_.features, clock, lines, missed)) {
    found.push_back(std::move(hint));
  }
  return found;
}

void LiveMb4::set_observer(PinObserver* observer) {
  observer_ = observer;
  if (observer == nullptr) return;
  for (std::size_t index = 0; index <= index_of(Pin::kEot); ++index) {
    const Pin pin = static_cast<Pin>(index);
    observer->pin_changed(pin, is_output(pin) ? this->pin(pin) : input(pin));
  }
}

bool LiveMb4::pin(Pin pin) const {
  const std::size_t index = index_of(pin);
  if (index <= index_of(Pin::kDb7) && ((chip_->db_enable() >> index) & 1U) != 0) {
    return ((chip_->db_out() >> index) & 1U) != 0;
  }
  const MasterModel::Outputs outputs = chip_->outputs();
  switch (pin) {
    case Pin::kEot:
      return (outputs & ChipModel::kEot) != 0;
    case Pin::kMa1:
      return (outputs & ChipModel::kMa1) != 0;
    case Pin::kMa2:
      return (outputs & ChipModel::kMa2) != 0;
    case Pin::kMo1:
      return (outputs & ChipModel::kMo1) != 0;
    case Pin::kMo2:
      return (outputs & ChipModel::kMo2) != 0;
    case Pin::kClk:
      return chip_->clk();
    case Pin::kNer:
      return !ner_pulled_ && (outputs & ChipModel::kNerLow) == 0;
    default:
      return input(pin);
  }
}

}  // namespace mb4::sim
