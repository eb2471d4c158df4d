// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "chip_setup.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace mb4::tool {
namespace {

constexpr std::uint32_t kMaxFrameTimeoutPeriods = 100;  // of margin, beyond what is known

// Longest time from request to end: the driver's own figure does not know what the scenario says
// about processing times, cable and timeouts.
std::uint32_t frame_timeout(const sim::Scenario& scenario, const sim::ChannelConfig& channel) {
  const double period_us = 1e6 / static_cast<double>(scenario.host.ma_hz);
  double periods = kMaxFrameTimeoutPeriods;
  double slave_us = 0;
  for (const sim::SlaveConfig& slave : channel.slaves) {
    periods += slave.data_bits() + slave.crc().width();
    if (const auto* biss_c = std::get_if<sim::BissCSlaveConfig>(&slave.device)) {
      periods += biss_c->busy_periods;
      slave_us = std::max(slave_us, sim::to_us(biss_c->timeout.fixed));
    } else if (const auto* replay = std::get_if<sim::ReplaySlaveConfig>(&slave.device)) {
      slave_us = std::max(slave_us, sim::to_us(replay->recording.edges.back().time));
    }
  }
  const double us =
      periods * period_us + 2 * slave_us + 2 * sim::to_us(channel.delay) + kFrameMarginUs;
  return static_cast<std::uint32_t>(std::min<double>(us, kMaxFrameTimeoutUs));
}

[[noreturn]] void fail(const sim::Scenario& scenario, const sim::TableSource& source,
                       std::string_view key, const std::string& message) {
  throw sim::ScenarioError(scenario.name, source.of(key), key, message);
}

// What the driver refuses, with the key of the scenario that causes it.
[[noreturn]] void refuse(const sim::Scenario& scenario, const ErrorInfo& error) {
  const std::vector<sim::SlaveConfig>& slaves = scenario.channel(1)->slaves;
  const bool of_slave = error.number >= 1 && error.number <= slaves.size();
  const sim::SlaveConfig& slave = slaves[of_slave ? error.number - 1U : 0U];
  switch (error.field) {
    case ConfigField::kClkHz:
      fail(scenario, scenario.chip.source, scenario.chip.f_clk_hz != 0 ? "f_clk_hz" : "f_osc_hz",
           fmt::format("{} is outside what the driver takes, 1 to 25 MHz (internal: 10 to 25 MHz)",
                       scenario.chip.system_hz()));
    case ConfigField::kMaHz:
      fail(scenario, scenario.host.source, "ma_hz",
           fmt::format("the chip cannot make {} Hz", scenario.host.ma_hz));
    case ConfigField::kSlaveEnabled:
      fail(scenario, slave.source, "slave", "the driver reads one slave in this version");
    case ConfigField::kDataBits:
      fail(scenario, slave.source, "data_bits",
           fmt::format("the chip cannot take {}", slave.data_bits()));
    case ConfigField::kFlags:
      fail(scenario, slave.source, "flag_bits",
           fmt::format("the driver cannot take {}", slave.flag_bits()));
    case ConfigField::kCrcPolynomial:
      fail(scenario, slave.source, "crc",
           fmt::format("the chip cannot calculate 0x{:X}, only degree 1 to 7, 0x12F and 0x190D9",
                       slave.crc().polynomial));
    case ConfigField::kCrcStart:
      fail(scenario, slave.source, "crc_start", "must be 0 without CRC (crc = 0)");
    default:
      break;
  }
  fail(scenario, scenario.source, "channel", describe(error));
}

}  // namespace

Config make_config(const sim::Scenario& scenario) {
  if (const sim::ChannelConfig* second = scenario.channel(2)) {
    fail(scenario, second->source, "number",
         "the driver does not support channel 2 in this version");
  }
  const sim::ChannelConfig* channel = scenario.channel(1);
  if (channel == nullptr)
    fail(scenario, scenario.source, "channel", "missing: there is no slave to read");
  if (channel->slaves.empty())
    fail(scenario, channel->source, "slave", "missing: there is no slave to read");
  Config config;
  config.f_clk_hz = static_cast<std::uint32_t>(scenario.chip.system_hz());
  config.clock_source =
      scenario.chip.f_clk_hz != 0 ? ClockSource::kExternal : ClockSource::kInternal;
  config.ma_hz = static_cast<std::uint32_t>(scenario.host.ma_hz);
  config.store_crc = true;
  config.frame_timeout_us = frame_timeout(scenario, *channel);
  config.channels[0].protocol = Protocol::kBissC;
  for (std::size_t i = 0; i < channel->slaves.size(); ++i) {
    const sim::SlaveConfig& slave = channel->slaves[i];
    SlaveConfig& target = config.slaves[i];
    target.enabled = true;
    target.data_bits = static_cast<std::uint8_t>(slave.data_bits());
    target.flags =
        slave.flag_bits() == 2 && slave.data_bits() > 2 ? Flags::kErrorWarning : Flags::kNone;
    target.crc_polynomial = slave.crc().polynomial;
    target.crc_start = static_cast<std::uint16_t>(slave.crc().start);
  }
  if (const Result<void> valid = validate(config); !valid) refuse(scenario, valid.info());
  return config;
}

std::string describe(const ErrorInfo& error) {
  std::string text = to_string(error.code);
  if (error.field != ConfigField::kNone) text += fmt::format(": {}", to_string(error.field));
  if (error.number != 0) text += fmt::format(" of {}", error.number);
  if (error.address != 0) text += fmt::format(" at register 0x{:02X}", error.address);
  return text;
}

}  // namespace mb4::tool
