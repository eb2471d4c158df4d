// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/pru/live_pru.hpp"

#include <utility>

#include "sim/lines/clocked/clocked_end.hpp"

namespace mb4::sim {
namespace {

constexpr unsigned kLongestPruAccess = 1000;  // clocks
constexpr std::uint32_t kLastPruAddress = 0xFFF;

constexpr Pin kPruRst{0};
constexpr Pin kPruMa{1};
constexpr Pin kPruSl{2};
constexpr Pin kPruIrq{3};
constexpr Pin kPruTrigger{4};

constexpr std::pair<std::string_view, Pin> kPruPins[] = {{"rst_ni", kPruRst},
                                                         {"ma_o", kPruMa},
                                                         {"sl_i", kPruSl},
                                                         {"irq_o", kPruIrq},
                                                         {"trigger_i", kPruTrigger}};

}  // namespace

LivePru::LivePru(const MasterSetup& setup)
    : outside_(setup.outside),
      has_line_((setup.lines & MasterModel::of_line(0, kMaPin)) != 0),
      model_(make_pru_model(setup.chip, setup.seed, setup.plain)),
      host_(outside_, *model_, kPsPerSecond / setup.chip.f_clk_hz + 1, kLongestPruAccess,
            kLastPruAddress) {
  if (setup.trace != nullptr) model_->start_wave(*setup.trace);
}

void LivePru::power_on() {
  outside_.run_until(kResetLow);
  outside_.set_pin(kPruRst, true);
}

bool LivePru::can_set(Pin pin) const {
  return pin == kPruRst || pin == kPruTrigger || (pin == kPruSl && !has_line_);
}

void LivePru::set_pin(Time now, Pin pin, bool level) {
  if (!can_set(pin)) return;
  if (pin == kPruRst) {
    rst_n_ = level;
    model_->set_reset(now, !level);
  } else if (pin == kPruTrigger) {
    model_->set_trigger(now, level);
  } else {
    model_->set_inputs(now, 0, level ? 1 : 0);
  }
}

bool LivePru::pin(Pin pin) const {
  const MasterModel::Outputs outputs = model_->outputs();
  if (pin == kPruRst) return rst_n_;
  if (pin == kPruSl) return model_->sl();
  if (pin == kPruMa) return (outputs & MasterModel::of_line(0, kMaPin)) != 0;
  if (pin == kPruTrigger) return model_->trigger();
  return (outputs & PruModel::kIrq) != 0;
}

std::optional<Pin> pru_pin_by_name(std::string_view name) { return find_pin(kPruPins, name); }

}  // namespace mb4::sim
