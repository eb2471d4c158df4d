// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "mb4sim/simulator.hpp"
#include "report/exit_status.hpp"
#include "report/fault_report.hpp"
#include "report/messages.hpp"
#include "scenario_argument.hpp"
#include "session.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

std::string hex(std::span<const std::uint8_t> bytes) {
  return fmt::format("{:02X}", fmt::join(bytes, " "));
}

// ASCII by custom; a dot for what cannot be printed.
std::string ascii(std::span<const std::uint8_t> bytes) {
  std::string out;
  for (const std::uint8_t byte : bytes) {
    out += byte >= 0x20 && byte < 0x7F ? static_cast<char>(byte) : '.';
  }
  return out;
}

constexpr const char* kScanRow = "{:>7}  {:>2}  {:<17}  {:<6}  {:<12}  {}\n";

// Offsets of the common page as BiSS EDS defines them; times are shown as they are stored.
void print_eds(const ScannedSlave& found) {
  if (!found.eds) {
    fmt::print("         EDS cannot be read\n");
    return;
  }
  const std::vector<std::uint8_t>& page = *found.eds;
  fmt::print("         EDS version {}, {} bank(s), {} data channel(s), {} ID(s)\n", page[0x00],
             page[0x01], page[0x10], page[0x11]);
  for (unsigned i = 0; i < std::min<unsigned>(page[0x10], 8); ++i) {
    const std::size_t at = 0x14 + 4 * i;
    fmt::print("         data channel {}: page in bank {}, {} bits, {}{}, CRC 0x{:02X}\n", i + 1,
               page[at], page[at + 1], (page[at + 2] & 1U) != 0 ? "actuator" : "sensor",
               (page[at + 2] & 2U) != 0 ? ", left aligned" : "", page[at + 3]);
  }
}

void print_text(const std::vector<ScannedSlave>& list, const ScanOptions& options) {
  fmt::print(kScanRow, "channel", "ID", "device ID", "", "manufacturer", "EDS");
  for (const ScannedSlave& found : list) {
    if (!found.has_identity) {
      fmt::print(kScanRow, found.channel, found.id, "no ID registers", "", "", "");
      continue;
    }
    const std::string eds =
        found.eds_bank ? fmt::format("bank {}", *found.eds_bank) : std::string("none");
    fmt::print(kScanRow, found.channel, found.id, hex(found.device_id), ascii(found.device_id),
               fmt::format("{}  {}", hex(found.manufacturer), ascii(found.manufacturer)), eds);
    if (options.eds && found.eds_bank) print_eds(found);
  }
}

void print_json(const std::vector<ScannedSlave>& list, const std::string& notes) {
  fmt::print("{{\"slaves\": [");
  const char* separator = "\n";
  for (const ScannedSlave& found : list) {
    const auto quoted = [&](std::span<const std::uint8_t> bytes) {
      return found.has_identity ? json_text(hex(bytes)) : std::string("null");
    };
    fmt::print(
        "{}  {{\"channel\": {}, \"id\": {}, \"device_id\": {}, \"manufacturer\": {}, "
        "\"eds_bank\": {}, \"eds\": {}}}",
        separator, found.channel, found.id, quoted(found.device_id), quoted(found.manufacturer),
        found.eds_bank ? fmt::format("{}", *found.eds_bank) : "null",
        found.eds ? json_text(hex(*found.eds)) : "null");
    separator = ",\n";
  }
  fmt::print("\n], \"notes\": {}}}\n", json_text(notes));
}

// ---- Resources of an encoder --------------------------------------------------------------------

constexpr const char* kTreeRow = "{:<14}  {:<8}  {:<9}  {:>4}  {:>4}  {:>5}  {:>7}  {}";

void print_tree(const std::vector<EncoderResource>& list) {
  fmt::print(kTreeRow, "resource", "name", "type", "size", "read", "write", "time/ms", "value\n");
  for (const EncoderResource& each : list) {
    std::string row = fmt::format(
        kTreeRow, fmt::format("{:{}}{:03X}h", "", 2 * each.depth, each.id), each.name,
        each.type_name, each.size, each.read_level, each.write_level, each.timeout_ms, each.value);
    row.resize(row.find_last_not_of(' ') + 1);  // a value may be empty
    fmt::print("{}\n", row);
  }
}

void print_tree_json(const std::vector<EncoderResource>& list) {
  fmt::print("{{\"resources\": [");
  const char* separator = "\n";
  for (const EncoderResource& each : list) {
    fmt::print(
        "{}  {{\"id\": {}, \"depth\": {}, \"name\": {}, \"type\": {}, \"size\": {}, "
        "\"read_level\": {}, \"write_level\": {}, \"timeout_ms\": {}, \"value\": {}}}",
        separator, each.id, each.depth, json_text(each.name), json_text(each.type_name), each.size,
        each.read_level, each.write_level, each.timeout_ms, json_text(each.value));
    separator = ",\n";
  }
  fmt::print("\n]}}\n");
}

int walk_command(const sim::Scenario& scenario, const MasterSupport& support,
                 const ScanOptions& options) {
  if (options.eds) throw UseError("--eds: this encoder has no electronic data sheet");
  support.check(scenario);
  const EncoderTree found = support.walk(scenario);
  print_faults(options.json, found.faults);
  if (!found.error.empty()) print_error(options.json, found.error, kBad);
  if (found.error.empty() || !found.resources.empty()) {
    if (options.json) {
      print_tree_json(found.resources);
    } else {
      print_tree(found.resources);
    }
  }
  return found.error.empty() ? kGood : kBad;
}

}  // namespace

int scan_command(const ScanOptions& options) {
  const sim::Scenario scenario = open_scenario(options.scenario);
  const MasterSupport& support = support_of(scenario);
  if (support.walk != nullptr) return walk_command(scenario, support, options);
  if (support.scan == nullptr) {
    throw sim::ScenarioError(
        scenario.name, {}, "type",
        fmt::format("this needs the iC-MB4, not \"{}\"", scenario.master->type));
  }
  if (scenario.channels.empty()) {
    throw sim::ScenarioError(scenario.name, scenario.source.table, "channel",
                             "missing: there is no bus to scan");
  }
  std::vector<ScannedSlave> list;
  std::string notes;
  bool good = true;
  for (unsigned number = 1; number <= scenario.master->channels; ++number) {
    const sim::ChannelConfig* channel = scenario.channel(number);
    if (channel == nullptr) continue;
    if (!channel->protocol().control) {
      notes += fmt::format("channel {}: not scanned, only BiSS C slaves can be asked\n", number);
      continue;
    }
    const ScanRequest request{number, options.eds, [&](const sim::Simulator& simulator) {
                                print_faults(options.json, simulator.faults());
                              }};
    const ScanResult found = support.scan(scenario, request);
    if (!found.error.empty()) {
      print_error(options.json, fmt::format("channel {}: {}", number, found.error), kBad);
      good = false;
      continue;
    }
    if (found.slaves.empty()) {
      notes += fmt::format(
          "channel {}: nobody answers: no slave, or slaves without control communication\n",
          number);
    }
    list.insert(list.end(), found.slaves.begin(), found.slaves.end());
  }
  if (options.json) {
    print_json(list, notes);
  } else {
    print_text(list, options);
    fmt::print("{}", notes);
  }
  return good ? kGood : kBad;
}

}  // namespace mb4::tool
