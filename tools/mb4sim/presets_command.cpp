// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <string>
#include <variant>
#include <vector>

#include "commands.hpp"
#include "exit_status.hpp"
#include "mb4sim/one_line.hpp"
#include "mb4sim/presets.hpp"
#include "mb4sim/sensor_config.hpp"
#include "messages.hpp"
#include "suggestion.hpp"

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

std::string timeout_text(const sim::SlaveTimeout& timeout) {
  return timeout.fixed == 0 ? "adaptive" : fmt::format("{:g} us", sim::to_us(timeout.fixed));
}

Cells cells(const sim::Preset& preset) {
  Cells out;
  const auto& sensor = std::visit(
      [](const auto& device) -> const sim::SensorConfig& { return device; }, preset.device);
  out.data_bits = sensor.data_bits == 0 ? "-" : fmt::format("{}", sensor.data_bits);
  out.flag_bits = sensor.flag_bits;
  out.crc = sensor.crc.polynomial == 0 ? "-" : fmt::format("0x{:X}", sensor.crc.polynomial);
  if (const auto* biss_c = std::get_if<sim::BissCSlaveConfig>(&preset.device)) {
    out.protocol = "biss-c";
    out.timeout = timeout_text(biss_c->timeout);
    out.control = biss_c->control.present;
  } else if (const auto* biss_b = std::get_if<sim::BissBSlaveConfig>(&preset.device)) {
    out.protocol = "biss-b";
    out.timeout = timeout_text(biss_b->timeout);
    out.control = true;
  } else {
    const auto& ssi = std::get<sim::SsiSlaveConfig>(preset.device);
    out.protocol = "ssi";
    out.timeout = fmt::format("{:g} us", sim::to_us(ssi.monoflop));
    out.control = ssi.control.present;
  }
  return out;
}

constexpr const char* kRow = "{:<20}  {:<8}  {:>4}  {:>5}  {:>5}  {:<9}  {:<9}  {}\n";

void print_table() {
  fmt::print(kRow, "preset", "protocol", "bits", "flags", "CRC", "timeout", "registers", "encoder");
  for (const sim::Preset& preset : sim::presets()) {
    const Cells c = cells(preset);
    fmt::print(kRow, preset.name, c.protocol, c.data_bits, c.flag_bits, c.crc, c.timeout,
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

// A scenario to start from.
void print_scenario(const sim::Preset& preset) {
  const Cells c = cells(preset);
  fmt::print("# {}\n\n", preset.description);
  // The slaves of SSI and BiSS B have to be asked no faster than they can follow.
  if (c.protocol != "biss-c") fmt::print("[host]\nma_hz = 1_000_000\n\n");
  fmt::print("[[channel]]\nnumber = 1\ncable_m = 10\n\n");
  fmt::print("[[channel.slave]]\nprotocol = \"{}\"\npreset = \"{}\"\n", c.protocol, preset.name);
  if (c.data_bits == "-") {
    fmt::print("data_bits = 26  # position and flags; depends on the type of encoder\n");
  }
  fmt::print("source = \"ramp\"\nstep = 100\n");
}

}  // namespace

int presets_command(const PresetsOptions& options) {
  if (!options.name.empty()) {
    const sim::Preset* preset = sim::preset_by_name(options.name);
    if (preset == nullptr) {
      std::vector<std::string> names;
      for (const sim::Preset& each : sim::presets()) names.emplace_back(each.name);
      const std::string meant = suggestion(options.name, names);
      throw UseError(fmt::format("there is no preset '{}'{}", sim::one_line(options.name),
                                 meant.empty() ? "; 'mb4sim presets' lists them" : meant));
    }
    print_scenario(*preset);
  } else if (options.json) {
    print_json();
  } else {
    print_table();
  }
  return kGood;
}

}  // namespace mb4::tool
