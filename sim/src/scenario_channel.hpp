// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The [[channel]] part of a scenario: the cable and, by read_slave(), its slaves.
#ifndef MB4SIM_SRC_SCENARIO_CHANNEL_HPP_
#define MB4SIM_SRC_SCENARIO_CHANNEL_HPP_

#include <toml++/toml.h>

#include <string>

#include "mb4sim/scenario.hpp"

namespace mb4::sim {

// Throws ScenarioError. `file` is the scenario's name.
ChannelConfig read_channel(const toml::table& table, const std::string& file);

}  // namespace mb4::sim

#endif  // MB4SIM_SRC_SCENARIO_CHANNEL_HPP_
