// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <memory>
#include <string>

#include "commands/commands.hpp"
#include "report/exit_status.hpp"
#include "report/fault_report.hpp"
#include "report/messages.hpp"
#include "session.hpp"
#include "sim/core/one_line.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

std::string bits_of(const RegisterMap::Field& field) {
  const unsigned lsb = field.lsb;
  return field.width == 1 ? fmt::format("{}", lsb)
                          : fmt::format("{}:{}", lsb + field.width - 1, lsb);
}

std::string name_of(const RegisterMap::Field& field) {
  return field.alternate.empty() ? field.name : fmt::format("{}/{}", field.name, field.alternate);
}

void print_text(const RegisterMap& map) {
  const bool bytes = map.bits == 8;
  const unsigned digits = map.bits / 4;
  const unsigned name_width = bytes ? 18 : 22;
  const unsigned value_width = bytes ? 5 : 2 + digits;
  fmt::print("{}", map.data_text);
  fmt::print("{:<4}  {:<{}}  {:<{}}  {:<{}}  {:<{}}  {}\n", "addr", bytes ? "byte" : "word",
             2 + digits, "field", name_width, "bits", bytes ? 4 : 5, "value", value_width,
             "meaning");
  for (const RegisterMap::Field& field : map.fields) {
    if (field.data) continue;
    fmt::print("0x{:02X}  0x{:0{}X}  {:<{}}  {:<{}}  {:<{}}  {}\n", field.address, field.word,
               digits, name_of(field), name_width, bits_of(field), bytes ? 4 : 5,
               fmt::format("0x{:0{}X}", field.value(), digits), value_width, field.description);
  }
}

void print_json(const RegisterMap& map) {
  fmt::print("{{\"registers\": [");
  const char* separator = "";
  for (const std::uint32_t word : map.words) {
    fmt::print("{}{}", separator, word);
    separator = ", ";
  }
  fmt::print("], \"fields\": [\n");
  separator = "";
  for (const RegisterMap::Field& field : map.fields) {
    fmt::print(
        "{}  {{\"name\": \"{}\", \"address\": {}, \"lsb\": {}, \"width\": {}, \"value\": {}}}",
        separator, field.name, field.address, field.lsb, field.width, field.value());
    separator = ",\n";
  }
  fmt::print("\n]}}\n");
}

// The first error of a frame, or empty.
std::string error_of(const SessionFrame& frame) {
  for (const SlaveResult& result : frame.results) {
    if (!result.word) return result.error;
  }
  return frame.error;
}

}  // namespace

int regs_command(const RegsOptions& options) {
  const sim::Scenario scenario = sim::load_scenario(options.scenario);
  const MasterSupport& support = support_of(scenario);
  if (!support.registers) {
    throw UseError(fmt::format("{}: the master \"{}\" has no registers",
                               sim::one_line(options.scenario), scenario.master->type));
  }
  SessionOptions sensors;
  sensors.actuators = false;
  const std::unique_ptr<Session> session = support.open(scenario, sensors);
  bool good = true;
  if (!options.reset) {
    if (const std::string why = session->configure(); !why.empty()) {
      print_error(options.json, fmt::format("{}: {}", support.not_begun, why), kBad);
      good = false;
    }
    for (std::uint64_t frame = 1; good && frame <= options.frames; ++frame) {
      const std::string error = error_of(session->read(frame));
      if (!error.empty()) {
        print_error(options.json, fmt::format("frame {}: {}", frame, error), kBad);
        good = false;
      }
    }
  }
  const RegisterMap map = session->registers();
  print_faults(options.json, session->simulator().faults());
  if (options.json) {
    print_json(map);
  } else {
    print_text(map);
  }
  return good ? kGood : kBad;
}

}  // namespace mb4::tool
