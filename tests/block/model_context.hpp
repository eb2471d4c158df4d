// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A Verilated model together with its context.
#ifndef MB4_TESTS_BLOCK_MODEL_CONTEXT_HPP_
#define MB4_TESTS_BLOCK_MODEL_CONTEXT_HPP_

#include <memory>

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

}  // namespace mb4test

#endif  // MB4_TESTS_BLOCK_MODEL_CONTEXT_HPP_
