// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl/dsl_rtl.hpp"

#include <Vdsl.h>
#include <Vdsl___024root.h>
#include <verilated.h>

// Made by sim/model/signal_list.py.
#include <Vdsl_wave.hpp>
#include <utility>
#include <vector>

// Some packages of Verilator leave this number empty. The header holds what 5.006 writes.
#if VERILATOR_VERSION_INTEGER + 0 == 5006000
#include <Vdsl_edge.hpp>
#ifndef MODEL_RUNS_WHOLE
#define MB4_DSL_IN_PARTS
#endif
#endif

#include "sim/masters/dsl_model/frame_plan.hpp"
#include "sim/model/axi_manager.hpp"
#include "sim/model/one_clock_master.hpp"
#include "sim/model/two_clock_master.hpp"

namespace mb4::sim {
namespace {

constexpr const char* kScope = "mb4sim.dsl_bus";

#ifdef MB4_DSL_IN_PARTS
// eval() must not find the edges that have been.
bool know_edges(Vdsl& model) {
  model.rootp->__Vtrigrprev__TOP__clk_i = model.clk_i;
  model.rootp->__Vtrigrprev__TOP__s_axi_aclk = model.s_axi_aclk;
  return true;
}

class DslSteps {
 public:
  void inputs(Vdsl& model) {
    model.eval();
    kept_.all(*model.rootp);
  }
  void line(Vdsl& /*model*/) { dsl_parts::line_has_changed(kept_); }
  void rise(Vdsl& model) {
    model.clk_i = model.s_axi_aclk = 1;
    dsl_parts::rise(model.rootp, kept_);
    know_edges(model);
  }
  void fall(Vdsl& model) {
    model.clk_i = model.s_axi_aclk = 0;
    dsl_parts::fall(model.rootp, kept_);
    know_edges(model);
  }

 private:
  dsl_parts::Kept kept_;
};
#else
bool know_edges(Vdsl& /*model*/) { return false; }

class DslSteps {
 public:
  void inputs(Vdsl& model) { model.eval(); }
  void line(Vdsl& /*model*/) {}
  void rise(Vdsl& model) {
    model.clk_i = model.s_axi_aclk = 1;
    model.eval();
  }
  void fall(Vdsl& model) {
    model.clk_i = model.s_axi_aclk = 0;
    model.eval();
  }
};
#endif

// What both ways to run the model share. `Base`: OneClockMaster or TwoClockMaster.
template <typename Base>
class DslPins : public Base {
 protected:
  using Outputs = MasterModel::Outputs;
  using Base::Base;
  using Base::model_;

 public:
  unsigned half_clocks(unsigned /*line*/) const override { return dsl_model::kTicksPerBit / 2; }
  bool in() const override { return model_->dsl_in_i != 0; }

 protected:
  // The inputs at first, in reset. The first function makes edges of both clocks.
  void start(const ChipConfig& chip) {
    constexpr unsigned kEdges = 32;  // then the synchronisers of the resets have settled
    Vdsl& m = *model_;
    m.quirks_i = chip.quirks;
    m.dsl_in_i = 1;
    m.rst_ni = m.s_axi_aresetn = 1;
    this->context_->assertOn(false);  // random values are not a valid state
    for (unsigned i = 1; i <= kEdges; ++i) {
      m.clk_i = m.s_axi_aclk = i % 2;
      m.eval();
    }
    m.rst_ni = m.s_axi_aresetn = 0;
    m.eval();
    this->context_->assertOn(true);
  }
  std::vector<WaveSignal> encoder() const {
    return this->wave_.encoder("encoder_line", "encoder_out");
  }
  Outputs levels() const {
    const Vdsl& m = *model_;
    return MasterModel::of_line(0, m.dsl_out_o * DslRtl::kOut | m.dsl_en_o * DslRtl::kEnable) |
           m.irq_o * DslRtl::kIrq | m.link_o * DslRtl::kLink |
           m.sample_edge_o * DslRtl::kSampleEdge | m.position_ready_o * DslRtl::kReady;
  }
};

// Bus and core have one clock. Only those parts of an edge run whose inputs have changed.
class DslOnOneClock final : public DslPins<OneClockMaster<DslOnOneClock, DslRtl, Vdsl, NoCounts>> {
  using Base = OneClockMaster<DslOnOneClock, DslRtl, Vdsl, NoCounts>;
  friend Base;

 public:
  DslOnOneClock(const ChipConfig& chip, std::uint64_t seed)
      : DslPins(chip.f_clk_hz, seed, true, "dsl") {  // a line with DSL is never at rest
    start(chip);
    pack();
  }

  // No output depends on the line before a clock edge.
  void set_inputs(Time now, unsigned /*line*/, unsigned levels) override {
    model_->dsl_in_i = levels & 1U;
    steps_.line(*model_);
    show(now);
  }
  void set_core_reset(Time now, bool active) override {
    change_at_once(now, [this, active] { model_->rst_ni = active ? 0 : 1; });
  }
  void set_bus_reset(Time now, bool active) override {
    change_at_once(now, [this, active] {
      model_->s_axi_aresetn = active ? 0 : 1;
      manager_.forget();
    });
  }
  void start_wave(const TraceFile& file) override {
    begin_wave(file, kScope, wave_signals(*model_->rootp), encoder());
  }

 private:
  // What OneClockMaster asks for.
  void before(Time /*now*/) {
    if (std::exchange(moved_, false)) evaluate();
  }
  void rise() { steps_.rise(*model_); }
  void fall() { steps_.fall(*model_); }
  void evaluate() { steps_.inputs(*model_); }
  void passed() {}
  void moved() { moved_ = true; }
  void answered() { answered_ ^= kAnswered; }
  void changed(Outputs /*before*/) {}
  void pack() { outputs_ = levels() | answered_; }

  DslSteps steps_;
  bool moved_ = false;  // inputs have changed since the last edge, beside the line
  Outputs answered_ = 0;
};

class DslOnTwoClocks final
    : public DslPins<TwoClockMaster<DslOnTwoClocks, DslRtl, Vdsl, AxiManager<Vdsl>>> {
  using Base = TwoClockMaster<DslOnTwoClocks, DslRtl, Vdsl, AxiManager<Vdsl>>;
  friend Base;

 public:
  DslOnTwoClocks(const ChipConfig& chip, std::uint64_t bus_hz, std::uint64_t seed)
      : DslPins(chip.f_clk_hz, bus_hz, seed, "dsl") {
    start(chip);
    evaluate(0);
  }

  void set_inputs(Time now, unsigned /*line*/, unsigned levels) override {
    model_->dsl_in_i = levels & 1U;
    show(now);
  }
  void set_core_reset(Time now, bool active) override {
    model_->rst_ni = active ? 0 : 1;
    evaluate(now);
  }
  void set_bus_reset(Time now, bool active) override {
    manager_.reset(*model_, active);
    evaluate(now);
  }
  void start_wave(const TraceFile& file) override {
    wave_.begin(file, kScope, wave_signals(*model_->rootp), encoder());
  }
  void stop_wave() override { wave_.stop(); }

 private:
  // What TwoClockMaster asks for. No flop has a falling edge.
  bool falls_quietly() { return know_edges(*model_); }
  Outputs pack() const { return levels(); }
};

}  // namespace

std::unique_ptr<DslRtl> make_dsl_rtl(const ChipConfig& chip, std::uint64_t bus_hz,
                                     std::uint64_t seed, bool plain) {
  if (bus_hz == chip.f_clk_hz && !plain) return std::make_unique<DslOnOneClock>(chip, seed);
  return std::make_unique<DslOnTwoClocks>(chip, bus_hz, seed);
}

}  // namespace mb4::sim
