// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model without tracing, made of the iCE40 netlist: takes the place of
// sim/masters/mb4/model/fast_chip.cpp.
#include <Vmb4_gate.h>

#include "plain_steps.hpp"
#include "verilated_chip.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  static bool osc_selected(const Vmb4_gate& model) { return model.clkeni != 0; }
  static bool clk(const Vmb4_gate& model) { return model.clk != 0; }
  static bool paired(const Vmb4_gate& model) { return model.paired != 0; }
  static unsigned half_clocks(const Vmb4_gate& model) { return model.len_q; }
};

}  // namespace

std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed) {
  return std::make_unique<VerilatedChip<Vmb4_gate, NoTrace, Inside, PlainSteps<Vmb4_gate>>>(
      config, seed, TraceFile{});
}

}  // namespace mb4::sim
