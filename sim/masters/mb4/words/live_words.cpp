// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/words/live_words.hpp"

#include "sim/lines/clocked/clocked_end.hpp"

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
      interface_(setup.host.interface.key),
      lines_(setup.lines),
      model_(make_model(setup)),
      host_(outside_, *model_, kPsPerSecond / setup.host.bus_hz + 1, kLongestAccess, kLastAddress) {
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
