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

#include "sim/masters/dsl/verilated_dsl.hpp"
#include "sim/model/whole_models.hpp"

namespace mb4::sim {
namespace {

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
const WholeModel kDslIsWhole("dsl_axil");

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

struct InsideDsl {
  static bool know_edges(Vdsl& model) { return mb4::sim::know_edges(model); }
  static std::vector<WaveSignal> signals(const Vdsl& model) { return wave_signals(*model.rootp); }
};

}  // namespace

std::unique_ptr<DslRtl> make_dsl_rtl(const ChipConfig& chip, std::uint64_t bus_hz,
                                     std::uint64_t seed, bool plain) {
  if (bus_hz == chip.f_clk_hz && !plain) {
    return std::make_unique<DslOnOneClock<Vdsl, DslSteps, InsideDsl>>(chip, seed);
  }
  return std::make_unique<DslOnTwoClocks<Vdsl, InsideDsl>>(chip, bus_hz, seed);
}

}  // namespace mb4::sim
