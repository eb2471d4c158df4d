// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Every key of a scenario, as the reader asks for it.
#ifndef MB4SIM_SCENARIO_KEYS_HPP_
#define MB4SIM_SCENARIO_KEYS_HPP_

#include <string>
#include <string_view>
#include <vector>

#include "sim/core/toml_reader.hpp"
#include "sim/masters/master.hpp"

namespace mb4::sim {

// What reading this text asks for, up to its first mistake.
std::vector<AskedKey> keys_asked_for(std::string_view text);

// Where a key that its table does not have would be right, for a message: "; write seed = 1 under
// [sim]", or with which master, protocol, source or kind. Empty if nowhere.
std::string place_of_key(const Master& master, const TomlValue& table, std::string_view key);

// A JSON Schema of the scenarios of all masters of this build.
std::string scenario_schema();

}  // namespace mb4::sim

#endif  // MB4SIM_SCENARIO_KEYS_HPP_
