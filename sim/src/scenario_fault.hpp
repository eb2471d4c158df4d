// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The [[fault]] part of a scenario.
#ifndef MB4SIM_SRC_SCENARIO_FAULT_HPP_
#define MB4SIM_SRC_SCENARIO_FAULT_HPP_

#include <toml++/toml.h>

#include "mb4sim/fault.hpp"
#include "mb4sim/scenario.hpp"

namespace mb4::sim {

// `scenario` is complete but for its faults. Throws ScenarioError.
FaultConfig read_fault(const toml::table& table, const Scenario& scenario);

}  // namespace mb4::sim

#endif  // MB4SIM_SRC_SCENARIO_FAULT_HPP_
