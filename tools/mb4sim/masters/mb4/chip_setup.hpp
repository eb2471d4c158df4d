// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The configuration of the iC-MB4's driver for the slaves of a scenario.
#ifndef MB4SIM_TOOL_CHIP_SETUP_HPP_
#define MB4SIM_TOOL_CHIP_SETUP_HPP_

#include <string>

#include "connected_slaves.hpp"
#include "mb4/config.hpp"
#include "mb4/result.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

// Throws sim::ScenarioError if the master is another one.
void require_ic_mb4(const sim::Scenario& scenario);

// Loads a scenario for commands that speak to the iC-MB4 themselves. Throws sim::ScenarioError.
sim::Scenario load_chip_scenario(const std::string& path);

// A configuration with only the clocks of the scenario. Throws sim::ScenarioError for another
// master than the iC-MB4.
Config clock_config(const sim::Scenario& scenario);

// Configuration that reads all slaves. Throws sim::ScenarioError with the scenario's key that chip
// or driver does not support.
Config make_config(const sim::Scenario& scenario);

// "no iC-MB4 detected", "invalid configuration: data_bits of slave 1", ...
std::string describe(const ErrorInfo& error);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_CHIP_SETUP_HPP_
