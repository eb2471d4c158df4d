// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The keys of a scenario's slave that are about registers and control communication.
#ifndef MB4SIM_SRC_SCENARIO_REGISTERS_HPP_
#define MB4SIM_SRC_SCENARIO_REGISTERS_HPP_

#include <cstdint>
#include <map>

#include "mb4sim/biss_b_registers.hpp"
#include "mb4sim/control_slave.hpp"
#include "toml_reader.hpp"

namespace mb4::sim {

// Key `registers`. Throws ScenarioError, as does read_control().
void read_registers(TomlReader& reader, std::map<std::uint8_t, std::uint8_t>& registers);

// Keys of control communication of a BiSS C or extended SSI slave; `control` comes with the values
// of its preset.
void read_control(TomlReader& reader, ControlConfig& control);

// Keys of the register mode of a BiSS B slave.
void read_access(TomlReader& reader, BissBRegisterConfig& access);

}  // namespace mb4::sim

#endif  // MB4SIM_SRC_SCENARIO_REGISTERS_HPP_
