// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// How an edge of axi_aclk evaluates the model. All ways give the same results; AxiSteps.* of
// tests/chip/axi/ compares them.
#ifndef MB4SIM_AXI_STEPS_HPP_
#define MB4SIM_AXI_STEPS_HPP_

#include <verilated.h>

namespace mb4::sim {

// With eval().
template <typename Model>
class AxiWholeSteps {
 public:
  // Inputs have changed. Outputs that depend on them without a clock follow.
  void inputs(Model& model) { model.eval(); }
  // SLO has changed, and no other input.
  void slo(Model& /*model*/) {}
  // The count of the sample clock has been set forward.
  void time_passed() {}
  void rise(Model& model) {
    model.clk_i = 1;
    model.eval();
  }
  void fall(Model& model) {
    model.clk_i = 0;
    model.eval();
  }
};

// Only the parts of the edge whose inputs have changed run (sim/model/parts/model_parts.py).
// `Edge` has the functions of the header that it makes.
template <typename Model, typename Edge>
class AxiPartSteps {
 public:
  void inputs(Model& model) {
    model.eval();
    kept_.all(*model.rootp);
  }
  void slo(Model& model) { Edge::slo(model.rootp, kept_); }
  void time_passed() { Edge::time(kept_); }
  void rise(Model& model) {
    model.clk_i = 1;
    Edge::rise(model.rootp, kept_);
    model.rootp->__Vtrigrprev__TOP__clk_i = 1;  // eval() must not find this edge
  }
  void fall(Model& model) {
    model.clk_i = 0;
    Edge::fall(model.rootp, kept_);
    model.rootp->__Vtrigrprev__TOP__clk_i = 0;
  }

 private:
  typename Edge::Kept kept_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_AXI_STEPS_HPP_
