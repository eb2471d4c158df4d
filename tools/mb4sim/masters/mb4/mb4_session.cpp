// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "masters/mb4/mb4_session.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "masters/mb4/chip_setup.hpp"
#include "masters/mb4/mb4_scan.hpp"
#include "masters/mb4/sim_bus.hpp"
#include "masters/mb4/spi_lines.hpp"
#include "mb4/device.hpp"
#include "mb4/position.hpp"
#include "mb4/scan.hpp"
#include "mb4_regs_table.hpp"
#include "register_table.hpp"
#include "sim/lines/clocked/actuator.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"

namespace mb4::tool {
namespace {

constexpr std::size_t kRegisters = 256;
using Dump = std::array<std::uint8_t, kRegisters>;

// The word as the chip stores it for an SSI encoder with Gray code. The chip converts the flags
// like a part of the Gray code. The driver restores two of them, nE and nW.
std::uint64_t as_stored(const sim::SlaveConfig& slave, std::uint64_t word) {
  const unsigned flags = slave.flag_bits();
  if (!slave.traits().gray || flags == 0 || flags == 2 || flags >= 64) return word;
  const std::uint64_t position = binary_to_gray(word >> flags) << flags;
  return gray_to_binary(position | (word & ((std::uint64_t{1} << flags) - 1)));
}

std::string error_of(const Result<void>& result) { return result ? "" : describe(result.info()); }

SlaveResult result_of(const sim::SlaveConfig& slave, const Result<Reading>& reading) {
  if (!reading.has_reading()) return {std::nullopt, describe(reading.info())};
  Word word;
  word.bits = reading.reading().raw;
  word.data_bits = slave.data_bits();
  word.flag_bits = slave.flag_bits();
  if (word.flag_bits == 2) {
    word.n_error = (word.bits & 2U) != 0;
    word.n_warning = (word.bits & 1U) != 0;
  }
  if (reading.reading().crc_stored) word.crc = reading.reading().crc;
  return {word, ""};
}

class Mb4Session final : public Session {
 public:
  Mb4Session(const sim::Scenario& scenario, const SessionOptions& options)
      : Session(scenario, options),
        actuators_(options.actuators),
        bus_(simulator_, log()),
        clock_(simulator_),
        device_(bus_, clock_) {}

  std::string configure() override;
  SessionFrame read(std::uint64_t number) override;
  RegisterMap registers() override;
  std::string access(const ControlRequest& request) override;
  std::string send(const std::string& line) override;

 private:
  std::string check_id(unsigned slave) override;
  // nullptr: the slave is a sensor.
  const sim::Actuator* actuator(const ConnectedSlave& slave) const;
  Result<void> write_actuators();
  void wait_for_actuators();

  bool actuators_;
  Config config_;
  std::array<std::uint64_t, kSlaves + 1> set_points_{};  // of actuators, by slave
  SimBus bus_;
  SimClock clock_;
  Device<SimBus, SimClock> device_;
};

std::string Mb4Session::configure() {
  const sim::Scenario& scenario = simulator_.scenario();
  config_ = make_config(scenario);
  // A host that loses SPI frames needs all the checks that the driver has.
  const bool host_faults = std::any_of(
      scenario.faults.begin(), scenario.faults.end(),
      [](const sim::FaultConfig& f) { return f.kind->place == sim::FaultPlace::kHost; });
  if (actuators_ && host_faults) config_.spi_check = SpiCheck::kFull;
  return error_of(device_.configure(config_));
}

SessionFrame Mb4Session::read(std::uint64_t number) {
  SessionFrame out;
  out.number = number;
  out.begin = simulator_.now();
  Frame frame;
  Result<void> read = write_actuators();
  if (read) read = device_.read_all(frame);
  out.end = simulator_.now();
  out.error = error_of(read);
  if (read) wait_for_actuators();
  for (const ConnectedSlave& slave : slaves_) {
    // An error of the whole frame is an error of each slave.
    Result<Reading> reading = read ? frame[slave.number] : Result<Reading>(read.info());
    const sim::Slave* device = simulator_.slave(slave.number);
    out.sent.push_back(device != nullptr ? device->sent_word() : std::nullopt);
    if (out.sent.back()) out.sent.back() = as_stored(*slave.config, *out.sent.back());
    if (const sim::Actuator* const target = actuator(slave); target != nullptr) {
      // An actuator: the word that it has taken must be the word that the host has written.
      out.sent.back() = set_points_[slave.number];
      if (read) {
        Reading taken;
        taken.slave = static_cast<std::uint8_t>(slave.number);
        taken.raw = taken.position = target->word();
        reading = taken;
      }
    }
    out.results.push_back(result_of(*slave.config, reading));
  }
  return out;
}

const sim::Actuator* Mb4Session::actuator(const ConnectedSlave& slave) const {
  const sim::Slave* device = simulator_.slave(slave.number);
  return device != nullptr ? clocked(device)->actuator() : nullptr;
}

// Each actuator counts up from its first word.
Result<void> Mb4Session::write_actuators() {
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

// Actuators take their words when MA has rested for their timeout.
void Mb4Session::wait_for_actuators() {
  for (const ConnectedSlave& slave : slaves_) {
    if (actuator(slave) == nullptr) continue;
    simulator_.run_while_waiting(
        [&] { return clocked(simulator_.line(slave.channel))->chain().idle(); },
        simulator_.now() + sim::kPsPerSecond);
  }
}

// Reads the first ID register of a BiSS C slave.
std::string Mb4Session::check_id(unsigned slave) {
  const SlaveAddress address = slave_address(config_, static_cast<std::uint8_t>(slave));
  std::uint8_t value = 0;
  const Result<void> read =
      device_.control().read_registers(address, kRegisterDeviceId, Span<std::uint8_t>(&value, 1));
  if (!read) return describe(read.info());
  return value == simulator_.slave(slave)->reg_read(kRegisterDeviceId) ? "" : "wrong device ID";
}

std::string Mb4Session::access(const ControlRequest& request) {
  const SlaveAddress slave{static_cast<std::uint8_t>(request.channel),
                           static_cast<std::uint8_t>(request.id)};
  if (request.kind == ControlRequest::Kind::kCommand) {
    Command command;
    command.channels = static_cast<std::uint8_t>(request.channel);  // bit 0 and bit 1
    command.code = request.code;
    command.ids = request.ids;
    return error_of(device_.control().send(command));
  }
  std::vector<std::uint8_t> bytes = request.bytes;
  return error_of(
      request.kind == ControlRequest::Kind::kRead
          ? device_.control().read_registers(slave, request.address, {bytes.data(), bytes.size()})
          : device_.control().write_registers(slave, request.address,
                                              {bytes.data(), bytes.size()}));
}

std::string Mb4Session::send(const std::string& line) {
  const auto words = words_of(line);
  std::vector<std::uint8_t> received;
  return words.empty() ? "" : execute_words(simulator_, bus_, words, received);
}

// SCDATA1 to 8 and RDATA, eight bytes a line.
std::vector<RegisterMap::DataRow> data_rows(const Dump& dump) {
  constexpr std::size_t kBytesInRow = 8;
  std::vector<RegisterMap::DataRow> rows;
  const auto add = [&](std::size_t address, const std::string& name) {
    const auto begin = dump.begin() + static_cast<std::ptrdiff_t>(address);
    const auto end = begin + kBytesInRow;
    rows.push_back({static_cast<unsigned>(address), name,
                    fmt::format("{:02X}", fmt::join(begin, end, " ")),
                    std::all_of(begin, end, [](std::uint8_t byte) { return byte == 0; })});
  };
  for (std::size_t slave = 1; slave <= 8; ++slave) {
    add((slave - 1) * kBytesInRow, fmt::format("SCDATA{}", slave));
  }
  for (std::size_t i = 0; i < 64; i += kBytesInRow) {
    add(0x80 + i, fmt::format("RDATA{} to {}", i + 1, i + kBytesInRow));
  }
  return rows;
}

RegisterMap Mb4Session::registers() {
  constexpr unsigned kConfiguration = 0xC0;  // below: bytes that belong to one longer value
  std::array<std::uint8_t, kRegisters + 2> tx{
      static_cast<std::uint8_t>(regs::SpiOpcode::kReadRegisters), 0x00};
  std::array<std::uint8_t, kRegisters + 2> rx{};
  bus_.transfer(tx, rx);
  Dump dump{};
  std::copy(rx.begin() + 2, rx.end(), dump.begin());
  RegisterMap map;
  map.words.assign(dump.begin(), dump.end());
  map.data_rows = data_rows(dump);
  map.clk_hz = simulator_.scenario().chip.system_hz();
  for (const regs::FieldInfo& field : regs::kFields) {
    map.fields.push_back(field_of(field, regs::kCodes, dump[field.address]));
    map.fields.back().data = field.address < kConfiguration;
  }
  return map;
}

}  // namespace

const MasterSupport kMb4Support{
    .type = "ic-mb4",
    .check = [](const sim::Scenario& scenario) { make_config(scenario); },
    .open = [](const sim::Scenario& scenario, const SessionOptions& options)
        -> std::unique_ptr<Session> { return std::make_unique<Mb4Session>(scenario, options); },
    .sweep = {.name = "FREQS",
              .most = 31,
              .refuses = "Table 35 does not permit code",
              .divider = [](std::uint64_t /*clk_hz*/,
                            unsigned code) { return sim::ma_divider(code); },
              .jitter_item = "I305"},
    .control = true,
    .coverage = true,
    .scan = scan_mb4};

}  // namespace mb4::tool
