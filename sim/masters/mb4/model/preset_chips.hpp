// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Chips with fewer features (decision 44): the presets, and models of those that the build has.
#ifndef MB4SIM_MB4_PRESET_CHIPS_HPP_
#define MB4SIM_MB4_PRESET_CHIPS_HPP_

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "chip_model.hpp"

namespace mb4::sim {

struct ChipPreset {
  std::string_view name;
  std::uint32_t features;  // word FEATURES of the page; ChipConfig::features, 0 = full
  bool built;
};

// The first is the full chip.
std::span<const ChipPreset> chip_presets();

// A model without tracing of the chip that `config.features` names, evaluated by eval() alone. It
// must be one that the build has, and not the full one.
std::unique_ptr<ChipModel> make_preset_chip(const ChipConfig& config, std::uint64_t seed);

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_PRESET_CHIPS_HPP_
