// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "masters/mb4/mb4_scan.hpp"

#include <array>

#include "masters/mb4/chip_setup.hpp"
#include "masters/mb4/sim_bus.hpp"
#include "mb4/device.hpp"
#include "mb4/scan.hpp"

namespace mb4::tool {
namespace {

constexpr std::size_t kPage = 64;  // registers of a bank
constexpr std::uint8_t kRegisterBank = 0x40;
using SimDevice = Device<SimBus, SimClock>;

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

std::optional<std::vector<std::uint8_t>> read_eds(SimDevice& device, SlaveAddress slave,
                                                  std::uint8_t bank) {
  if (!device.control().write_registers(slave, kRegisterBank, {&bank, 1})) return std::nullopt;
  std::array<std::uint8_t, kPage> page{};
  if (!device.control().read_registers(slave, 0, page)) return std::nullopt;
  return std::vector<std::uint8_t>(page.begin(), page.end());
}

ScannedSlave scanned(SimDevice& device, SlaveAddress slave, const SlaveIdentity& identity,
                     bool eds) {
  ScannedSlave found;
  found.channel = slave.channel;
  found.id = slave.id;
  found.has_identity = identity.has_identity;
  if (identity.has_identity) {
    found.device_id.assign(identity.device_id.begin(), identity.device_id.end());
    found.manufacturer.assign(identity.manufacturer.begin(), identity.manufacturer.end());
  }
  if (identity.has_eds) found.eds_bank = identity.eds_bank;
  if (eds && identity.has_eds) found.eds = read_eds(device, slave, identity.eds_bank);
  return found;
}

}  // namespace

ScanResult scan_mb4(const sim::Scenario& scenario, const ScanRequest& request) {
  sim::Simulator simulator(scenario);
  SimBus bus(simulator);
  SimClock clock(simulator);
  SimDevice device(bus, clock);
  const auto channel = static_cast<std::uint8_t>(request.channel);
  if (const Result<void> done = device.configure(scan_config(scenario, channel)); !done) {
    return {{}, describe(done.info())};
  }
  if (const Result<void> done = device.automatic().start(); !done) {
    return {{}, describe(done.info())};
  }
  std::array<SlaveIdentity, kSlaveIds> identities{};
  const Result<std::uint8_t> count = scan_bus(device, channel, identities);
  request.asked(simulator);
  if (!count) return {{}, describe(count.info())};
  ScanResult result;
  for (std::uint8_t id = 0; id < *count; ++id) {
    result.slaves.push_back(scanned(device, {channel, id}, identities[id], request.eds));
  }
  return result;
}

}  // namespace mb4::tool
