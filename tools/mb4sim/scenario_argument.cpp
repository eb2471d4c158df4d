// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "scenario_argument.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "sim/core/scenario_error.hpp"
#include "sim/core/suggestion.hpp"

namespace mb4::tool {

std::string preset_scenario(const sim::Preset& preset) {
  const sim::LineProtocol protocol = preset.device->traits().protocol;
  std::string text = fmt::format("# {}\n\n", preset.description);
  // SSI and BiSS B slaves follow a slow MA only.
  if (protocol.key != "biss-c") text += "[host]\nma_hz = 1_000_000\n\n";
  text += fmt::format(
      "[[channel]]\nnumber = 1\ncable_m = 10\n\n"
      "[[channel.slave]]\nprotocol = \"{}\"\npreset = \"{}\"\n",
      protocol.key, preset.name);
  if (preset.device->data_bits == 0) {
    text += "data_bits = 26  # position and flags; depends on the type of encoder\n";
  }
  return text + "source = \"ramp\"\nstep = 100\n";
}

sim::Scenario open_scenario(const std::string& name) {
  std::error_code error;
  const bool absent = !std::filesystem::exists(name, error) && !error;
  if (!absent) return sim::load_scenario(name);
  if (const sim::Preset* preset = sim::preset_by_name(name)) {
    return sim::parse_scenario(preset_scenario(*preset), name);
  }
  const bool path = name.find_first_of("/.") != std::string::npos;
  std::vector<std::string> names;
  for (const sim::Preset& each : sim::presets()) names.emplace_back(each.name);
  const std::string meant = sim::nearest(name, names);
  if (path || meant.empty()) return sim::load_scenario(name);  // which says that it is not there
  throw sim::ScenarioError(fmt::format(
      "{}: there is no such file, and no preset of this name; did you mean '{}'?", name, meant));
}

}  // namespace mb4::tool
