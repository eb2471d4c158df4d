// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// How an edge of the clock of a master with one clock, clk_i, evaluates its model. All ways give
// the same results: AxiSteps.* and PruRest.* of tests/chip/ compare them.
#ifndef MB4SIM_MODEL_EDGE_STEPS_HPP_
#define MB4SIM_MODEL_EDGE_STEPS_HPP_

#include <verilated.h>

namespace mb4::sim {

// With eval().
template <typename Model>
class WholeSteps {
 public:
  // Inputs have changed. Outputs that depend on them without a clock follow.
  void inputs(Model& model) { model.eval(); }
  // What comes from a line has changed, and no other input.
  void line(Model& /*model*/) {}
  // Counts have been set forward.
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
class PartSteps {
 public:
  void inputs(Model& model) {
    model.eval();
    kept_.all(*model.rootp);
  }
  void line(Model& model) { Edge::line(model.rootp, kept_); }
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

#endif  // MB4SIM_MODEL_EDGE_STEPS_HPP_
