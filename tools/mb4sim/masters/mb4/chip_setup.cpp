// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "masters/mb4/chip_setup.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "scenario_argument.hpp"
#include "sim/lines/clocked/clocked_line.hpp"

namespace mb4::tool {
namespace {

constexpr std::uint32_t kMaxFrameTimeoutPeriods = 100;  // margin beyond the known time

// Longest time from request to end. The driver's own value does not include the scenario's
// processing times, cables and timeouts. The channels run at the same time.
std::uint32_t frame_timeout(const sim::Scenario& scenario) {
  const double period_us = 1e6 / static_cast<double>(scenario.host.ma_hz);
  double longest_us = 0;
  for (const sim::ChannelConfig& channel : scenario.channels) {
    double periods = kMaxFrameTimeoutPeriods;
    double slave_us = 0;
    for (const sim::SlaveConfig& slave : channel.slaves) {
      periods += slave.data_bits() + slave.crc().width();
      const sim::DeviceTraits traits = slave.traits();
      periods += traits.busy_periods;
      slave_us = std::max(slave_us, sim::to_us(traits.timeout));
    }
    longest_us = std::max(
        longest_us, periods * period_us + 2 * slave_us + 2 * sim::to_us(channel.cable->delay));
  }
  return static_cast<std::uint32_t>(
      std::min<double>(longest_us + kFrameMarginUs, kMaxFrameTimeoutUs));
}

// Throws for a protocol that the chip does not speak.
Protocol protocol_of(const sim::Scenario& scenario, const sim::ChannelConfig& channel) {
  const std::string_view key = channel.protocol().key;
  if (key == "biss-c") return Protocol::kBissC;
  if (key == "biss-b") return Protocol::kBissB;
  if (key == "ssi") return Protocol::kSsi;
  fail_at(scenario, channel.slaves.front().source, "protocol",
          fmt::format("the chip speaks BiSS C, BiSS B and SSI, not \"{}\"", key));
}

// Sets the members that depend on the slave's protocol.
void add_protocol(const sim::SlaveConfig& slave, SlaveConfig& target, Config& config) {
  constexpr unsigned kMostBusy = 255;
  const sim::DeviceTraits traits = slave.traits();
  target.actuator = traits.actuator;
  if (traits.actuator) target.stop_bit = traits.stop_bit;
  target.gray = traits.gray;
  const unsigned busy = std::min(traits.busy_periods, kMostBusy);
  // With MO in use the start bit comes from the chip.
  if (config.mo)
    config.mo_busy = static_cast<std::uint8_t>(std::max<unsigned>(config.mo_busy, busy));
}

// Throws for a configuration that the driver refuses; names the scenario's key that causes it.
[[noreturn]] void refuse(const sim::Scenario& scenario, const ErrorInfo& error) {
  const std::vector<ConnectedSlave> slaves = connected_slaves(scenario);
  const auto of_slave = std::find_if(slaves.begin(), slaves.end(), [&](const ConnectedSlave& one) {
    return one.number == error.number;
  });
  const sim::SlaveConfig& slave = *(of_slave != slaves.end() ? *of_slave : slaves.front()).config;
  switch (error.field) {
    case ConfigField::kClkHz:
      fail_at(
          scenario, scenario.chip.source, scenario.chip.f_clk_hz != 0 ? "f_clk_hz" : "f_osc_hz",
          fmt::format("{} is outside what the driver takes, 1 to 25 MHz (internal: 10 to 25 MHz)",
                      scenario.chip.system_hz()));
    case ConfigField::kMaHz:
      fail_at(scenario, scenario.host.source, "ma_hz",
              fmt::format("the chip cannot make {} Hz", scenario.host.ma_hz));
    case ConfigField::kDataBits:
      fail_at(scenario, slave.source, "data_bits",
              fmt::format("the chip cannot take {}", slave.data_bits()));
    case ConfigField::kFlags:
      fail_at(scenario, slave.source, "flag_bits",
              fmt::format("the driver cannot take {}", slave.flag_bits()));
    case ConfigField::kCrcPolynomial:
      fail_at(scenario, slave.source, "crc",
              fmt::format("the chip cannot calculate 0x{:X}, only degree 1 to 7, 0x12F and 0x190D9",
                          slave.crc().polynomial));
    case ConfigField::kCrcStart:
      fail_at(scenario, slave.source, "crc_start", "must be 0 without CRC (crc = 0)");
    default:
      break;
  }
  fail_at(scenario, scenario.source, "channel", describe(error));
}

}  // namespace

void require_ic_mb4(const sim::Scenario& scenario) {
  if (scenario.master->type == "ic-mb4") return;
  throw sim::ScenarioError(scenario.name, {}, "type",
                           fmt::format("this needs the iC-MB4, not \"{}\"", scenario.master->type));
}

sim::Scenario load_chip_scenario(const std::string& path) {
  sim::Scenario scenario = open_scenario(path);
  require_ic_mb4(scenario);
  return scenario;
}

Config clock_config(const sim::Scenario& scenario) {
  require_ic_mb4(scenario);
  Config config;
  config.f_clk_hz = static_cast<std::uint32_t>(scenario.chip.system_hz());
  config.clock_source =
      scenario.chip.f_clk_hz != 0 ? ClockSource::kExternal : ClockSource::kInternal;
  config.ma_hz = static_cast<std::uint32_t>(scenario.host.ma_hz);
  return config;
}

Config make_config(const sim::Scenario& scenario) {
  require_ic_mb4(scenario);
  require_slaves(scenario);
  Config config = clock_config(scenario);
  config.spi_check = SpiCheck::kCrc;
  config.frame_timeout_us = frame_timeout(scenario);
  for (const sim::ChannelConfig& channel : scenario.channels) {
    config.channels[channel.number - 1].protocol = protocol_of(scenario, channel);
    config.mo = config.mo || clocked(*channel.cable).mo;
  }
  for (const ConnectedSlave& connected : connected_slaves(scenario)) {
    const sim::SlaveConfig& slave = *connected.config;
    SlaveConfig& target = config.slaves[connected.number - 1];
    target.enabled = true;
    target.data_bits = static_cast<std::uint8_t>(slave.data_bits());
    target.flags =
        slave.flag_bits() == 2 && slave.data_bits() > 2 ? Flags::kErrorWarning : Flags::kNone;
    target.crc_polynomial = slave.crc().polynomial;
    target.crc_start = static_cast<std::uint16_t>(slave.crc().start);
    add_protocol(slave, target, config);
  }
  if (const Result<void> valid = validate(config); !valid) refuse(scenario, valid.info());
  return config;
}

std::string describe(const ErrorInfo& error) {
  std::string text = to_string(error.code);
  if (error.field != ConfigField::kNone) text += fmt::format(": {}", to_string(error.field));
  if (error.number != 0) text += fmt::format(" of {}", error.number);
  if (error.address() != 0) {
    text += fmt::format(" at register 0x{:02X}", error.address());
  }
  return text;
}

}  // namespace mb4::tool
