// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A context for one Verilated model. It must outlive the model: declare it first.
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

}  // namespace mb4test

#endif  // MB4_TESTS_BLOCK_MODEL_CONTEXT_HPP_
