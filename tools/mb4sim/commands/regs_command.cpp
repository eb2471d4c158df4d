// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "register_text.hpp"
#include "report/exit_status.hpp"
#include "report/fault_report.hpp"
#include "report/messages.hpp"
#include "scenario_argument.hpp"
#include "session.hpp"
#include "sim/core/one_line.hpp"
#include "sim/core/suggestion.hpp"
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

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool named(const std::string& name, const std::vector<std::string>& parts) {
  return std::any_of(parts.begin(), parts.end(), [&](const std::string& part) {
    return lower(name).find(lower(part)) != std::string::npos;
  });
}

// Leaves what was asked for. Throws UseError for a word that is in no name.
void select(const RegsOptions& options, RegisterMap& map) {
  for (const std::string& part : options.names) {
    const auto has = [&](const auto& row) { return named(row.name, {part}); };
    if (std::any_of(
            map.fields.begin(), map.fields.end(),
            [&](const RegisterMap::Field& field) { return named(name_of(field), {part}); }) ||
        std::any_of(map.data_rows.begin(), map.data_rows.end(), has)) {
      continue;
    }
    std::vector<std::string> names;
    for (const RegisterMap::Field& field : map.fields) names.push_back(field.name);
    throw UseError(fmt::format("no field has '{}' in its name{}", sim::one_line(part),
                               sim::suggestion(part, names)));
  }
  const bool all = options.all || options.reset;
  std::erase_if(map.data_rows, [&](const RegisterMap::DataRow& row) {
    return options.names.empty() ? row.at_reset && !all : !named(row.name, options.names);
  });
  if (options.names.empty()) {
    std::erase_if(map.fields, [&](const RegisterMap::Field& field) {
      return field.data || (!all && field.value() == field.reset);
    });
  } else {
    std::erase_if(map.fields, [&](const RegisterMap::Field& field) {
      return field.data || !named(name_of(field), options.names);
    });
  }
}

// `whole` has the fields from which frequencies follow.
void print_text(const RegisterMap& map, const RegisterMap& whole) {
  if (!map.data_rows.empty()) {
    fmt::print("{:<4}  {:<18}  {}\n", "addr", "data", "bytes, lowest address first");
    for (const RegisterMap::DataRow& row : map.data_rows) {
      fmt::print("0x{:02X}  {:<18}  {}\n", row.address, row.name, row.bytes);
    }
    fmt::print("\n");
  }
  if (map.fields.empty()) return;
  const bool bytes = map.bits == 8;
  const unsigned digits = map.bits / 4;
  constexpr int kValueWidth = 34;
  fmt::print("{:<4}  {:<{}}  {:<5}  {:<{}}  {}\n", "addr", bytes ? "byte" : "word", 2 + digits,
             "bits", "field = value", kValueWidth, "meaning");
  for (const RegisterMap::Field& field : map.fields) {
    fmt::print("0x{:02X}  0x{:0{}X}  {:<5}  {:<{}}  {}\n", field.address, field.word, digits,
               bits_of(field), fmt::format("{} = {}", name_of(field), value_text(whole, field)),
               kValueWidth, field.description);
  }
}

void print_json(const RegisterMap& map, const RegisterMap& whole) {
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
        "{}  {{\"name\": \"{}\", \"address\": {}, \"lsb\": {}, \"width\": {}, \"value\": {}, "
        "\"reset\": {}, \"text\": {}}}",
        separator, field.name, field.address, field.lsb, field.width, field.value(), field.reset,
        json_text(value_text(whole, field)));
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
  const sim::Scenario scenario = open_scenario(options.scenario);
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
  const RegisterMap whole = session->registers();
  RegisterMap map = whole;
  if (!options.json || !options.names.empty()) select(options, map);
  print_faults(options.json, session->simulator().faults());
  if (options.json) {
    print_json(map, whole);
  } else {
    print_text(map, whole);
  }
  return good ? kGood : kBad;
}

}  // namespace mb4::tool
