// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/words/live_words.hpp"

#include "sim/lines/clocked/clocked_end.hpp"
#include "sim/masters/mb4/hints/setup_hints.hpp"

namespace mb4::sim {
namespace {

constexpr std::uint32_t kLastAddress = 0xFFF;
// Clocks of the bus. With the slowest core that counts as running, 1 / 128 of the bus clock, a
// snapshot takes 140 clocks of the core and the queue 128 bytes of at most 4 clocks each.
constexpr unsigned kLongestAccess = 100'000;

std::unique_ptr<BusModel> make_model(const MasterSetup& setup) {
  if (setup.trace != nullptr) {
    throw TraceError(setup.trace->path + ": a bus of words has no waveform");
  }
  const auto make = setup.host.interface.key == "axi" ? make_axi_bus_model : make_wb_bus_model;
  return make(setup.chip, setup.host.bus_hz, setup.seed);
}

}  // namespace

LiveWords::LiveWords(const MasterSetup& setup)
    : outside_(setup.outside),
      config_(setup.chip),
      interface_(setup.host.interface.key),
      lines_(setup.lines),
      model_(make_model(setup)),
      host_(outside_, *model_, kPsPerSecond / setup.host.bus_hz + 1, kLongestAccess, kLastAddress) {
}

std::optional<std::uint8_t> LiveWords::Host::write(std::uint32_t address, std::uint32_t data,
                                                   std::uint8_t strobe) {
  constexpr std::uint32_t kRegisters = 0x100;
  for (unsigned byte = 0; byte < 4 && address < kRegisters; ++byte) {
    if ((strobe >> byte & 1U) == 0) continue;
    setup.written(static_cast<std::uint8_t>(address + byte),
                  static_cast<std::uint8_t>(data >> (8 * byte)));
  }
  return PollingWordHost::write(address, data, strobe);
}

// A bus of words has no SPI, and its clock is there.
std::vector<Hint> LiveWords::hints(std::span<const HintLine> lines, std::uint64_t missed) {
  const WrittenSetup* const setup = host_.setup.setup();
  return setup == nullptr
             ? std::vector<Hint>{}
             : setup_hints(*setup, config_.features, {config_.f_clk_hz, 0}, lines, missed);
}

void LiveWords::power_on() {
  outside_.run_until(kResetLow);
  outside_.set_pin(Pin::kNres, true);
}

bool LiveWords::can_set(Pin pin) const {
  if (pin == Pin::kSl1) return !has_line(0);
  if (pin == Pin::kSl2) return !has_line(1);
  return pin == Pin::kNres || pin == Pin::kGetsens || pin == Pin::kNer;
}

void LiveWords::set_pin(Time now, Pin pin, bool level) {
  if (!can_set(pin)) return;
  if (pin == Pin::kNres) {
    nres_ = level;
    host_.setup.restart();
    model_->set_reset(now, !level);
  } else if (pin == Pin::kGetsens) {
    getsens_ = level;
    model_->set_getsens(now, level);
  } else if (pin == Pin::kNer) {
    ner_pulled_ = !level;
    model_->set_ner(now, this->pin(Pin::kNer));
  } else {
    model_->set_inputs(now, pin == Pin::kSl1 ? 0 : 1, level ? 1 : 0);
  }
}

void LiveWords::own_outputs_changed(Time now, MasterModel::Outputs changed) {
  if ((changed & BusModel::kEot) != 0 && !pin(Pin::kEot)) host_.setup.frame();
  if ((changed & BusModel::kNerLow) != 0) model_->set_ner(now, pin(Pin::kNer));
}

bool LiveWords::pin(Pin pin) const {
  const auto output = [&](MasterModel::Outputs bit) { return (model_->outputs() & bit) != 0; };
  switch (pin) {
    case Pin::kNres:
      return nres_;
    case Pin::kGetsens:
      return getsens_;
    case Pin::kSl1:
      return model_->sl(0);
    case Pin::kSl2:
      return model_->sl(1);
    case Pin::kClk:
      return model_->clk();
    case Pin::kNer:
      return !ner_pulled_ && !output(BusModel::kNerLow);
    case Pin::kEot:
      return output(BusModel::kEot);
    case Pin::kMa1:
      return output(MasterModel::of_line(0, kMaPin));
    case Pin::kMa2:
      return output(MasterModel::of_line(1, kMaPin));
    case Pin::kMo1:
      return output(MasterModel::of_line(0, kMoPin));
    case Pin::kMo2:
      return output(MasterModel::of_line(1, kMoPin));
    case Pin::kIrq:
      return output(BusModel::kIrq);
    case Pin::kClkeni:
      return output(BusModel::kClkeni);
    default:
      return false;
  }
}

}  // namespace mb4::sim
