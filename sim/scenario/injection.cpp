// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scenario/injection.hpp"

#include "sim/core/toml_reader.hpp"
#include "sim/lines/line_keys.hpp"
#include "sim/scenario/scenario_channel.hpp"
#include "sim/scenario/scenario_fault.hpp"

namespace mb4::sim {
namespace {

void read_channel_events(const TomlValue& table, TomlFile& file, const Scenario& scenario,
                         Injection& injection) {
  TomlReader reader(table, file);
  const auto number = reader.integer("number", 1, scenario.master->channels);
  if (!number) reader.missing("number");
  const auto channel = static_cast<unsigned>(number.value_or(0));
  for (const LineEvent& event : read_events(reader, scenario.master->line->wires)) {
    injection.events.push_back({channel, event});
  }
  reader.finish();
  if (number && scenario.channel(channel) == nullptr) {
    reader.fail("number", "the scenario has no channel " + std::to_string(channel));
  }
}

// kNever stays.
void shift(Time& time, Time now) {
  if (time != kNever) time += now;
}

}  // namespace

Injection parse_injection(std::string_view text, const std::string& name, const Scenario& scenario,
                          Time now) {
  const TomlValue root = parse_toml(text, name);
  TomlFile file{name, std::nullopt};
  TomlReader reader(root, file);
  const auto* channels = reader.tables("channel");
  const auto* faults = reader.tables("fault");
  reader.finish();
  Injection injection;
  if (channels != nullptr) {
    for (const auto& node : *channels) {
      read_channel_events(node, file, scenario, injection);
    }
  }
  if (faults != nullptr) {
    for (const auto& node : *faults) {
      injection.faults.push_back(read_fault(node, scenario, file));
    }
  }
  TomlReader::throw_missing(file);
  for (FaultConfig& fault : injection.faults) {
    fault.scenario_line = 0;
    for (Time& at : fault.at) shift(at, now);
    shift(fault.from, now);
    shift(fault.to, now);
  }
  for (Injection::Event& each : injection.events) shift(each.event.time, now);
  return injection;
}

}  // namespace mb4::sim
