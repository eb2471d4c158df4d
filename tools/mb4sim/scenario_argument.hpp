// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The argument SCENARIO of the commands: a file, or an encoder that is known by name.
#ifndef MB4SIM_TOOL_SCENARIO_ARGUMENT_HPP_
#define MB4SIM_TOOL_SCENARIO_ARGUMENT_HPP_

#include <string>

#include "sim/lines/presets.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

// A scenario with this encoder alone, to start from.
std::string preset_scenario(const sim::Preset& preset);

// The scenario of this file, or if there is none, that of the preset with this name. Throws
// sim::ScenarioError.
sim::Scenario open_scenario(const std::string& name);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_SCENARIO_ARGUMENT_HPP_
