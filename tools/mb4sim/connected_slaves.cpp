// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "connected_slaves.hpp"

#include "sim/masters/master.hpp"

namespace mb4::tool {

std::vector<ConnectedSlave> connected_slaves(const sim::Scenario& scenario) {
  std::vector<ConnectedSlave> found;
  for (unsigned number = 1; number <= scenario.master->channels; ++number) {
    const sim::ChannelConfig* channel = scenario.channel(number);
    if (channel == nullptr) continue;
    unsigned slave = scenario.master->first_slave(number);
    for (const sim::SlaveConfig& config : channel->slaves)
      found.push_back({slave++, number, &config});
  }
  return found;
}

void require_slaves(const sim::Scenario& scenario) {
  if (scenario.channels.empty()) {
    fail_at(scenario, scenario.source, "channel", "missing: there is no slave to read");
  }
  for (const sim::ChannelConfig& channel : scenario.channels) {
    if (channel.slaves.empty())
      fail_at(scenario, channel.source, "slave", "missing: there is no slave to read");
  }
}

void fail_at(const sim::Scenario& scenario, const sim::TableSource& source, std::string_view key,
             const std::string& message) {
  throw sim::ScenarioError(scenario.name, source.of(key), key, message);
}

}  // namespace mb4::tool
