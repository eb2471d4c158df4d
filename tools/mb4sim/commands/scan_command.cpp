// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "masters/mb4/chip_setup.hpp"
#include "masters/mb4/sim_bus.hpp"
#include "mb4/device.hpp"
#include "mb4/scan.hpp"
#include "mb4sim/simulator.hpp"
#include "report/exit_status.hpp"
#include "report/fault_report.hpp"
#include "report/messages.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

constexpr std::size_t kPage = 64;  // registers of a bank
constexpr std::uint8_t kRegisterBank = 0x40;
using Page = std::array<std::uint8_t, kPage>;
using SimDevice = Device<SimBus, SimClock>;

struct Found {
  unsigned channel;
  unsigned id;
  SlaveIdentity identity;
  std::optional<Page> eds;  // its common page
};

// Nothing is known of the slaves: no data channel, MA keeps the CDM, frames far enough apart for
// every timeout. (Page 27 of the datasheet.)
Config scan_config(const sim::Scenario& scenario, unsigned channel) {
  constexpr std::uint32_t kPitchNs = 60'000;
  Config config = clock_config(scenario);
  for (ChannelConfig& each : config.channels) each.protocol = Protocol::kUnused;
  config.channels[channel - 1].protocol = Protocol::kBissC;
  for (SlaveConfig& slave : config.slaves) slave.enabled = false;
  config.hold_cdm = true;
  config.frame_start = FrameStart::kPeriodic;
  config.frame_period_clk = frame_period_clk_at_least(config.f_clk_hz, kPitchNs);
  return config;
}

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

std::optional<Page> read_eds(SimDevice& device, const Found& found) {
  const SlaveAddress slave{static_cast<std::uint8_t>(found.channel),
                           static_cast<std::uint8_t>(found.id)};
  const std::uint8_t bank = found.identity.eds_bank;
  if (!device.control().write_registers(slave, kRegisterBank, {&bank, 1})) return std::nullopt;
  Page page{};
  if (!device.control().read_registers(slave, 0, page)) return std::nullopt;
  return page;
}

Result<std::vector<Found>> scan(const sim::Scenario& scenario, unsigned channel,
                                const ScanOptions& options) {
  sim::Simulator simulator(scenario);
  SimBus bus(simulator);
  SimClock clock(simulator);
  SimDevice device(bus, clock);
  if (const Result<void> done = device.configure(scan_config(scenario, channel)); !done) {
    return done.info();
  }
  if (const Result<void> done = device.automatic().start(); !done) return done.info();
  std::array<SlaveIdentity, kSlaveIds> identities{};
  const Result<std::uint8_t> count =
      scan_bus(device, static_cast<std::uint8_t>(channel), identities);
  print_faults(options.json, simulator.faults());
  if (!count) return count.info();
  std::vector<Found> list;
  for (unsigned id = 0; id < *count; ++id) {
    Found found{channel, id, identities[id], std::nullopt};
    if (options.eds && found.identity.has_eds) found.eds = read_eds(device, found);
    list.push_back(found);
  }
  return list;
}

constexpr const char* kScanRow = "{:>7}  {:>2}  {:<17}  {:<6}  {:<12}  {}\n";

// Offsets of the common page as BiSS EDS defines them; times are shown as they are stored.
void print_eds(const Found& found) {
  if (!found.eds) {
    fmt::print("         EDS cannot be read\n");
    return;
  }
  const Page& page = *found.eds;
  fmt::print("         EDS version {}, {} bank(s), {} data channel(s), {} ID(s)\n", page[0x00],
             page[0x01], page[0x10], page[0x11]);
  for (unsigned i = 0; i < std::min<unsigned>(page[0x10], 8); ++i) {
    const std::size_t at = 0x14 + 4 * i;
    fmt::print("         data channel {}: page in bank {}, {} bits, {}{}, CRC 0x{:02X}\n", i + 1,
               page[at], page[at + 1], (page[at + 2] & 1U) != 0 ? "actuator" : "sensor",
               (page[at + 2] & 2U) != 0 ? ", left aligned" : "", page[at + 3]);
  }
}

void print_text(const std::vector<Found>& list, const ScanOptions& options) {
  fmt::print(kScanRow, "channel", "ID", "device ID", "", "manufacturer", "EDS");
  for (const Found& found : list) {
    const SlaveIdentity& identity = found.identity;
    if (!identity.has_identity) {
      fmt::print(kScanRow, found.channel, found.id, "no ID registers", "", "", "");
      continue;
    }
    const std::string eds = identity.has_eds ? fmt::format("bank {}", identity.eds_bank) : "none";
    fmt::print(
        kScanRow, found.channel, found.id, hex(identity.device_id), ascii(identity.device_id),
        fmt::format("{}  {}", hex(identity.manufacturer), ascii(identity.manufacturer)), eds);
    if (options.eds && identity.has_eds) print_eds(found);
  }
}

void print_json(const std::vector<Found>& list, const std::string& notes) {
  fmt::print("{{\"slaves\": [");
  const char* separator = "\n";
  for (const Found& found : list) {
    const SlaveIdentity& identity = found.identity;
    const auto quoted = [&](std::span<const std::uint8_t> bytes) {
      return identity.has_identity ? json_text(hex(bytes)) : std::string("null");
    };
    fmt::print(
        "{}  {{\"channel\": {}, \"id\": {}, \"device_id\": {}, \"manufacturer\": {}, "
        "\"eds_bank\": {}, \"eds\": {}}}",
        separator, found.channel, found.id, quoted(identity.device_id),
        quoted(identity.manufacturer),
        identity.has_eds ? fmt::format("{}", identity.eds_bank) : "null",
        found.eds ? json_text(hex(*found.eds)) : "null");
    separator = ",\n";
  }
  fmt::print("\n], \"notes\": {}}}\n", json_text(notes));
}

}  // namespace

int scan_command(const ScanOptions& options) {
  const sim::Scenario scenario = load_chip_scenario(options.scenario);
  if (scenario.channels.empty()) {
    throw sim::ScenarioError(scenario.name, scenario.source.table, "channel",
                             "missing: there is no bus to scan");
  }
  std::vector<Found> list;
  std::string notes;
  bool good = true;
  for (unsigned number = 1; number <= kChannels; ++number) {
    const sim::ChannelConfig* channel = scenario.channel(number);
    if (channel == nullptr) continue;
    if (!channel->protocol().control) {
      notes += fmt::format("channel {}: not scanned, only BiSS C slaves can be asked\n", number);
      continue;
    }
    const Result<std::vector<Found>> found = scan(scenario, number, options);
    if (!found) {
      print_error(options.json, fmt::format("channel {}: {}", number, describe(found.info())),
                  kBad);
      good = false;
      continue;
    }
    if (found->empty()) {
      notes += fmt::format(
          "channel {}: nobody answers: no slave, or slaves without control communication\n",
          number);
    }
    list.insert(list.end(), found->begin(), found->end());
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
