// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scenario/scenario_slave.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/suggestion.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/lines/line_kind.hpp"
#include "sim/lines/presets.hpp"
#include "sim/lines/protocols.hpp"
#include "sim/lines/register_bytes.hpp"
#include "sim/masters/master.hpp"

namespace mb4::sim {
namespace {

// Presets of one protocol, or of all protocols of this kind of line.
std::vector<const Preset*> presets_of(const Protocol* protocol, const LineKind& line) {
  std::vector<const Preset*> found;
  for (const Protocol* each : protocols()) {
    if (each->presets == nullptr || each->line != &line) continue;
    if (protocol != nullptr && each != protocol) continue;
    for (const Preset& preset : presets()) {
      if (preset.device->traits().protocol.key == each->key) found.push_back(&preset);
    }
  }
  return found;
}

// The preset that the scenario names, which must be of this protocol, if one is given. Null without
// the key.
const Preset* read_preset(TomlReader& reader, const Protocol* protocol, const LineKind& line) {
  const std::vector<const Preset*> fitting = presets_of(protocol, line);
  if (fitting.empty()) return nullptr;  // the protocol has no such key
  std::vector<std::string_view> names;
  for (const Preset* each : fitting) names.push_back(each->name);
  reader.offer("preset", names);
  const auto name = reader.text("preset");
  if (!name) return nullptr;
  const Preset* preset = preset_by_name(*name);
  if (std::find(fitting.begin(), fitting.end(), preset) != fitting.end()) return preset;
  std::string list;
  for (const std::string_view each : names) {
    list += (list.empty() ? "" : ", ") + std::string(each);
  }
  const std::string near = did_you_mean(*name, {names.begin(), names.end()});
  reader.fail("preset",
              (preset == nullptr ? "unknown preset '" + *name + "' (`mb4sim presets` lists all)"
                                 : "'" + *name + "' speaks another protocol") +
                  ", expected one of: " + list + (preset == nullptr ? near : ""));
}

// The protocol that the scenario names. Null without the key.
const Protocol* read_protocol(TomlReader& reader, const Master& master) {
  std::vector<std::string_view> names;
  for (const Protocol* each : protocols()) names.push_back(each->key);
  const auto which = reader.choice("protocol", names);
  if (!which) return nullptr;
  const Protocol& protocol = *protocols()[*which];
  if (protocol.line == master.line) return &protocol;
  std::string advice;
  for (const Master* each : masters()) {
    if (each->line != protocol.line) continue;
    advice += advice.empty() ? "; write [master] with type = \"" : " or type = \"";
    advice += each->type;
    advice += '"';
  }
  std::string message(1, '\'');
  message.append(protocol.key).append("' needs a line of the kind '").append(protocol.line->key);
  message.append("', the master's are '").append(master.line->key).append("'").append(advice);
  reader.fail("protocol", message);
}

// Without a protocol all keys are known.
SlaveConfig without_protocol(TomlReader& reader, const LineKind& line) {
  reader.missing("protocol", "missing, and there is no preset");
  reader.know({"registers"});
  for (const Protocol* each : protocols()) {
    if (each->line == &line) each->know_keys(reader);
  }
  reader.finish();
  SlaveConfig slave;
  slave.device = protocols().front()->blank();
  return slave;
}

const Protocol* protocol_of(const Preset& preset) {
  const auto all = protocols();
  return *std::find_if(all.begin(), all.end(), [&](const Protocol* each) {
    return each->key == preset.device->traits().protocol.key;
  });
}

}  // namespace

SlaveConfig read_slave(const TomlValue& table, TomlFile& file, const Master& master) {
  TomlReader reader(table, file);
  if (reader.has("number")) {
    reader.fail("number", "a slave has no number: the order in the file counts");
  }
  const Protocol* protocol = read_protocol(reader, master);
  const Preset* preset = read_preset(reader, protocol, *master.line);
  if (protocol == nullptr && preset == nullptr) return without_protocol(reader, *master.line);
  if (protocol == nullptr) protocol = protocol_of(*preset);
  SlaveConfig slave;
  if (preset == nullptr) {
    slave.device = protocol->blank();
    slave.device->data_bits = 0;  // must be given
  } else {
    slave.device = preset->device;
    for (const auto& run : preset->registers) {
      std::uint8_t address = run.address;
      for (const std::uint8_t value : run.values) slave.registers[address++] = value;
    }
  }
  protocol->read(reader, *slave.device, slave.file);
  read_registers(reader, slave.registers);
  reader.finish();
  slave.source = reader.source();
  return slave;
}

}  // namespace mb4::sim
