// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The [[channel.slave]] part of a scenario.
#ifndef MB4SIM_SRC_SCENARIO_SLAVE_HPP_
#define MB4SIM_SRC_SCENARIO_SLAVE_HPP_

#include <toml++/toml.h>

#include <string>

#include "mb4sim/scenario.hpp"

namespace mb4::sim {

// Throws ScenarioError. `file` is the scenario's name.
SlaveConfig read_slave(const toml::table& table, const std::string& file);

}  // namespace mb4::sim

#endif  // MB4SIM_SRC_SCENARIO_SLAVE_HPP_
