// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "bus_model.hpp"

#include <Vmb4_axil.h>
#include <Vmb4_axil___024root.h>
#include <Vmb4_wb.h>
#include <Vmb4_wb___024root.h>
#include <verilated.h>

#include <utility>

#include "bus_managers.hpp"
#include "sim/lines/clocked/clocked_end.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"
#include "sim/model/clock_loop.hpp"
#include "sim/model/clock_source.hpp"
#include "sim/model/verilated_context.hpp"

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
class VerilatedBus final : public BusModel {
 public:
  VerilatedBus(const ChipConfig& chip, std::uint64_t bus_hz, std::uint64_t seed)
      : context_(make_verilated_context(seed)), core_(chip.f_clk_hz), bus_(bus_hz) {
    min_clock_ = period_of(chip.f_clk_hz);
    context_->timeunit(-12);
    context_->timeprecision(-12);
    model_ = std::make_unique<Model>(context_.get(), "mb4");
    Model& m = *model_;
    manager_.rest(m);
    m.ner_i = m.sl1_i = m.sl2_i = 1;
    m.getsens_i = 0;
    m.quirks_i = static_cast<CData>(chip.quirks);
    // Only an edge resets the flops of a Verilated model. So the reset is off for a few clocks
    // first. Assertions are off meanwhile, because random values are not a valid state.
    context_->assertOn(false);
    m.por_ni = 1;
    manager_.reset(m, false);
    for (unsigned i = 0; i < kConditioningEdges; ++i) {
      m.clk_i = i % 2 == 0;
      manager_.clock(m, i % 2 == 0);
      m.eval();
    }
    m.por_ni = 0;
    manager_.reset(m, true);
    m.eval();
    m.por_ni = 1;
    m.eval();
    context_->assertOn(true);
    outputs_ = pack();
  }

  ~VerilatedBus() override {
    // The model's destructor uses the context of the thread, not the model's own one.
    Verilated::threadContextp(context_.get());
    model_->final();
  }

  Time run_clocks(Time limit) override {
    Verilated::threadContextp(context_.get());
    return run_edges(core_, bus_, limit, [this](Time now, bool of_core, bool of_bus) {
      Model& m = *model_;
      bool rises = false;
      if (of_bus) {
        rises = bus_.edge();
        manager_.clock(m, rises);
        if (rises && (!access_.done || manager_.owed())) take_answer();
      }
      if (of_core) {
        m.clk_i = core_.edge();
        cycles_ += m.clk_i;
      }
      context_->time(now);
      m.eval();
      if (rises) drive();
      const Outputs before = std::exchange(outputs_, pack());
      return outputs_ != before;
    });
  }

  void set_inputs(Time /*now*/, unsigned line, unsigned levels) override {
    // No output depends on SL before a clock edge.
    (line == 0 ? model_->sl1_i : model_->sl2_i) = levels != 0;
  }
  void set_clock(Time now, std::uint64_t hz) override {
    core_.retune(hz, now);
    may_run_at(hz);
  }
  unsigned half_clocks(unsigned /*line*/) const override { return half_of(*model_); }

  void set_reset(Time now, bool active) override {
    manager_.reset(*model_, active);
    evaluate(now);
  }
  void set_getsens(Time now, bool level) override {
    model_->getsens_i = level;
    evaluate(now);
  }
  void set_ner(Time now, bool level) override {
    model_->ner_i = level;
    evaluate(now);
  }
  bool clk() const override { return model_->clk_i != 0; }
  bool sl(unsigned line) const override { return (line == 0 ? model_->sl1_i : model_->sl2_i) != 0; }

  void begin(const WordAccess& access) override {
    access_ = access;
    fresh_ = true;
  }
  const WordAccess& access() const override { return access_; }
  void give_up() override {
    manager_.drop(*model_);
    access_.done = true;
    fresh_ = false;
  }

 private:
  // After these the synchronisers of the resets have settled from any state.
  static constexpr unsigned kConditioningEdges = 32;

  // Before a rising edge of the bus.
  void take_answer() {
    if (manager_.before(*model_, access_)) {
      access_.done = true;
      answered_ = !answered_;
    }
  }
  // After it.
  void drive() {
    manager_.after(*model_);
    if (fresh_) manager_.begin(*model_, access_);
    fresh_ = false;
  }

  void evaluate(Time now) {
    Verilated::threadContextp(context_.get());
    context_->time(now);
    model_->eval();
    outputs_ = pack();
  }

  Outputs pack() const {
    const Model& m = *model_;
    return m.ma1_o * of_line(0, kMaPin) | m.mo1_o * of_line(0, kMoPin) |
           m.ma2_o * of_line(1, kMaPin) | m.mo2_o * of_line(1, kMoPin) | m.eot_o * kEot |
           m.ner_low_o * kNerLow | m.irq_o * kIrq | m.clkeni_o * kClkeni |
           static_cast<unsigned>(answered_) * kAnswered;
  }

  static constexpr Outputs kAnswered = own(4);  // changes at the end of each access

  std::unique_ptr<VerilatedContext> context_;  // outlives the model
  std::unique_ptr<Model> model_;
  Manager manager_;
  ClockSource core_;
  ClockSource bus_;
  WordAccess access_;
  bool fresh_ = false;  // the access has not been put on the pins
  bool answered_ = false;
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
