// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the keys that slaves of several protocols share: lengths, CRC, timeout, source of the data.
#ifndef MB4SIM_SENSOR_KEYS_HPP_
#define MB4SIM_SENSOR_KEYS_HPP_

#include <string>
#include <string_view>

#include "sim/core/toml_reader.hpp"
#include "sim/lines/clocked/slave_timeout.hpp"
#include "sim/lines/crc.hpp"
#include "sim/lines/sensor_config.hpp"

namespace mb4::sim {

// All functions throw ScenarioError.

// Reads data_bits and flag_bits. If `data_bits` is 0 on entry, the key is required. Without its key
// `flag_bits` becomes `default_flags`, or 0 if the word is not longer than that.
void read_lengths(TomlReader& reader, unsigned& data_bits, unsigned& flag_bits,
                  unsigned default_flags);
void read_crc(TomlReader& reader, Crc& crc);
void read_timeout(TomlReader& reader, SlaveTimeout& timeout);
// Reads the key `name` in microseconds. `value` stays as it is if the key is not there.
void read_timeout_us(TomlReader& reader, std::string_view name, Time& value);
// Reads lengths, flags, CRC and source of a sensor. On entry `config` holds the values of the
// preset. `file` becomes the path of the file of words, if there is one.
void read_sensor(TomlReader& reader, SensorConfig& config, unsigned default_flags,
                 std::string& file);
// Reads the source of a sensor whose lengths and flags are known, and names its keys. `bits_key`:
// the key of its length.
void read_source(TomlReader& reader, SensorConfig& config, std::string& file,
                 std::string_view bits_key = "data_bits");
void know_source_keys(TomlReader& reader);
// Names the keys of read_sensor() to TomlReader::know().
void know_sensor_keys(TomlReader& reader);

}  // namespace mb4::sim

#endif  // MB4SIM_SENSOR_KEYS_HPP_
