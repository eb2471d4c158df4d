// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// A chip with fewer features, made of the iCE40 netlist: takes the place of the simulator's
// preset_chips.cpp. MB4_GATE_PRESET is its name.
#include <Vmb4_gate.h>

#include "mb4_page_regs.hpp"
#include "sim/core/trace_file.hpp"
#include "sim/masters/mb4/model/plain_steps.hpp"
#include "sim/masters/mb4/model/preset_chips.hpp"
#include "sim/masters/mb4/model/verilated_chip.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  static bool osc_selected(const Vmb4_gate& model) { return model.clkeni != 0; }
  static bool clk(const Vmb4_gate& model) { return model.clk != 0; }
  static bool paired(const Vmb4_gate& model) { return model.paired != 0; }
  static unsigned half_clocks(const Vmb4_gate& model) { return model.len_q; }
};

constexpr std::string_view kPreset = MB4_GATE_PRESET;

constexpr ChipPreset kPresets[] = {{"full", 0, true},
                                   {"drive", page::kFeaturesDrive, kPreset == "drive"},
                                   {"single", page::kFeaturesSingle, kPreset == "single"},
                                   {"reader", page::kFeaturesReader, kPreset == "reader"}};

}  // namespace

std::span<const ChipPreset> chip_presets() { return kPresets; }

std::unique_ptr<ChipModel> make_preset_chip(const ChipConfig& config, std::uint64_t seed) {
  return std::make_unique<VerilatedChip<Vmb4_gate, NoTrace, Inside, PlainSteps<Vmb4_gate>>>(
      config, seed, TraceFile{});
}

}  // namespace mb4::sim
