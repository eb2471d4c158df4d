// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The iCE40 netlist of mb4_chip, full or with a preset, as a model of the chip.
#ifndef MB4_TESTS_GATE_GATE_MODEL_HPP_
#define MB4_TESTS_GATE_GATE_MODEL_HPP_

#include <Vmb4_gate.h>

#include "sim/core/trace_file.hpp"
#include "sim/masters/mb4/model/plain_steps.hpp"
#include "sim/masters/mb4/model/verilated_chip.hpp"

namespace mb4::sim {

struct GateInside {
  static bool osc_selected(const Vmb4_gate& model) { return model.clkeni != 0; }
  static bool clk(const Vmb4_gate& model) { return model.clk != 0; }
  static bool paired(const Vmb4_gate& model) { return model.paired != 0; }
  static unsigned freqs(const Vmb4_gate& model) { return model.len_q; }
};

inline std::unique_ptr<ChipModel> make_gate_chip(const ChipConfig& config, std::uint64_t seed) {
  return std::make_unique<VerilatedChip<Vmb4_gate, NoTrace, GateInside, PlainSteps<Vmb4_gate>>>(
      config, seed, TraceFile{});
}

}  // namespace mb4::sim

#endif  // MB4_TESTS_GATE_GATE_MODEL_HPP_
