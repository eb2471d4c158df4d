// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model without tracing.
#include <Vmb4_chip.h>
#include <Vmb4_chip___024root.h>

#include "chip_signals.hpp"
#include "direct_steps.hpp"
#include "verilated_chip.hpp"

namespace mb4::sim {

std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed) {
  if (!DirectSteps::possible()) return make_plain_chip(config, seed);
  using Chip = VerilatedChip<Vmb4_chip, NoTrace, ChipSignals<Vmb4_chip>, DirectSteps>;
  return std::make_unique<Chip>(config, seed, TraceFile{});
}

}  // namespace mb4::sim
