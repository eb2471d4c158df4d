// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include <algorithm>

#include "mb4/position.hpp"
#include "mb4/scan.hpp"
#include "sim/lines/biss/actuator.hpp"

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

// The word as the chip stores it for an SSI encoder with Gray code. The chip converts the flags
// like a part of the Gray code. The driver restores two of them, nE and nW.
std::uint64_t as_stored(const sim::SlaveConfig& slave, std::uint64_t word) {
  const unsigned flags = slave.flag_bits();
  if (!slave.traits().gray || flags == 0 || flags == 2 || flags >= 64) return word;
  const std::uint64_t position = binary_to_gray(word >> flags) << flags;
  return gray_to_binary(position | (word & ((std::uint64_t{1} << flags) - 1)));
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
  Result<void> read = write_actuators();
  if (read) read = device_.read_all(frame);
  out.end = simulator_.now();
  if (read) wait_for_actuators();
  for (const ConnectedSlave& slave : slaves_) {
    // An error of the whole frame is an error of each slave.
    out.results.push_back(read ? frame[slave.number] : Result<Reading>(read.info()));
    const sim::Slave* device = simulator_.slave(slave.number);
    out.sent.push_back(device != nullptr ? device->sent_word() : std::nullopt);
    if (out.sent.back()) out.sent.back() = as_stored(*slave.config, *out.sent.back());
    const sim::Actuator* const target = actuator(slave);
    if (target == nullptr) continue;
    // An actuator: compares the word that it has taken with the word that the host has written.
    out.sent.back() = set_points_[slave.number];
    if (!read) continue;
    Reading taken;
    taken.slave = static_cast<std::uint8_t>(slave.number);
    taken.raw = taken.position = target->word();
    out.results.back() = taken;
  }
  return out;
}

const sim::Actuator* Session::actuator(const ConnectedSlave& slave) const {
  const sim::Slave* device = simulator_.slave(slave.number);
  return device != nullptr ? device->actuator() : nullptr;
}

// Each actuator counts up from its first word.
Result<void> Session::write_actuators() {
  for (const ConnectedSlave& slave : slaves_) {
    const sim::Actuator* const target = actuator(slave);
    if (target == nullptr) continue;
    const unsigned bits = slave.config->data_bits();
    const std::uint64_t mask = bits < 64 ? (std::uint64_t{1} << bits) - 1 : ~std::uint64_t{0};
    std::uint64_t& word = set_points_[slave.number];
    word = (target->word() + 1) & mask;
    const Result<void> written =
        device_.write_actuator(static_cast<std::uint8_t>(slave.number), word);
    if (!written) return written;
  }
  return {};
}

// They take their words when MA has rested for their timeout.
void Session::wait_for_actuators() {
  for (const ConnectedSlave& slave : slaves_) {
    if (actuator(slave) == nullptr) continue;
    simulator_.run_while_waiting([&] { return simulator_.line(slave.channel)->chain().idle(); },
                                 simulator_.now() + sim::kPsPerSecond);
  }
}

void Session::report(const SessionFrame& frame, FaultReport& faults) {
  faults.frame(frame.number, frame.begin, frame.outcomes(slaves_));
  if (const unsigned slave = faults.unchecked_id(); slave != 0) {
    faults.id_checked(slave, check_id(slave));
  }
}

// Reads the first ID register of a BiSS C slave and compares it with the slave's own value. Returns
// the error, or empty.
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
