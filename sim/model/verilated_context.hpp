// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The context that a Verilated model of a simulator runs in.
#ifndef MB4SIM_VERILATED_CONTEXT_HPP_
#define MB4SIM_VERILATED_CONTEXT_HPP_

#include <verilated.h>

#include <cstdint>
#include <memory>

namespace mb4::sim {

// Flops and memories without reset get random values, which `seed` chooses.
inline std::unique_ptr<VerilatedContext> make_verilated_context(std::uint64_t seed) {
  auto context = std::make_unique<VerilatedContext>();
  context->randReset(2);
  // randSeed() demands a seed of 31 bits that is not 0.
  context->randSeed(static_cast<int>(seed % 0x7FFFFFFEU) + 1);
  context->threads(1);  // else every context starts a pool of unused threads
  return context;
}

}  // namespace mb4::sim

#endif  // MB4SIM_VERILATED_CONTEXT_HPP_
