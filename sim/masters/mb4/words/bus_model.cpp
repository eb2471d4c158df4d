// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "bus_model.hpp"

#include <Vmb4_axil.h>
#include <Vmb4_axil___024root.h>
#include <Vmb4_wb.h>
#include <Vmb4_wb___024root.h>
#include <verilated.h>

#include "sim/lines/clocked/clocked_end.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"
#include "sim/masters/mb4/words/wishbone_manager.hpp"
#include "sim/model/axi_manager.hpp"
#include "sim/model/two_clock_master.hpp"

namespace mb4::sim {
namespace {

// Half a period of MA in clocks (public.vlt).
unsigned half_of(const Vmb4_axil& model) {
  return half_ma_clocks(
      model.rootp->mb4_axil__DOT__u_bus__DOT__u_engine__DOT__u_lines__DOT__u_timebase__DOT__len_q);
}
unsigned half_of(const Vmb4_wb& model) {
  return half_ma_clocks(
      model.rootp->mb4_wb__DOT__u_bus__DOT__u_engine__DOT__u_lines__DOT__u_timebase__DOT__len_q);
}

template <typename Model, typename Manager>
class VerilatedBus final
    : public TwoClockMaster<VerilatedBus<Model, Manager>, BusModel, Model, Manager> {
  using Base = TwoClockMaster<VerilatedBus<Model, Manager>, BusModel, Model, Manager>;
  friend Base;
  using Base::model_;
  using Outputs = MasterModel::Outputs;

 public:
  VerilatedBus(const ChipConfig& chip, std::uint64_t bus_hz, std::uint64_t seed)
      : Base(chip.f_clk_hz, bus_hz, seed, "mb4") {
    Model& m = *model_;
    m.ner_i = m.sl1_i = m.sl2_i = 1;
    m.getsens_i = 0;
    m.quirks_i = static_cast<CData>(chip.quirks);
    this->reset_by_edges([this](bool active) {
      model_->por_ni = !active;
      this->manager_.reset(*model_, active);
    });
    m.por_ni = 1;
    this->evaluate(0);
  }

  void set_inputs(Time /*now*/, unsigned line, unsigned levels) override {
    // No output depends on SL before a clock edge.
    (line == 0 ? model_->sl1_i : model_->sl2_i) = levels != 0;
  }
  unsigned half_clocks(unsigned /*line*/) const override { return half_of(*model_); }

  void set_reset(Time now, bool active) override {
    this->manager_.reset(*model_, active);
    this->evaluate(now);
  }
  void set_getsens(Time now, bool level) override {
    model_->getsens_i = level;
    this->evaluate(now);
  }
  void set_ner(Time now, bool level) override {
    model_->ner_i = level;
    this->evaluate(now);
  }
  bool clk() const override { return model_->clk_i != 0; }
  bool sl(unsigned line) const override { return (line == 0 ? model_->sl1_i : model_->sl2_i) != 0; }

 private:
  // What TwoClockMaster asks for.
  bool falls_quietly() { return false; }
  Outputs pack() const {
    const Model& m = *model_;
    return m.ma1_o * MasterModel::of_line(0, kMaPin) | m.mo1_o * MasterModel::of_line(0, kMoPin) |
           m.ma2_o * MasterModel::of_line(1, kMaPin) | m.mo2_o * MasterModel::of_line(1, kMoPin) |
           m.eot_o * BusModel::kEot | m.ner_low_o * BusModel::kNerLow | m.irq_o * BusModel::kIrq |
           m.clkeni_o * BusModel::kClkeni;
  }
};

}  // namespace

std::unique_ptr<BusModel> make_axi_bus_model(const ChipConfig& chip, std::uint64_t bus_hz,
                                             std::uint64_t seed) {
  return std::make_unique<VerilatedBus<Vmb4_axil, AxiManager<Vmb4_axil>>>(chip, bus_hz, seed);
}

std::unique_ptr<BusModel> make_wb_bus_model(const ChipConfig& chip, std::uint64_t bus_hz,
                                            std::uint64_t seed) {
  return std::make_unique<VerilatedBus<Vmb4_wb, WishboneManager<Vmb4_wb>>>(chip, bus_hz, seed);
}

}  // namespace mb4::sim
