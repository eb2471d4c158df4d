// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the [[fault]] part of a scenario.
#ifndef MB4SIM_SCENARIO_FAULT_HPP_
#define MB4SIM_SCENARIO_FAULT_HPP_

#include "sim/core/toml_reader.hpp"
#include "sim/faults/fault.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::sim {

// Reads one fault. `scenario` must be complete except for its faults. Throws ScenarioError.
FaultConfig read_fault(const TomlValue& table, const Scenario& scenario, TomlFile& file);

}  // namespace mb4::sim

#endif  // MB4SIM_SCENARIO_FAULT_HPP_
