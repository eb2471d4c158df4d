// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the [[channel]] part of a scenario: the cable, and through read_slave() its slaves.
#ifndef MB4SIM_SCENARIO_CHANNEL_HPP_
#define MB4SIM_SCENARIO_CHANNEL_HPP_

#include <toml++/toml.h>

#include <vector>

#include "sim/core/cable.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::sim {

// Reads one channel of this master. Throws ScenarioError.
ChannelConfig read_channel(const toml::table& table, TomlFile& file, const Master& master);

// Reads the tables [[channel.event]] of the channel that `channel` reads.
std::vector<CableEvent> read_events(TomlReader& channel);

}  // namespace mb4::sim

#endif  // MB4SIM_SCENARIO_CHANNEL_HPP_
