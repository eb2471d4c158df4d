// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scenario/scenario.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/text_file.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/hosts/host_keys.hpp"
#include "sim/lines/protocols.hpp"
#include "sim/scenario/scenario_channel.hpp"
#include "sim/scenario/scenario_fault.hpp"
#include "sim/scenario/scenario_keys.hpp"

namespace mb4::sim {
namespace {

const Master& read_master(const TomlValue& table, TomlFile& file) {
  TomlReader reader(table, file);
  std::vector<std::string_view> types;
  for (const Master* each : masters()) types.push_back(each->type);
  const auto asked = reader.text("type");
  for (const LeftOut& each : masters_left_out()) {
    if (asked == each.type) reader.fail("type", left_out(each.type, each.option));
  }
  const Master& master = *masters()[reader.choice("type", types).value_or(0)];
  reader.finish();
  return master;
}

ChipConfig read_chip(const TomlValue& table, TomlFile& file, const Master& master) {
  TomlReader reader(table, file);
  ChipConfig chip;
  chip.quirks = master.quirks;
  chip.f_clk_hz = master.clk_hz;
  const std::int64_t least = master.clk_needed ? master.min_clk_hz : 0;
  if (const auto hz = reader.integer("f_clk_hz", least, master.max_clk_hz)) {
    if (*hz != 0 && *hz < master.min_clk_hz) {
      reader.fail("f_clk_hz", std::to_string(*hz) + " is below " +
                                  std::to_string(master.min_clk_hz) + " (0 = not connected)");
    }
    chip.f_clk_hz = static_cast<std::uint64_t>(*hz);
  }
  if (const auto hz = reader.integer("f_osc_hz", master.min_osc_hz, master.max_osc_hz)) {
    chip.f_osc_hz = static_cast<std::uint64_t>(*hz);
  }
  if (master.read_chip != nullptr) master.read_chip(reader, chip);
  if (const auto* quirks = reader.table("quirks")) {
    TomlReader quirks_reader(*quirks, file);
    master.read_quirks(quirks_reader, chip);
    quirks_reader.finish();
  }
  chip.source = reader.source();
  reader.finish();
  return chip;
}

HostConfig read_host(const TomlValue& table, TomlFile& file, const Master& master,
                     const ChipConfig& chip) {
  TomlReader reader(table, file);
  HostConfig host;
  read_interface(reader, master.interfaces, host);
  master.read_host(reader, chip, host);
  reader.finish();
  host.source = reader.source();
  return host;
}

// "; write number = 2", with the first number that is free; else empty.
std::string free_number(const Scenario& scenario) {
  for (unsigned number = 1; number <= scenario.master->channels; ++number) {
    if (scenario.channel(number) == nullptr) return "; write number = " + std::to_string(number);
  }
  return "";
}

void read_channels(const std::vector<TomlValue>& channels, TomlFile& file, Scenario& scenario) {
  unsigned place = 0;
  for (const TomlValue& table : channels) {
    const Master& master = *scenario.master;
    ChannelConfig channel = read_channel(table, file, master, ++place);
    const TomlReader reader(table, file);
    if (const ChannelConfig* first = scenario.channel(channel.number)) {
      reader.fail("number",
                  "channel " + std::to_string(channel.number) + " is given twice, first in line " +
                      std::to_string(first->source.of("number").line) + free_number(scenario));
    }
    scenario.channels.push_back(std::move(channel));
    unsigned last = 1;
    for (const ChannelConfig& each : scenario.channels) last = std::max(last, each.number);
    if (last == 1) continue;
    for (const ChannelConfig& each : scenario.channels) {
      if (each.slaves.size() > master.slaves_shared) {
        reader.fail("slave", "with channel " + std::to_string(last) +
                                 " in use a channel takes at most " +
                                 std::to_string(master.slaves_shared) + " slaves");
      }
    }
  }
}

}  // namespace

Scenario::Scenario() : master(masters().front()) {}

LineProtocol ChannelConfig::protocol() const {
  return slaves.empty() ? protocols().front()->blank()->traits().protocol
                        : slaves.front().protocol();
}

const ChannelConfig* Scenario::channel(unsigned number) const {
  for (const ChannelConfig& each : channels) {
    if (each.number == number) return &each;
  }
  return nullptr;
}

unsigned Scenario::channel_of(unsigned slave) const {
  unsigned found = 1;
  for (const ChannelConfig& each : channels) {
    if (slave >= master->first_slave(each.number)) found = std::max(found, each.number);
  }
  return found;
}

const SlaveConfig* Scenario::slave(unsigned number) const {
  if (number == 0) return nullptr;
  const unsigned place = channel_of(number);
  const ChannelConfig* found = channel(place);
  const unsigned index = number - master->first_slave(place);
  return found != nullptr && index < found->slaves.size() ? &found->slaves[index] : nullptr;
}

namespace {

// `file` may list what is asked for.
Scenario read_scenario(const TomlValue& root, TomlFile& file) {
  Scenario scenario;
  scenario.name = file.name;
  if (file.asked == nullptr) {
    file.advice = [&scenario](const TomlValue& table, std::string_view key) {
      return place_of_key(*scenario.master, table, key);
    };
  }
  TomlReader reader(root, file);
  const auto* master = reader.table("master");
  const auto* chip = reader.table("chip");
  const auto* host = reader.table("host");
  const auto* sim = reader.table("sim");
  const auto* channels = reader.tables("channel");
  const auto* faults = reader.tables("fault");
  reader.finish();
  if (master != nullptr) scenario.master = &read_master(*master, file);
  scenario.chip.quirks = scenario.master->quirks;
  scenario.chip.f_clk_hz = scenario.master->clk_hz;
  if (chip != nullptr) scenario.chip = read_chip(*chip, file, *scenario.master);
  TomlValue none;
  none.where.table = "[host]";
  scenario.host = read_host(host != nullptr ? *host : none, file, *scenario.master, scenario.chip);
  if (sim != nullptr) {
    TomlReader sim_reader(*sim, file);
    scenario.seed = sim_reader.word("seed").value_or(scenario.seed);
    sim_reader.finish();
  }
  if (channels != nullptr) read_channels(*channels, file, scenario);
  if (faults != nullptr) {
    for (const auto& node : *faults) {
      scenario.faults.push_back(read_fault(node, scenario, file));
    }
  }
  TomlReader::throw_missing(file);
  scenario.source = reader.source();
  file.advice = nullptr;  // it looks into `scenario`
  return scenario;
}

}  // namespace

std::vector<AskedKey> keys_asked_for(std::string_view text) {
  std::vector<AskedKey> asked;
  TomlFile file{.name = "", .missing = std::nullopt, .asked = &asked};
  try {
    (void)read_scenario(parse_toml(text, ""), file);
  } catch (const ScenarioError&) {
    // What comes behind the mistake is not asked for.
  }
  return asked;
}

Scenario parse_scenario(std::string_view text, const std::string& name) {
  const TomlValue root = parse_toml(text, name);
  TomlFile file{.name = name, .missing = std::nullopt};
  return read_scenario(root, file);
}

Scenario load_scenario(const std::string& path) {
  return parse_scenario(read_text_file(path), path);
}

}  // namespace mb4::sim
