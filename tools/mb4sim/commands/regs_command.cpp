// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <array>
#include <cstdio>
#include <string>
#include <string_view>

#include "chip_setup.hpp"
#include "commands/commands.hpp"
#include "mb4/device.hpp"
#include "mb4_regs_table.hpp"
#include "mb4sim/simulator.hpp"
#include "report/exit_status.hpp"
#include "report/fault_report.hpp"
#include "report/messages.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim_bus.hpp"

namespace mb4::tool {
namespace {

constexpr std::size_t kRegisters = 256;
using Dump = std::array<std::uint8_t, kRegisters>;

Dump read_all(sim::Simulator& simulator) {
  std::array<std::uint8_t, kRegisters + 2> tx{0x03, 0x00};
  std::array<std::uint8_t, kRegisters + 2> rx{};
  SimBus(simulator).transfer(tx, rx);
  Dump dump{};
  std::copy(rx.begin() + 2, rx.end(), dump.begin());
  return dump;
}

unsigned value_of(const regs::FieldInfo& field, const Dump& dump) {
  return (static_cast<unsigned>(dump[field.address]) >> field.lsb) & ((1U << field.width) - 1U);
}

// SCDATA1 to 8 and RDATA: bytes that belong to one longer value.
bool is_data(const regs::FieldInfo& field) {
  constexpr unsigned kConfiguration = 0xC0;
  return field.address < kConfiguration;
}

std::string bits_of(const regs::FieldInfo& field) {
  const unsigned lsb = field.lsb;
  return field.width == 1 ? fmt::format("{}", lsb)
                          : fmt::format("{}:{}", lsb + field.width - 1, lsb);
}

std::string name_of(const regs::FieldInfo& field) {
  return field.alternate == nullptr ? field.name
                                    : fmt::format("{}/{}", field.name, field.alternate);
}

void print_text(const Dump& dump) {
  fmt::print("{:<4}  {:<18}  {}\n", "addr", "data", "bytes, lowest address first");
  constexpr std::size_t kRow = 8;
  const auto data_row = [&](std::size_t address, const std::string& name) {
    fmt::print("0x{:02X}  {:<18} ", address, name);
    for (std::size_t i = 0; i < kRow; ++i) fmt::print(" {:02X}", dump[address + i]);
    fmt::print("\n");
  };
  for (std::size_t slave = 1; slave <= 8; ++slave) {
    data_row((slave - 1) * kRow, fmt::format("SCDATA{}", slave));
  }
  for (std::size_t i = 0; i < 64; i += kRow) {
    data_row(0x80 + i, fmt::format("RDATA{} to {}", i + 1, i + kRow));
  }
  fmt::print("\n{:<4}  {:<4}  {:<18}  {:<4}  {:<5}  {}\n", "addr", "byte", "field", "bits", "value",
             "meaning");
  for (const regs::FieldInfo& field : regs::kFields) {
    if (is_data(field)) continue;
    fmt::print("0x{:02X}  0x{:02X}  {:<18}  {:<4}  0x{:02X}   {}\n", field.address,
               dump[field.address], name_of(field), bits_of(field), value_of(field, dump),
               field.description);
  }
}

void print_json(const Dump& dump) {
  fmt::print("{{\"registers\": [");
  for (std::size_t i = 0; i < kRegisters; ++i) fmt::print("{}{}", i == 0 ? "" : ", ", dump[i]);
  fmt::print("], \"fields\": [\n");
  bool first = true;
  for (const regs::FieldInfo& field : regs::kFields) {
    fmt::print(
        "{}  {{\"name\": \"{}\", \"address\": {}, \"lsb\": {}, \"width\": {}, \"value\": {}}}",
        first ? "" : ",\n", field.name, field.address, field.lsb, field.width,
        value_of(field, dump));
    first = false;
  }
  fmt::print("\n]}}\n");
}

}  // namespace

int regs_command(const RegsOptions& options) {
  const sim::Scenario scenario = load_chip_scenario(options.scenario);
  sim::Simulator simulator(scenario);
  bool good = true;
  if (!options.reset) {
    const Config config = make_config(scenario);
    SimBus bus(simulator);
    SimClock clock(simulator);
    Device device(bus, clock);
    if (const Result<void> done = device.configure(config); !done) {
      print_error(options.json, "cannot configure the chip: " + describe(done.info()), kBad);
      good = false;
    }
    for (std::uint64_t frame = 1; good && frame <= options.frames; ++frame) {
      Frame result;
      Error error = device.read_all(result).error();
      for (const ConnectedSlave& slave : connected_slaves(scenario)) {
        if (error == Error::kNone) error = result[slave.number].error();
      }
      if (error != Error::kNone) {
        print_error(options.json, fmt::format("frame {}: {}", frame, describe(error)), kBad);
        good = false;
      }
    }
  }
  const Dump dump = read_all(simulator);
  print_faults(options.json, simulator.faults());
  if (options.json) {
    print_json(dump);
  } else {
    print_text(dump);
  }
  return good ? kGood : kBad;
}

}  // namespace mb4::tool
