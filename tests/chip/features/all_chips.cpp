// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// All presets, and cores that leave out what no preset does: takes the place of the simulator's
// preset_chips.cpp.
#include <Vfeatures_drive.h>
#include <Vfeatures_drive___024root.h>
#include <Vfeatures_one_bank.h>
#include <Vfeatures_one_bank___024root.h>
#include <Vfeatures_one_line.h>
#include <Vfeatures_one_line___024root.h>
#include <Vfeatures_reader.h>
#include <Vfeatures_reader___024root.h>
#include <Vfeatures_single.h>
#include <Vfeatures_single___024root.h>

#include "mb4_page_regs.hpp"
#include "sim/core/trace_file.hpp"
#include "sim/masters/mb4/model/chip_signals.hpp"
#include "sim/masters/mb4/model/plain_steps.hpp"
#include "sim/masters/mb4/model/preset_chips.hpp"
#include "sim/masters/mb4/model/verilated_chip.hpp"

namespace mb4::sim {
namespace {

// Any two numbers that no preset has.
constexpr std::uint32_t kOneBank = 1;
constexpr std::uint32_t kOneLine = 2;

constexpr ChipPreset kPresets[] = {{"full", 0, true},
                                   {"drive", page::kFeaturesDrive, true},
                                   {"single", page::kFeaturesSingle, true},
                                   {"reader", page::kFeaturesReader, true},
                                   {"one-bank", kOneBank, true},
                                   {"one-line", kOneLine, true}};

template <typename Model>
std::unique_ptr<ChipModel> make(const ChipConfig& config, std::uint64_t seed) {
  return std::make_unique<VerilatedChip<Model, NoTrace, ChipSignals<Model>, PlainSteps<Model>>>(
      config, seed, TraceFile{});
}

}  // namespace

std::span<const ChipPreset> chip_presets() { return kPresets; }

std::unique_ptr<ChipModel> make_preset_chip(const ChipConfig& config, std::uint64_t seed) {
  switch (config.features) {
    case page::kFeaturesDrive:
      return make<Vfeatures_drive>(config, seed);
    case page::kFeaturesReader:
      return make<Vfeatures_reader>(config, seed);
    case kOneBank:
      return make<Vfeatures_one_bank>(config, seed);
    case kOneLine:
      return make<Vfeatures_one_line>(config, seed);
    default:
      return make<Vfeatures_single>(config, seed);
  }
}

}  // namespace mb4::sim
