// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include <algorithm>

#include "mb4/scan.hpp"

namespace mb4::tool {
namespace {

// A host that loses SPI frames needs all the checks that the driver has.
Config session_config(const sim::Scenario& scenario) {
  Config config = make_config(scenario);
  const bool host_faults =
      std::any_of(scenario.faults.begin(), scenario.faults.end(),
                  [](const sim::FaultConfig& f) { return f.kind == sim::FaultKind::kAbort; });
  if (host_faults) config.spi_check = SpiCheck::kFull;
  return config;
}

}  // namespace

SlaveOutcome::Kind SessionFrame::kind(std::size_t index) const {
  const Result<Reading>& result = results[index];
  if (!result) return SlaveOutcome::Kind::kFlagged;
  return sent[index] && *sent[index] != result->raw ? SlaveOutcome::Kind::kWrong
                                                    : SlaveOutcome::Kind::kRight;
}

bool SessionFrame::bad() const {
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (kind(i) != SlaveOutcome::Kind::kRight) return true;
  }
  return false;
}

std::vector<SlaveOutcome> SessionFrame::outcomes(const std::vector<ConnectedSlave>& slaves) const {
  std::vector<SlaveOutcome> list;
  for (std::size_t i = 0; i < results.size(); ++i) {
    SlaveOutcome outcome;
    outcome.slave = slaves[i].number;
    outcome.channel = slaves[i].channel;
    outcome.kind = kind(i);
    if (!results[i]) outcome.state = describe(results[i].info());
    if (outcome.kind == SlaveOutcome::Kind::kWrong) outcome.state = "wrong data";
    list.push_back(std::move(outcome));
  }
  return list;
}

Session::Session(const sim::Scenario& scenario, const sim::SimulatorOptions& options, bool bus_log)
    : config_(session_config(scenario)),
      simulator_(scenario, options),
      slaves_(connected_slaves(simulator_.scenario())),
      bus_(simulator_, bus_log ? &bus_log_ : nullptr),
      clock_(simulator_),
      device_(bus_, clock_) {}

SessionFrame Session::read(std::uint64_t number) {
  SessionFrame out;
  out.number = number;
  out.begin = simulator_.now();
  Frame frame;
  const Result<void> read = device_.read_all(frame);
  out.end = simulator_.now();
  for (const ConnectedSlave& slave : slaves_) {
    // What is wrong with the whole frame is wrong with each slave.
    out.results.push_back(read ? frame[slave.number] : Result<Reading>(read.info()));
    const sim::Slave* device = simulator_.slave(slave.number);
    out.sent.push_back(device != nullptr ? device->sent_word() : std::nullopt);
  }
  return out;
}

std::string Session::check_id(unsigned slave) {
  const SlaveAddress address = slave_address(config_, static_cast<std::uint8_t>(slave));
  std::uint8_t value = 0;
  const Result<void> read =
      device_.control().read_registers(address, kRegisterDeviceId, Span<std::uint8_t>(&value, 1));
  if (!read) return describe(read.info());
  return value == simulator_.slave(slave)->reg_read(kRegisterDeviceId) ? "" : "wrong device ID";
}

RunSummary Session::summary() const {
  return {simulator_.now(), simulator_.clk_cycles(), simulator_.seed()};
}

}  // namespace mb4::tool
