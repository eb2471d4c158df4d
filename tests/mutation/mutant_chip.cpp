// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model without tracing, with faults (mutate.py): takes the place of
// sim/masters/mb4/model/fast_chip.cpp.
#include <Vmb4_mutant.h>
#include <Vmb4_mutant___024root.h>

#include "chip_signals.hpp"
#include "plain_steps.hpp"
#include "verilated_chip.hpp"

namespace mb4::sim {
std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed) {
  return std::make_unique<
      VerilatedChip<Vmb4_mutant, NoTrace, ChipSignals<Vmb4_mutant>, PlainSteps<Vmb4_mutant>>>(
      config, seed, TraceFile{});
}

}  // namespace mb4::sim
