// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A small model in parts beside the same model evaluated by eval(). model_parts_test.py has its
// source. Random inputs change between the edges of the clock. The program ends with status 1 at
// the first difference. It is also the shortest example of how a header of sim/model/parts is used.
#include <Vsample.h>
#include <Vsample___024root.h>

#include <Vsample_edge.hpp>
#include <cstdio>
#include <random>
#include <tuple>

namespace {

class InParts {
 public:
  explicit InParts(Vsample& model) : model_(model), root_(*model.rootp) {}

  // Inputs have changed.
  void inputs(bool reset) {
    if (!reset) {
      sample::host(&root_, kept_);
      return;
    }
    model_.eval();
    kept_.all(root_);  // a reset or another clock may change anything
  }
  // The clock has an edge, and no other input changes.
  void clock(bool level) {
    root_.clk_i = level;
    if (level) {
      sample::rise(&root_, kept_);
    } else {
      sample::fall(&root_, kept_);
    }
    root_.__Vtrigrprev__TOP__clk_i = level;  // eval() must not find this edge
  }

 private:
  Vsample& model_;
  Vsample___024root& root_;
  sample::Kept kept_;
};

auto outputs(const Vsample& model) {
  return std::tuple(model.sum_o, model.turn_o, model.high_o, model.late_o, model.got_o,
                    model.near_o);
}

}  // namespace

int main() {
  VerilatedContext context;
  Vsample whole(&context, "whole");
  Vsample split(&context, "split");
  InParts parts(split);
  std::mt19937 random(1);
  for (int clock = 0; clock < 20000; ++clock) {
    if (const bool reset = clock < 2 || random() % 5000 == 0; reset || random() % 4 == 0) {
      for (const bool level : {false, true}) {
        if (level && !reset) break;
        for (Vsample* model : {&whole, &split}) model->rst_ni = !reset || level;
        whole.en_i = split.en_i = random() & 1U;
        whole.sck_i = split.sck_i = random() & 1U;
        whole.add_i = split.add_i = static_cast<CData>(random());
        whole.eval();
        parts.inputs(reset);
        if (outputs(whole) != outputs(split)) {
          std::fprintf(stderr, "clock %d: not the same after an edge of the inputs\n", clock);
          return 1;
        }
      }
    }
    for (const bool level : {true, false}) {
      whole.clk_i = level;
      whole.eval();
      parts.clock(level);
      if (outputs(whole) != outputs(split)) {
        std::fprintf(stderr, "clock %d: not the same after an edge to %d\n", clock, level);
        return 1;
      }
    }
  }
  if (whole.sum_o == 0 || whole.got_o == 0) return 1;  // nothing has happened
}
