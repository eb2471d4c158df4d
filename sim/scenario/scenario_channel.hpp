// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the [[channel]] part of a scenario: through the master's kind of line the cable, and
// through read_slave() its slaves.
#ifndef MB4SIM_SCENARIO_CHANNEL_HPP_
#define MB4SIM_SCENARIO_CHANNEL_HPP_

#include "sim/core/toml_reader.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::sim {

// Reads one channel of this master. `place`: among the channels of the file, from 1 on; it is the
// number of a channel without the key. Throws ScenarioError.
ChannelConfig read_channel(const TomlValue& table, TomlFile& file, const Master& master,
                           unsigned place);

}  // namespace mb4::sim

#endif  // MB4SIM_SCENARIO_CHANNEL_HPP_
