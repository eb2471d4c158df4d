// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads tables of bytes by register address. All functions throw ScenarioError.
#ifndef MB4SIM_REGISTER_BYTES_HPP_
#define MB4SIM_REGISTER_BYTES_HPP_

#include <cstdint>
#include <functional>
#include <map>

#include "sim/core/toml_reader.hpp"

namespace mb4::sim {

// The registers of a slave are 0x00 to this.
inline constexpr std::uint64_t kLastRegister = 0xFF;

// Reads the key `registers` of a slave. On entry the target holds those of the preset.
void read_registers(TomlReader& reader, std::map<std::uint8_t, std::uint8_t>& registers);

// Reads a byte or a list of bytes for each address, 0 to `last`. Calls put(address, value) for each
// byte.
void read_bytes(const TomlReader& reader, const TomlValue& table, std::uint64_t last,
                const std::function<void(std::uint8_t, std::uint8_t)>& put);

}  // namespace mb4::sim

#endif  // MB4SIM_REGISTER_BYTES_HPP_
