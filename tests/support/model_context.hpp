// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A Verilated model together with its context.
#ifndef TESTS_SUPPORT_MODEL_CONTEXT_HPP_
#define TESTS_SUPPORT_MODEL_CONTEXT_HPP_

#include <memory>

#include "tests/support/dice.hpp"
#include "verilated.h"

namespace mb4test {

// Uninitialised state gets random values from `seed`.
inline std::unique_ptr<VerilatedContext> make_context(int seed = 1) {
  auto context = std::make_unique<VerilatedContext>();
  // The default makes idle worker threads.
  context->threads(1);
  context->randReset(2);
  context->randSeed(seed);
  return context;
}

// One model and its context, ended in the right order.
template <typename Model>
class Owned {
 public:
  Owned() = default;
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() {
    // Verilator 5.006 looks for the scopes of a dying model in the context of the thread.
    Verilated::threadContextp(context_.get());
    model_.final();
  }
  Model& operator*() { return model_; }
  Model* operator->() { return &model_; }

 private:
  std::unique_ptr<VerilatedContext> context_ = make_context();
  Model model_{context_.get()};
};

// A pulse of an asynchronous reset on a model that has not been evaluated yet, with its clocks low.
template <typename Model>
void pulse_reset(Model& model) {
  model.rst_ni = 1;
  model.eval();  // what the first call finds is no edge
  model.rst_ni = 0;
  model.eval();
  model.rst_ni = 1;
  model.eval();
}

// A model of one module with one clock, or none.
template <typename Model>
class Block {
 public:
  Block() {
    if constexpr (requires { model.clk_i; }) {
      model.clk_i = 0;
      if constexpr (requires { model.rst_ni; }) model.rst_ni = 0;
      model.eval();  // what the first call finds is no edge
    }
  }
  void reset() {
    clock();
    model.rst_ni = 1;
    clock();
  }
  void clock() {
    model.clk_i = 1;
    model.eval();
    model.clk_i = 0;
    model.eval();
  }
  Owned<Model> owner;
  Model& model = *owner;
};

}  // namespace mb4test

#endif  // TESTS_SUPPORT_MODEL_CONTEXT_HPP_
