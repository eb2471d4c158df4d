// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "scenario_slave.hpp"

#include <utility>
#include <variant>

#include "mb4sim/presets.hpp"
#include "scenario_registers.hpp"
#include "scenario_sensor.hpp"
#include "text_file.hpp"
#include "toml_reader.hpp"

namespace mb4::sim {
namespace {

constexpr std::int64_t kMaxBusy = 1'000'000;
constexpr double kMaxResponseNs = 1e5;
constexpr unsigned kFlagsOfEncoders = 2;

// Returns the preset that the scenario names, which must be one of this protocol. Without the key
// it returns a default whose data_bits must be given.
template <typename Config>
Config read_preset(TomlReader& reader, SlaveConfig& slave) {
  const auto name = reader.text("preset");
  if (!name) {
    Config config;
    config.data_bits = 0;
    return config;
  }
  const Preset* preset = preset_by_name(*name);
  if (preset == nullptr || !std::holds_alternative<Config>(preset->device)) {
    std::string list;
    for (const Preset& each : presets()) {
      if (!std::holds_alternative<Config>(each.device)) continue;
      list += (list.empty() ? "" : ", ") + std::string(each.name);
    }
    reader.fail("preset", (preset == nullptr ? "unknown preset '" + *name + "'"
                                             : "'" + *name + "' speaks another protocol") +
                              ", expected one of: " + list);
  }
  for (const auto& run : preset->registers) {
    std::uint8_t address = run.address;
    for (const std::uint8_t value : run.values) slave.registers[address++] = value;
  }
  return std::get<Config>(preset->device);
}

// Reads the keys for acknowledge and processing time.
template <typename Config>
void read_request(TomlReader& reader, Config& config) {
  config.passes_acknowledge =
      reader.choice("acknowledge", {"latched", "passed-on"}).value_or(0) == 1;
  if (const auto busy = reader.integer("busy_periods", 0, kMaxBusy)) {
    config.busy_periods = static_cast<unsigned>(*busy);
  }
}

void read_actuator(TomlReader& reader, BissCSlaveConfig& config) {
  config.actuator = reader.boolean("actuator").value_or(false);
  if (const auto stop_bit = reader.boolean("stop_bit")) {
    if (!config.actuator) reader.fail("stop_bit", "only an actuator has it");
    config.stop_bit = *stop_bit;
  }
  if (config.actuator && reader.has("source")) {
    reader.fail("source", "an actuator has none; data is the word that it holds at first");
  }
}

SlaveConfig read_biss_c(TomlReader& reader) {
  SlaveConfig slave;
  auto config = read_preset<BissCSlaveConfig>(reader, slave);
  read_actuator(reader, config);
  read_sensor(reader, config, config.actuator ? 0 : kFlagsOfEncoders, slave.file);
  read_timeout(reader, config.timeout);
  read_request(reader, config);
  read_control(reader, config.control);
  slave.device = std::move(config);
  return slave;
}

SlaveConfig read_biss_b(TomlReader& reader) {
  SlaveConfig slave;
  auto config = read_preset<BissBSlaveConfig>(reader, slave);
  read_sensor(reader, config, kFlagsOfEncoders, slave.file);
  read_timeout(reader, config.timeout);
  const toml::node* node = reader.node("register_timeout");
  if (node != nullptr && node->is_string()) {
    if (node->as_string()->get() != "adaptive") {
      reader.fail("register_timeout", "expected \"adaptive\" or a number of microseconds");
    }
    config.register_timeout = 0;
  } else {
    read_timeout_us(reader, "register_timeout", config.register_timeout);
  }
  read_request(reader, config);
  read_access(reader, config.access);
  slave.device = std::move(config);
  return slave;
}

SlaveConfig read_ssi(TomlReader& reader) {
  SlaveConfig slave;
  auto config = read_preset<SsiSlaveConfig>(reader, slave);
  read_sensor(reader, config, 0, slave.file);
  read_timeout_us(reader, "timeout", config.monoflop);
  config.gray = reader.boolean("gray").value_or(config.gray);
  config.ring = reader.boolean("ring").value_or(config.ring);
  if (const auto ns = reader.number("response_ns", 0, kMaxResponseNs)) {
    config.response = from_ns(*ns);
  }
  read_control(reader, config.control);
  slave.device = std::move(config);
  return slave;
}

SlaveConfig read_replay(TomlReader& reader) {
  ReplaySlaveConfig config;
  config.data_bits = 0;
  read_lengths(reader, config.data_bits, config.flag_bits, kFlagsOfEncoders);
  config.crc = Crc{0x43, 0};
  read_crc(reader, config.crc);
  if (reader.choice("play", {"time", "clock"}).value_or(0) == 1) {
    config.play = ReplaySlaveConfig::Play::kClock;
    read_timeout(reader, config.timeout);
  } else if (reader.has("timeout")) {
    reader.fail("timeout", "only with play = \"clock\": the recording holds the timeout");
  }
  const auto name = reader.file_name("edges");
  SlaveConfig slave;
  if (!name) {
    reader.missing("edges", "missing: protocol \"replay\" needs a file of edges");
    slave.device = std::move(config);
    return slave;
  }
  const std::string path = beside(reader.file().name, *name);
  std::string text;
  try {
    text = read_text_file(path);
  } catch (const ScenarioError& error) {
    reader.fail("edges", error.what());
  }
  try {
    config.recording = parse_recording(text, path);
  } catch (const RecordingError& error) {
    throw ScenarioError(error.what());
  }
  slave.device = std::move(config);
  slave.file = path;
  return slave;
}

// Lists the keys that a slave of any protocol can have.
void know_any_protocol(TomlReader& reader) {
  reader.know({"preset", "data_bits", "flag_bits", "flags", "crc", "crc_start", "registers"});
  reader.know({"data", "source", "start", "step", "amplitude", "period_us", "offset", "file"});
  reader.know(
      {"repeat", "timeout", "t_sample_ns", "busy_periods", "acknowledge", "actuator", "stop_bit"});
  reader.know({"control", "ids", "banks", "missing", "write_protected", "register_timeout"});
  reader.know({"read_busy_frames", "read_busy_us", "write_busy_frames", "write_busy_us"});
  reader.know({"store_busy_frames", "store_busy_us", "read_busy_clocks"});
  reader.know({"gray", "ring", "response_ns", "edges", "play"});
}

}  // namespace

SlaveConfig read_slave(const toml::table& table, TomlFile& file) {
  TomlReader reader(table, file);
  const auto protocol = reader.choice("protocol", {"biss-c", "replay", "biss-b", "ssi"});
  if (!protocol) {
    reader.missing("protocol");
    know_any_protocol(reader);
    reader.finish();
    return {};
  }
  constexpr SlaveConfig (*kReaders[])(TomlReader&) = {read_biss_c, read_replay, read_biss_b,
                                                      read_ssi};
  SlaveConfig slave = kReaders[*protocol](reader);
  read_registers(reader, slave.registers);
  reader.finish();
  slave.source = reader.source();
  return slave;
}

}  // namespace mb4::sim
