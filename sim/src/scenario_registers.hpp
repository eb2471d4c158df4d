// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the keys of a scenario's slave for registers and control communication. All functions throw
// ScenarioError.
#ifndef MB4SIM_SRC_SCENARIO_REGISTERS_HPP_
#define MB4SIM_SRC_SCENARIO_REGISTERS_HPP_

#include <cstdint>
#include <map>

#include "mb4sim/biss_b_registers.hpp"
#include "mb4sim/control_slave.hpp"
#include "toml_reader.hpp"

namespace mb4::sim {

// Reads the key `registers`.
void read_registers(TomlReader& reader, std::map<std::uint8_t, std::uint8_t>& registers);

// Reads the keys of control communication of a BiSS C or extended SSI slave. On entry `control`
// holds the values of the preset.
void read_control(TomlReader& reader, ControlConfig& control);

// Reads the keys of the register mode of a BiSS B slave.
void read_access(TomlReader& reader, BissBRegisterConfig& access);

}  // namespace mb4::sim

#endif  // MB4SIM_SRC_SCENARIO_REGISTERS_HPP_
