// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/clb/live_clb.hpp"

#include <utility>

#include "sim/lines/clocked/clocked_end.hpp"

namespace mb4::sim {
namespace {

constexpr unsigned kLongestClbAccess = 1000;  // clocks
constexpr std::uint32_t kLastClbAddress = 0xFFF;

constexpr Pin kClbRst{0};
constexpr Pin kClbMa{1};
constexpr Pin kClbSl{2};
constexpr Pin kClbIrq{3};
constexpr Pin kClbSpiClk{4};
constexpr Pin kClbTxen{5};

constexpr std::pair<std::string_view, Pin> kClbPins[] = {
    {"rst_ni", kClbRst}, {"ma_o", kClbMa},          {"sl_i", kClbSl},
    {"irq_o", kClbIrq},  {"spi_clk_o", kClbSpiClk}, {"txen_o", kClbTxen}};

}  // namespace

LiveClb::LiveClb(const MasterSetup& setup)
    : outside_(setup.outside),
      has_line_((setup.lines & MasterModel::of_line(0, kMaPin)) != 0),
      model_(make_clb_model(setup.chip, setup.seed, setup.plain)),
      host_(outside_, *model_,
            setup.chip.f_clk_hz == 0 ? kPsPerUs : kPsPerSecond / setup.chip.f_clk_hz + 1,
            kLongestClbAccess, kLastClbAddress) {
  if (setup.trace != nullptr) model_->start_wave(*setup.trace);
}

void LiveClb::power_on() {
  outside_.run_until(kResetLow);
  outside_.set_pin(kClbRst, true);
}

bool LiveClb::can_set(Pin pin) const { return pin == kClbRst || (pin == kClbSl && !has_line_); }

void LiveClb::set_pin(Time now, Pin pin, bool level) {
  if (!can_set(pin)) return;
  if (pin == kClbRst) {
    rst_n_ = level;
    model_->set_reset(now, !level);
  } else {
    model_->set_inputs(now, 0, level ? 1 : 0);
  }
}

bool LiveClb::pin(Pin pin) const {
  const MasterModel::Outputs outputs = model_->outputs();
  if (pin == kClbRst) return rst_n_;
  if (pin == kClbSl) return model_->sl();
  if (pin == kClbMa) return (outputs & MasterModel::of_line(0, kMaPin)) != 0;
  if (pin == kClbIrq) return (outputs & ClbModel::kIrq) != 0;
  if (pin == kClbSpiClk) return (outputs & ClbModel::kSpiClk) != 0;
  return (outputs & ClbModel::kTxen) != 0;
}

std::optional<Pin> clb_pin_by_name(std::string_view name) { return find_pin(kClbPins, name); }

}  // namespace mb4::sim
