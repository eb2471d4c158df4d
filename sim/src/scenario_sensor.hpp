// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The keys that slaves of several protocols share: lengths, CRC, timeout, source of the data.
#ifndef MB4SIM_SRC_SCENARIO_SENSOR_HPP_
#define MB4SIM_SRC_SCENARIO_SENSOR_HPP_

#include <string>
#include <string_view>

#include "mb4sim/crc.hpp"
#include "mb4sim/sensor_config.hpp"
#include "mb4sim/slave_timeout.hpp"
#include "toml_reader.hpp"

namespace mb4::sim {

// All throw ScenarioError.

// data_bits, flag_bits: `data_bits` of 0 means that the key is required, `default_flags` is what
// longer words have.
void read_lengths(TomlReader& reader, unsigned& data_bits, unsigned& flag_bits,
                  unsigned default_flags);
void read_crc(TomlReader& reader, Crc& crc);
void read_timeout(TomlReader& reader, SlaveTimeout& timeout);
// Key `name`: microseconds. `value` stays if it is not there.
void read_timeout_us(TomlReader& reader, std::string_view name, Time& value);
// Lengths, flags, CRC and source of a sensor; `config` comes with the values of its preset. `file`
// is set if a file of words was read.
void read_sensor(TomlReader& reader, SensorConfig& config, unsigned default_flags,
                 std::string& file);

}  // namespace mb4::sim

#endif  // MB4SIM_SRC_SCENARIO_SENSOR_HPP_
