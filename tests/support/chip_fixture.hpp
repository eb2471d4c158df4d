// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Whole-chip tests: the Verilated chip behind its pins, a scenario of slaves, the driver over the
// simulated SPI port or parallel bus (test_host.hpp).
#ifndef TESTS_SUPPORT_CHIP_FIXTURE_HPP_
#define TESTS_SUPPORT_CHIP_FIXTURE_HPP_

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "masters/mb4/sim_bus.hpp"
#include "mb4/mb4.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/masters/mb4/pins.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/support/test_host.hpp"
#include "tests/support/wave.hpp"

namespace mb4test {

namespace sim = mb4::sim;

// A chip with any scenario text, and raw register access over its host.
class Chip {
 public:
  explicit Chip(const std::string& scenario)
      : simulator(with_test_host(sim::parse_scenario(scenario, "test.toml")), with_wave()),
        bus(simulator),
        clock(simulator),
        device(bus, clock) {}

  // Checks that no host model has broken the datasheet's timing.
  ~Chip() {
    for (const auto& violation : simulator.host_check().violations()) {
      ADD_FAILURE() << violation.text;
    }
  }

  // One SPI frame, or bus cycles that do the same; returns the MISO bytes.
  std::vector<std::uint8_t> spi(std::vector<std::uint8_t> tx) {
    std::vector<std::uint8_t> rx(tx.size());
    bus.transfer({tx.data(), tx.size()}, {rx.data(), rx.size()});
    return rx;
  }
  void write(std::uint8_t address, std::initializer_list<std::uint8_t> bytes) {
    std::vector<std::uint8_t> tx{reg::kSpiOpcodeWriteRegisters, address};
    tx.insert(tx.end(), bytes);
    spi(tx);
  }
  std::vector<std::uint8_t> read(std::uint8_t address, std::size_t count) {
    std::vector<std::uint8_t> tx(count + 2);
    tx[0] = reg::kSpiOpcodeReadRegisters;
    tx[1] = address;
    auto rx = spi(tx);
    return {rx.begin() + 2, rx.end()};
  }
  std::uint8_t read(std::uint8_t address) { return read(address, 1)[0]; }
  // Opcode 0x05: 0xF0 upward.
  std::uint8_t status() { return spi({reg::kSpiOpcodeReadStatus, 0x00})[1]; }
  // Opcode 0x07.
  void instruct(std::uint8_t byte) { spi({reg::kSpiOpcodeWriteInstruction, byte}); }
  void advance_us(std::uint64_t us) { simulator.advance(us * sim::kPsPerUs); }
  // Waits until EOT = 1 at the pin; false after `us`. Pin EOT falls two or three clocks after
  // the instruction's last SCLK edge (docs/timing.md).
  bool wait_eot(std::uint64_t us = 10000) {
    simulator.advance(400 * sim::kPsPerNs);
    return simulator.run_while_waiting([&] { return simulator.pin(sim::Pin::kEot); },
                                       simulator.now() + us * sim::kPsPerUs);
  }
  // BiSS C on channel 1, one slave, by hand.
  void configure_slave1(unsigned data_bits, std::uint8_t crc_byte, std::uint8_t freqs,
                        std::uint8_t freqags = 0x00) {
    write(reg::slave_cfg_address(1),
          {static_cast<std::uint8_t>(reg::kEnscdYes | (data_bits - 1)), crc_byte, 0x00, 0x00});
    write(reg::kAddrCtrl,
          {reg::kRegversBissC, static_cast<std::uint8_t>(reg::FREQR::of(5) | freqs), 0, freqags});
    write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
  }

  sim::Simulator simulator;
  mb4::tool::SimBus bus;
  mb4::tool::SimClock clock;
  mb4::Device<mb4::tool::SimBus, mb4::tool::SimClock> device;
};

// One BiSS C slave on channel 1: `keys` are further lines of its [[channel.slave]] table.
inline std::string one_slave(const std::string& keys, const std::string& channel_keys = "",
                             const std::string& chip_keys = "", const std::string& host_keys = "") {
  return "[chip]\n" + chip_keys + "\n[host]\ninterface = \"spi\"\n" + host_keys +
         "\n[[channel]]\nnumber = 1\n" + channel_keys +
         "\n[[channel.slave]]\nprotocol = \"biss-c\"\n" + keys + "\n";
}

// 26 position bits, nE, nW, CRC 0x43.
inline mb4::Config config26(std::uint32_t ma_hz, std::uint32_t f_clk_hz = 20'000'000) {
  mb4::Config config;
  config.f_clk_hz = f_clk_hz;
  config.ma_hz = ma_hz;
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;
  config.slaves[0].flags = mb4::Flags::kErrorWarning;
  config.slaves[0].crc_polynomial = 0x43;
  return config;
}

}  // namespace mb4test

#endif  // TESTS_SUPPORT_CHIP_FIXTURE_HPP_
