// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "chip_setup.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "exit_status.hpp"

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

}  // namespace

Config make_config(const sim::Scenario& scenario) {
  const auto fail = [&](const std::string& message) -> void {
    throw UseError(fmt::format("{}: {}", scenario.name, message));
  };
  const sim::ChannelConfig* channel = scenario.channel(1);
  if (channel == nullptr || channel->slaves.empty()) {
    fail("key 'slave': channel 1 has no slave to read");
  }
  if (scenario.channel(2) != nullptr) {
    fail("key 'number': channel 2 is not supported in this version");
  }
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
  if (const Result<void> valid = validate(config); !valid) {
    fail(describe(valid.info()) + " (this is what chip and driver can do in this version)");
  }
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
