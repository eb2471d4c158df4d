// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Encoders by name, with lengths, CRC and timing as their makers publish them. The room of each
// protocol has its own list.
#ifndef MB4SIM_PRESETS_HPP_
#define MB4SIM_PRESETS_HPP_

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "sim/lines/device.hpp"

namespace mb4::sim {

struct Preset {
  struct RegisterRun {
    std::uint8_t address;
    std::vector<std::uint8_t> values;
  };
  std::string_view name;
  std::string_view description;
  Device device;  // data_bits = 0: the user must give the length
  std::vector<RegisterRun> registers;
};

// All presets, in the order in which they are listed to the user.
std::span<const Preset> presets();

// Returns null if there is no preset of this name.
const Preset* preset_by_name(std::string_view name);

}  // namespace mb4::sim

#endif  // MB4SIM_PRESETS_HPP_
