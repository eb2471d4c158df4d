// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The slaves of a scenario as a master numbers them.
#ifndef MB4SIM_TOOL_CONNECTED_SLAVES_HPP_
#define MB4SIM_TOOL_CONNECTED_SLAVES_HPP_

#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

// A slave of the scenario and its number, from 1 on; for the iC-MB4 as in SCDATAx.
struct ConnectedSlave {
  unsigned number;
  unsigned channel;
  const sim::SlaveConfig* config;  // part of the scenario
};

// All slaves of a scenario, in the order of their numbers.
std::vector<ConnectedSlave> connected_slaves(const sim::Scenario& scenario);

// Throws sim::ScenarioError if the scenario has no channel, or a channel without a slave.
void require_slaves(const sim::Scenario& scenario);

// Throws sim::ScenarioError with the place of a key in the scenario.
[[noreturn]] void fail_at(const sim::Scenario& scenario, const sim::TableSource& source,
                          std::string_view key, const std::string& message);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_CONNECTED_SLAVES_HPP_
