// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model without tracing.
#include <Vmb4_chip.h>
#include <Vmb4_chip___024root.h>

#include "chip_signals.hpp"
#include "plain_steps.hpp"
#include "verilated_chip.hpp"

// Some packages of Verilator leave this number empty.
#if VERILATOR_VERSION_INTEGER + 0 == 5006000
#include <Vmb4_chip_edge.hpp>
#ifndef MODEL_RUNS_WHOLE
#define MB4_DIRECT_STEPS
#include "direct_steps.hpp"
#include "sim/model/whole_models.hpp"
#endif
#endif

namespace mb4::sim {
namespace {

#ifdef MB4_DIRECT_STEPS
using Steps = DirectSteps;
#else
using Steps = PlainSteps<Vmb4_chip>;
const WholeModel kChipIsWhole("iC-MB4");
#endif

}  // namespace

std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed) {
  return std::make_unique<VerilatedChip<Vmb4_chip, NoTrace, ChipSignals<Vmb4_chip>, Steps>>(
      config, seed, TraceFile{});
}

}  // namespace mb4::sim
