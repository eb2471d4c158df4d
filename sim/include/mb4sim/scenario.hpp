// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A scenario: everything outside and around the chip. It is read from a TOML file. sim/README.md
// lists every key with unit, range and default.
#ifndef MB4SIM_SCENARIO_HPP_
#define MB4SIM_SCENARIO_HPP_

#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mb4sim/biss_b_slave.hpp"
#include "mb4sim/biss_c_slave.hpp"
#include "mb4sim/cable.hpp"
#include "mb4sim/fault.hpp"
#include "mb4sim/one_line.hpp"
#include "mb4sim/replay_slave.hpp"
#include "mb4sim/ssi_slave.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

// Largest number of slaves of a chip: it has as many single-cycle data channels.
inline constexpr unsigned kMaxSlaves = 8;

// A place in the scenario file. Line and column count from 1; 0 = unknown.
struct SourcePos {
  unsigned line = 0;
  unsigned column = 0;
};

// The place of a table in the scenario, and of the values of its keys.
struct TableSource {
  SourcePos table;
  std::map<std::string, SourcePos, std::less<>> keys;

  // Returns the place of the value if the key is there, else that of the table.
  SourcePos of(std::string_view key) const;
};

struct ChipConfig {
  std::uint64_t f_clk_hz = 20'000'000;  // pin CLK; 0 = not connected, the pin stays 0
  std::uint64_t f_osc_hz = 20'000'000;  // internal oscillator
  // Port quirks_i of the chip; mb4_pkg names the bits.
  unsigned quirks = 0;
  TableSource source;

  // The frequency that the chip is meant to run from: pin CLK if it is connected, else the
  // oscillator.
  std::uint64_t system_hz() const { return f_clk_hz != 0 ? f_clk_hz : f_osc_hz; }
};

// The connection of the host. kSpi2: SPI with the second serial interface enabled.
enum class HostInterface { kSpi, kSpi2, kIntel, kMotorola };

struct HostConfig {
  HostInterface interface = HostInterface::kSpi;
  std::uint64_t sclk_hz = 10'000'000;   // SPI
  std::uint64_t sclk2_hz = 10'000'000;  // SPI2
  Time cycle = 1000 * kPsPerNs;         // of the parallel bus, ps

  bool parallel() const {
    return interface == HostInterface::kIntel || interface == HostInterface::kMotorola;
  }
  // MA frequency that `mb4sim run` sets up. The chip can always make it.
  std::uint64_t ma_hz = 10'000'000;
  TableSource source;
};

// Protocol of the slaves of a line. A replay of a BiSS C frame counts as BiSS C.
enum class LineProtocol { kBissB, kBissC, kSsi };

struct SlaveConfig {
  std::variant<BissCSlaveConfig, BissBSlaveConfig, SsiSlaveConfig, ReplaySlaveConfig> device;
  std::map<std::uint8_t, std::uint8_t> registers;
  std::string file;  // file from which words or edges were read; empty: none
  TableSource source;

  const std::string& name() const;
  unsigned data_bits() const;
  unsigned flag_bits() const;
  const Crc& crc() const;
  LineProtocol protocol() const;
};

struct ChannelConfig {
  unsigned number = 1;  // 1 or 2
  Time delay = 0;       // round trip with transceivers, ps
  CableConfig cable;
  std::vector<SlaveConfig> slaves;  // the first slave is next to SL
  // The inverted bits of each frame by its number, as SlFaults::flip_frame() takes them.
  std::map<std::uint64_t, std::vector<unsigned>> flips;
  TableSource source;

  // Protocol of all its slaves; kBissC if it has no slaves.
  LineProtocol protocol() const;
};

struct Scenario {
  std::string name = "scenario";  // file name as given, used in messages
  ChipConfig chip;
  HostConfig host;
  std::vector<ChannelConfig> channels;  // each number at most once
  std::vector<FaultConfig> faults;
  std::uint64_t seed = 1;
  TableSource source;  // of the whole file

  const ChannelConfig* channel(unsigned number) const;
};

// A mistake in a scenario or in a file that it names. what() is one complete line:
// "file:line:column: key 'x': message". Line and column are missing where there is none. Control
// characters are escaped (one_line.hpp).
class ScenarioError : public std::runtime_error {
 public:
  explicit ScenarioError(const std::string& message) : std::runtime_error(one_line(message)) {}
  ScenarioError(const std::string& file, SourcePos where, std::string_view key,
                const std::string& message);
};

// Reads a scenario from TOML text. `name` is used in messages. Up to its last slash it is also the
// folder to which file names inside the scenario are relative. Throws ScenarioError.
Scenario parse_scenario(std::string_view text, const std::string& name);

// The same from a file. Throws ScenarioError also if the file cannot be read.
Scenario load_scenario(const std::string& path);

}  // namespace mb4::sim

#endif  // MB4SIM_SCENARIO_HPP_
