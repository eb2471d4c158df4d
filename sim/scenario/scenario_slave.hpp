// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the [[channel.slave]] part of a scenario.
#ifndef MB4SIM_SCENARIO_SLAVE_HPP_
#define MB4SIM_SCENARIO_SLAVE_HPP_

#include "sim/core/toml_reader.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::sim {

// Reads one slave of a channel of this master. Throws ScenarioError.
SlaveConfig read_slave(const TomlValue& table, TomlFile& file, const Master& master);

}  // namespace mb4::sim

#endif  // MB4SIM_SCENARIO_SLAVE_HPP_
