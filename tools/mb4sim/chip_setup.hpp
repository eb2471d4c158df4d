// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver's configuration for the slaves of a scenario.
#ifndef MB4SIM_TOOL_CHIP_SETUP_HPP_
#define MB4SIM_TOOL_CHIP_SETUP_HPP_

#include <string>
#include <vector>

#include "mb4/config.hpp"
#include "mb4/result.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

// Throws sim::ScenarioError if the master is another one.
void require_ic_mb4(const sim::Scenario& scenario);

// Loads a scenario of the iC-MB4. Throws sim::ScenarioError.
sim::Scenario load_chip_scenario(const std::string& path);

// A slave of the scenario and its number in the chip, 1..8 as in SCDATAx.
struct ConnectedSlave {
  unsigned number;
  unsigned channel;
  const sim::SlaveConfig* config;  // part of the scenario
};

// All slaves of a scenario, in the order of their numbers.
std::vector<ConnectedSlave> connected_slaves(const sim::Scenario& scenario);

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
