// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model of mb4_chip that coverage or mutants run: takes the place of
// sim/masters/mb4/model/fast_chip.cpp.
#include <Vmeasured_chip.h>
#include <Vmeasured_chip___024root.h>

#include "sim/masters/mb4/model/chip_signals.hpp"
#include "sim/masters/mb4/model/plain_steps.hpp"
#include "sim/masters/mb4/model/verilated_chip.hpp"

namespace mb4::sim {
std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed) {
  return std::make_unique<VerilatedChip<Vmeasured_chip, NoTrace, ChipSignals<Vmeasured_chip>,
                                        PlainSteps<Vmeasured_chip>>>(config, seed, TraceFile{});
}

}  // namespace mb4::sim
