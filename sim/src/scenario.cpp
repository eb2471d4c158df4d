// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "mb4sim/ma_frequency.hpp"
#include "number_text.hpp"
#include "scenario_channel.hpp"
#include "scenario_fault.hpp"
#include "text_file.hpp"
#include "toml_reader.hpp"

namespace mb4::sim {
namespace {

constexpr std::int64_t kMinClkHz = 1'000;
constexpr std::int64_t kMaxClkHz = 200'000'000;
constexpr std::int64_t kMinOscHz = 10'000'000;
constexpr std::int64_t kMaxOscHz = 25'000'000;
constexpr std::int64_t kMinSclkHz = 1'000;
constexpr std::int64_t kMaxSclkHz = 50'000'000;  // I203, I204: 10 ns each
constexpr unsigned kSlavesOfOneOfTwoChannels = 4;
constexpr std::int64_t kMinCycleNs = 110;  // 15 + 15 + 54 + 25 ns of a read
constexpr std::int64_t kMaxCycleNs = 1'000'000;

// Bits of quirks_i, as in mb4_pkg.
constexpr std::pair<const char*, unsigned> kQuirkBits[] = {{"IDA_TEST_INVERT", 0},
                                                           {"AGSERR_ON_INSTR_WRITE", 1},
                                                           {"AGSERR_ON_HOLDBANK", 2},
                                                           {"AGS_CLEARED_ON_ERROR", 3}};
constexpr unsigned kQuirkRevisionBit = 4;
constexpr std::pair<std::int64_t, unsigned> kRevisions[] = {{0x20, 0}, {0x10, 1}, {0x11, 2}};

void read_quirks(const toml::table& table, TomlFile& file, ChipConfig& chip) {
  TomlReader reader(table, file);
  for (const auto& [name, bit] : kQuirkBits) {
    if (const auto on = reader.boolean(name)) {
      chip.quirks = (chip.quirks & ~(1U << bit)) | (static_cast<unsigned>(*on) << bit);
    }
  }
  if (const auto revision = reader.integer("REVISION", 0, 0xFF)) {
    const auto* found = std::find_if(std::begin(kRevisions), std::end(kRevisions),
                                     [&](const auto& entry) { return entry.first == *revision; });
    if (found == std::end(kRevisions)) {
      reader.fail("REVISION", "expected 0x20 (Y), 0x10 (Z) or 0x11 (Z1)");
    }
    chip.quirks |= found->second << kQuirkRevisionBit;
  }
  reader.finish();
}

ChipConfig read_chip(const toml::table& table, TomlFile& file) {
  TomlReader reader(table, file);
  ChipConfig chip;
  if (const auto hz = reader.integer("f_clk_hz", 0, kMaxClkHz)) {
    if (*hz != 0 && *hz < kMinClkHz) {
      reader.fail("f_clk_hz", std::to_string(*hz) + " is below 1000 (0 = not connected)");
    }
    chip.f_clk_hz = static_cast<std::uint64_t>(*hz);
  }
  if (const auto hz = reader.integer("f_osc_hz", kMinOscHz, kMaxOscHz)) {
    chip.f_osc_hz = static_cast<std::uint64_t>(*hz);
  }
  if (const auto* quirks = reader.table("quirks")) read_quirks(*quirks, file, chip);
  chip.source = reader.source();
  reader.finish();
  return chip;
}

HostConfig read_host(const toml::table& table, TomlFile& file, const ChipConfig& chip) {
  TomlReader reader(table, file);
  HostConfig host;
  if (const auto which = reader.choice("interface", {"spi", "spi2", "intel", "motorola"})) {
    host.interface = static_cast<HostInterface>(*which);
  }
  if (const auto hz = reader.integer("sclk_hz", kMinSclkHz, kMaxSclkHz)) {
    host.sclk_hz = host.sclk2_hz = static_cast<std::uint64_t>(*hz);
  }
  if (const auto hz = reader.integer("sclk2_hz", kMinSclkHz, kMaxSclkHz)) {
    host.sclk2_hz = static_cast<std::uint64_t>(*hz);
  }
  if (const auto ns = reader.integer("cycle_ns", kMinCycleNs, kMaxCycleNs)) {
    host.cycle = static_cast<Time>(*ns) * kPsPerNs;
  }
  host.ma_hz = default_ma_frequency(chip.system_hz());
  if (const auto hz = reader.integer("ma_hz", 1, kMaxClkHz)) {
    host.ma_hz = static_cast<std::uint64_t>(*hz);
    if (!freqs_code(chip.system_hz(), host.ma_hz)) {
      const NearestMa nearest = nearest_ma(chip.system_hz(), host.ma_hz);
      std::string choice;
      if (nearest.below != 0) choice = std::to_string(nearest.below);
      if (nearest.above != 0) {
        choice += (choice.empty() ? "" : " and ") + std::to_string(nearest.above);
      }
      reader.fail("ma_hz", "the chip cannot make " + std::to_string(host.ma_hz) + " Hz from " +
                               std::to_string(chip.system_hz()) + " Hz; nearest: " + choice);
    }
  }
  reader.finish();
  host.source = reader.source();
  return host;
}

void read_channels(const toml::array& channels, TomlFile& file, Scenario& scenario) {
  for (const auto& node : channels) {
    const toml::table& table = *node.as_table();
    ChannelConfig channel = read_channel(table, file);
    const TomlReader reader(table, file);
    if (scenario.channel(channel.number) != nullptr) {
      reader.fail("number", "channel " + std::to_string(channel.number) + " is given twice");
    }
    scenario.channels.push_back(std::move(channel));
    // With two channels SLAVELOC5 gives slaves 1 to 4 to channel 1 and 5 to 8 to channel 2.
    if (scenario.channel(2) != nullptr) {
      for (const ChannelConfig& each : scenario.channels) {
        if (each.slaves.size() > kSlavesOfOneOfTwoChannels) {
          reader.fail("slave", "with channel 2 in use a channel takes at most 4 slaves");
        }
      }
    }
  }
}

}  // namespace

const std::string& SlaveConfig::name() const {
  return std::visit([](const auto& d) -> const std::string& { return d.name; }, device);
}
unsigned SlaveConfig::data_bits() const {
  return std::visit([](const auto& d) { return d.data_bits; }, device);
}
unsigned SlaveConfig::flag_bits() const {
  return std::visit([](const auto& d) { return d.flag_bits; }, device);
}
const Crc& SlaveConfig::crc() const {
  return std::visit([](const auto& d) -> const Crc& { return d.crc; }, device);
}

LineProtocol SlaveConfig::protocol() const {
  if (std::holds_alternative<BissBSlaveConfig>(device)) return LineProtocol::kBissB;
  return std::holds_alternative<SsiSlaveConfig>(device) ? LineProtocol::kSsi : LineProtocol::kBissC;
}

LineProtocol ChannelConfig::protocol() const {
  return slaves.empty() ? LineProtocol::kBissC : slaves.front().protocol();
}

SourcePos TableSource::of(std::string_view key) const {
  const auto found = keys.find(key);
  return found == keys.end() ? table : found->second;
}

ScenarioError::ScenarioError(const std::string& file, SourcePos where, std::string_view key,
                             const std::string& message)
    : ScenarioError(file + ":" +
                    (where.line == 0
                         ? ""
                         : std::to_string(where.line) + ":" + std::to_string(where.column) + ":") +
                    " key '" + std::string(key) + "': " + message) {}

const ChannelConfig* Scenario::channel(unsigned number) const {
  for (const ChannelConfig& each : channels) {
    if (each.number == number) return &each;
  }
  return nullptr;
}

Scenario parse_scenario(std::string_view text, const std::string& name) {
  Scenario scenario;
  scenario.name = name;
  toml::table root;
  try {
    root = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const auto where = error.source().begin;
    std::string description(error.description());
    std::replace(description.begin(), description.end(), '\n', ' ');
    throw ScenarioError(name + ":" + std::to_string(where.line) + ":" +
                        std::to_string(where.column) + ": not valid TOML: " + description);
  }
  TomlFile file{name, std::nullopt};
  TomlReader reader(root, file);
  const auto* chip = reader.table("chip");
  const auto* host = reader.table("host");
  const auto* sim = reader.table("sim");
  const auto* channels = reader.tables("channel");
  const auto* faults = reader.tables("fault");
  reader.finish();
  if (chip != nullptr) scenario.chip = read_chip(*chip, file);
  const toml::table none;
  scenario.host = read_host(host != nullptr ? *host : none, file, scenario.chip);
  if (sim != nullptr) {
    TomlReader sim_reader(*sim, file);
    scenario.seed = sim_reader.word("seed").value_or(scenario.seed);
    sim_reader.finish();
  }
  if (channels != nullptr) read_channels(*channels, file, scenario);
  if (faults != nullptr) {
    for (const auto& node : *faults) {
      scenario.faults.push_back(read_fault(*node.as_table(), scenario, file));
    }
  }
  TomlReader::throw_missing(file);
  scenario.source = reader.source();
  return scenario;
}

Scenario load_scenario(const std::string& path) {
  return parse_scenario(read_text_file(path), path);
}

}  // namespace mb4::sim
