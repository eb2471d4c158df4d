// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scenario/scenario_slave.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/toml_reader.hpp"
#include "sim/lines/line_kind.hpp"
#include "sim/lines/presets.hpp"
#include "sim/lines/protocols.hpp"
#include "sim/lines/register_bytes.hpp"

namespace mb4::sim {
namespace {

// Returns the device of the preset that the scenario names, which must be one of this protocol.
// Without the key it returns a device whose data_bits must be given.
Device read_preset(TomlReader& reader, const Protocol& protocol,
                   std::map<std::uint8_t, std::uint8_t>& registers) {
  Device blank = protocol.blank();
  blank->data_bits = 0;
  if (protocol.presets == nullptr) return blank;
  const auto name = reader.text("preset");
  if (!name) return blank;
  const Preset* preset = preset_by_name(*name);
  const auto fits = [&](const Preset& one) {
    return one.device->traits().protocol.key == protocol.key;
  };
  if (preset == nullptr || !fits(*preset)) {
    std::string list;
    for (const Preset& each : presets()) {
      if (fits(each)) list += (list.empty() ? "" : ", ") + std::string(each.name);
    }
    reader.fail("preset", (preset == nullptr ? "unknown preset '" + *name + "'"
                                             : "'" + *name + "' speaks another protocol") +
                              ", expected one of: " + list);
  }
  for (const auto& run : preset->registers) {
    std::uint8_t address = run.address;
    for (const std::uint8_t value : run.values) registers[address++] = value;
  }
  return preset->device;
}

}  // namespace

SlaveConfig read_slave(const TomlValue& table, TomlFile& file, const LineKind& line) {
  TomlReader reader(table, file);
  SlaveConfig slave;
  std::vector<std::string_view> names;
  for (const Protocol* each : protocols()) names.push_back(each->key);
  const auto which = reader.choice("protocol", names);
  if (!which) {
    reader.missing("protocol");
    reader.know({"registers"});
    for (const Protocol* each : protocols()) {
      if (each->line != &line) continue;
      if (each->presets != nullptr) reader.know({"preset"});
      each->know_keys(reader);
    }
    reader.finish();
    slave.device = protocols().front()->blank();
    return slave;
  }
  const Protocol& protocol = *protocols()[*which];
  if (protocol.line != &line) {
    reader.fail("protocol", "'" + std::string(protocol.key) + "' needs a line of the kind '" +
                                std::string(protocol.line->key) + "', the master's are '" +
                                std::string(line.key) + "'");
  }
  slave.device = read_preset(reader, protocol, slave.registers);
  protocol.read(reader, *slave.device, slave.file);
  read_registers(reader, slave.registers);
  reader.finish();
  slave.source = reader.source();
  return slave;
}

}  // namespace mb4::sim
