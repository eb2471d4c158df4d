// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// A chip with fewer features, made of the iCE40 netlist: takes the place of the simulator's
// preset_chips.cpp. MB4_GATE_PRESET is its name.
#include "mb4_page_regs.hpp"
#include "sim/masters/mb4/model/preset_chips.hpp"
#include "tests/gate/gate_model.hpp"

namespace mb4::sim {
namespace {

constexpr std::string_view kPreset = MB4_GATE_PRESET;

constexpr ChipPreset kPresets[] = {{"full", 0, true},
                                   {"drive", page::kFeaturesDrive, kPreset == "drive"},
                                   {"single", page::kFeaturesSingle, kPreset == "single"},
                                   {"reader", page::kFeaturesReader, kPreset == "reader"}};

}  // namespace

std::span<const ChipPreset> chip_presets() { return kPresets; }

std::unique_ptr<ChipModel> make_preset_chip(const ChipConfig& config, std::uint64_t seed) {
  return make_gate_chip(config, seed);
}

}  // namespace mb4::sim
