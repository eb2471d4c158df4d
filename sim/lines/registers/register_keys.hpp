// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the keys of a scenario's slave for control communication. All functions throw
// ScenarioError. On entry the targets hold the values of the preset.
#ifndef MB4SIM_REGISTER_KEYS_HPP_
#define MB4SIM_REGISTER_KEYS_HPP_

#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "sim/core/toml_reader.hpp"
#include "sim/lines/register_file.hpp"
#include "sim/lines/registers/busy_time.hpp"
#include "sim/lines/registers/control_slave.hpp"

namespace mb4::sim {

// Reads the key `control`. If the device has no registers that a master can reach, none of `keys`
// may be given. Returns `present`.
bool read_present(TomlReader& reader, bool& present, std::initializer_list<std::string_view> keys);
// Reads the key `ids`.
void read_ids(TomlReader& reader, unsigned& ids);
// Reads the keys `banks`, `missing` and `write_protected`.
void read_layout(TomlReader& reader, RegisterFile::Layout& layout);
// Reads a busy time. `frames_key`: number of frames or clocks, or "forever". `us_key`:
// microseconds.
void read_busy(TomlReader& reader, std::string_view frames_key, std::string_view us_key,
               BusyTime& busy);
// Reads a busy time that has a key in microseconds only.
void read_busy_us(TomlReader& reader, std::string_view us_key, BusyTime& busy);

// Reads the keys of control communication: all of the above.
void read_control(TomlReader& reader, ControlConfig& control);
void know_control_keys(TomlReader& reader);

}  // namespace mb4::sim

#endif  // MB4SIM_REGISTER_KEYS_HPP_
