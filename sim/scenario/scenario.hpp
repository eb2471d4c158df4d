// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A scenario: everything outside and around the chip. It is read from a TOML file. sim/README.md
// lists every key with unit, range and default.
#ifndef MB4SIM_SCENARIO_HPP_
#define MB4SIM_SCENARIO_HPP_

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/copied.hpp"
#include "sim/core/scenario_error.hpp"
#include "sim/core/time.hpp"
#include "sim/faults/fault.hpp"
#include "sim/hosts/host_config.hpp"
#include "sim/lines/device.hpp"
#include "sim/lines/line.hpp"
#include "sim/masters/chip_config.hpp"
#include "sim/masters/master.hpp"

namespace mb4::sim {

struct SlaveConfig {
  Device device;
  std::map<std::uint8_t, std::uint8_t> registers;
  std::string file;  // file from which words or edges were read; empty: none
  TableSource source;

  const std::string& name() const { return device->name; }
  unsigned data_bits() const { return device->data_bits; }
  unsigned flag_bits() const { return device->flag_bits; }
  const Crc& crc() const { return device->crc; }
  DeviceTraits traits() const { return device->traits(); }
  // A replay counts as what was recorded.
  LineProtocol protocol() const { return traits().protocol; }
};

struct ChannelConfig {
  unsigned number = 1;              // from 1 on
  Copied<LineConfig> cable;         // of the master's kind of line
  std::vector<SlaveConfig> slaves;  // the first slave is next to the master
  TableSource source;

  // Protocol of all its slaves. Without slaves it is the first one of protocols().
  LineProtocol protocol() const;
};

struct Scenario {
  Scenario();

  std::string name = "scenario";  // file name as given, used in messages
  const Master* master;
  ChipConfig chip;
  HostConfig host;
  std::vector<ChannelConfig> channels;  // each number at most once
  std::vector<FaultConfig> faults;
  std::uint64_t seed = 1;
  TableSource source;  // of the whole file

  // Null if the scenario does not have it.
  const ChannelConfig* channel(unsigned number) const;
  const SlaveConfig* slave(unsigned number) const;
  // The channel that a slave of this number would be on.
  unsigned channel_of(unsigned slave) const;
};

// Reads a scenario from TOML text. `name` is used in messages. Up to its last slash it is also the
// folder to which file names inside the scenario are relative. Throws ScenarioError.
Scenario parse_scenario(std::string_view text, const std::string& name);

// The same from a file. Throws ScenarioError also if the file cannot be read.
Scenario load_scenario(const std::string& path);

}  // namespace mb4::sim

#endif  // MB4SIM_SCENARIO_HPP_
