// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "report/exit_status.hpp"
#include "report/messages.hpp"
#include "scenario_argument.hpp"
#include "sim/core/one_line.hpp"
#include "sim/core/suggestion.hpp"
#include "sim/lines/presets.hpp"

namespace mb4::tool {
namespace {

struct Cells {
  std::string protocol;
  std::string data_bits;  // "-": the scenario has to say
  unsigned flag_bits = 0;
  std::string crc;
  std::string timeout;
  bool control = false;  // registers can be reached
};

Cells cells(const sim::Preset& preset) {
  const sim::DeviceConfig& device = *preset.device;
  const sim::DeviceTraits traits = device.traits();
  Cells out;
  out.protocol = traits.protocol.key;
  out.data_bits = device.data_bits == 0 ? "-" : fmt::format("{}", device.data_bits);
  out.flag_bits = device.flag_bits;
  out.crc = device.crc.polynomial == 0 ? "-" : fmt::format("0x{:X}", device.crc.polynomial);
  out.timeout =
      traits.timeout == 0 ? "adaptive" : fmt::format("{:g} us", sim::to_us(traits.timeout));
  out.control = traits.registers;
  return out;
}

constexpr const char* kPresetsRow = "{:<20}  {:<8}  {:>4}  {:>5}  {:>5}  {:<9}  {:<9}  {}\n";

void print_table() {
  fmt::print(kPresetsRow, "preset", "protocol", "bits", "flags", "CRC", "timeout", "registers",
             "encoder");
  for (const sim::Preset& preset : sim::presets()) {
    const Cells c = cells(preset);
    fmt::print(kPresetsRow, preset.name, c.protocol, c.data_bits, c.flag_bits, c.crc, c.timeout,
               c.control ? "yes" : "no", preset.description);
  }
}

void print_json() {
  fmt::print("[");
  const char* separator = "\n";
  for (const sim::Preset& preset : sim::presets()) {
    const Cells c = cells(preset);
    fmt::print(
        "{}  {{\"preset\": {}, \"protocol\": \"{}\", \"data_bits\": {}, \"flag_bits\": {}, "
        "\"crc\": {}, \"timeout\": \"{}\", \"registers\": {}, \"encoder\": {}}}",
        separator, json_text(std::string(preset.name)), c.protocol,
        c.data_bits == "-" ? "null" : c.data_bits, c.flag_bits,
        c.crc == "-" ? "null" : json_text(c.crc), c.timeout, c.control,
        json_text(std::string(preset.description)));
    separator = ",\n";
  }
  fmt::print("\n]\n");
}

}  // namespace

int presets_command(const PresetsOptions& options) {
  if (!options.name.empty()) {
    const sim::Preset* preset = sim::preset_by_name(options.name);
    if (preset == nullptr) {
      std::vector<std::string> names;
      for (const sim::Preset& each : sim::presets()) names.emplace_back(each.name);
      const std::string meant = sim::suggestion(options.name, names);
      throw UseError(fmt::format("there is no preset '{}'{}", sim::one_line(options.name),
                                 meant.empty() ? "; 'mb4sim presets' lists them" : meant));
    }
    fmt::print("{}", preset_scenario(*preset));
  } else if (options.json) {
    print_json();
  } else {
    print_table();
  }
  return kGood;
}

}  // namespace mb4::tool
