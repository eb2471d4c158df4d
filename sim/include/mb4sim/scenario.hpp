// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A scenario: everything outside and around the chip, as read from a TOML file. sim/README.md lists
// every key with unit, range and default.
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

// Largest number of slaves of a chip (single-cycle data channels).
inline constexpr unsigned kMaxSlaves = 8;

// Place in the scenario file, both counted from 1; 0 = unknown.
struct SourcePos {
  unsigned line = 0;
  unsigned column = 0;
};

// Where a table of the scenario and the values of its keys stand.
struct TableSource {
  SourcePos table;
  std::map<std::string, SourcePos, std::less<>> keys;

  // Of the value if the key is there, else of the table.
  SourcePos of(std::string_view key) const;
};

struct ChipConfig {
  std::uint64_t f_clk_hz = 20'000'000;  // pin CLK; 0 = not connected, pin stays 0
  std::uint64_t f_osc_hz = 20'000'000;  // internal oscillator
  // quirks_i of the chip, bits as in mb4_pkg; the default sets AGSERR_ON_HOLDBANK only.
  unsigned quirks = 0b000100;
  TableSource source;

  // Frequency the chip is meant to run from: pin CLK if connected, else the oscillator.
  std::uint64_t system_hz() const { return f_clk_hz != 0 ? f_clk_hz : f_osc_hz; }
};

// How the host is connected. kSpi2: SPI, and the second serial interface is enabled beside it.
enum class HostInterface { kSpi, kSpi2, kIntel, kMotorola };

struct HostConfig {
  HostInterface interface = HostInterface::kSpi;
  std::uint64_t sclk_hz = 10'000'000;   // SPI
  std::uint64_t sclk2_hz = 10'000'000;  // SPI2
  Time cycle = 1000 * kPsPerNs;         // of the parallel bus, ps

  bool parallel() const {
    return interface == HostInterface::kIntel || interface == HostInterface::kMotorola;
  }
  // MA frequency that `mb4sim run` sets up; always one the chip can make.
  std::uint64_t ma_hz = 10'000'000;
  TableSource source;
};

// What the slaves of a line speak; a replay of a BiSS C frame counts as BiSS C.
enum class LineProtocol { kBissB, kBissC, kSsi };

struct SlaveConfig {
  std::variant<BissCSlaveConfig, BissBSlaveConfig, SsiSlaveConfig, ReplaySlaveConfig> device;
  std::map<std::uint8_t, std::uint8_t> registers;
  std::string file;  // words or edges were read from it; empty: none
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
  std::vector<SlaveConfig> slaves;  // first = next to SL
  // Inverted bits by the number of the frame, as SlFaults::flip_frame() takes them.
  std::map<std::uint64_t, std::vector<unsigned>> flips;
  TableSource source;

  // Of all its slaves; kBissC without any.
  LineProtocol protocol() const;
};

struct Scenario {
  std::string name = "scenario";  // file name as given, for messages
  ChipConfig chip;
  HostConfig host;
  std::vector<ChannelConfig> channels;  // each number at most once
  std::vector<FaultConfig> faults;
  std::uint64_t seed = 1;
  TableSource source;  // of the whole file

  const ChannelConfig* channel(unsigned number) const;
};

// A mistake in a scenario or in a file it names. what() is one complete line:
// "file:line:column: key 'x': message", without line and column where there is none. Control
// characters are escaped (one_line.hpp).
class ScenarioError : public std::runtime_error {
 public:
  explicit ScenarioError(const std::string& message) : std::runtime_error(one_line(message)) {}
  ScenarioError(const std::string& file, SourcePos where, std::string_view key,
                const std::string& message);
};

// Reads a scenario from TOML text. `name` is used in messages and, up to its last slash, as the
// folder to which file names inside the scenario are relative. Throws ScenarioError.
Scenario parse_scenario(std::string_view text, const std::string& name);

// The same from a file.
Scenario load_scenario(const std::string& path);

}  // namespace mb4::sim

#endif  // MB4SIM_SCENARIO_HPP_
