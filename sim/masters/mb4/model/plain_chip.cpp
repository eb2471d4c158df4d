// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model without tracing, evaluated by eval() alone.
#include <Vmb4_chip.h>
#include <Vmb4_chip___024root.h>

#include "chip_signals.hpp"
#include "plain_steps.hpp"
#include "verilated_chip.hpp"

namespace mb4::sim {

std::unique_ptr<ChipModel> make_plain_chip(const ChipConfig& config, std::uint64_t seed) {
  using Chip = VerilatedChip<Vmb4_chip, NoTrace, ChipSignals<Vmb4_chip>, PlainSteps<Vmb4_chip>>;
  return std::make_unique<Chip>(config, seed, TraceFile{});
}

}  // namespace mb4::sim
