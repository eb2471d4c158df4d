// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A host accesses every address without a pause while frames run with AGSMIN and the encoder's
// registers are read. No frame may be disturbed and no value may be wrong. MB4_HOST_FRAMES sets the
// number of frames (default 3,000; nightly 100,000).
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <random>

#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/chip_fixture.hpp"
#include "tests/support/control_host.hpp"

namespace {

using mb4test::Chip;
namespace reg = mb4::regs;
namespace sim = mb4::sim;
using Bytes = std::vector<std::uint8_t>;

// Bytes of channels that are not enabled: no frame touches them.
bool is_spare(unsigned address) { return address >= 0x08 && address < 0x40; }
std::uint8_t spare(unsigned address) { return static_cast<std::uint8_t>(address * 89 + 7); }

class HostHammer : public testing::TestWithParam<const char*> {};

TEST_P(HostHammer, EveryAddressWhileFramesRun_NothingIsDisturbed) {
  const std::uint64_t wanted = mb4test::number_from("MB4_HOST_FRAMES", 3000);
  Chip chip(std::string("[host]\ninterface = \"") + GetParam() +
            "\"\nsclk_hz = 50_000_000\ncycle_ns = 110\n[[channel]]\nnumber = 1\ndelay_ns = 90.0\n"
            "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\ncrc = 0x43\n"
            "source = \"ramp\"\nstart = 5\nstep = 3\ncontrol = true\n"
            "registers = { 0x40 = [0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88] }\n");
  auto& simulator = chip.simulator;
  chip.advance_us(5);
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, mb4test::reg::kFreqagsAgsMin);
  mb4test::ControlHost control(chip);
  control.select(0);
  control.set_read(0, 0x40, 8);
  // Both banks of the spare bytes: by SWBANK, before frames run.
  for (const int instruction : {unsigned{reg::SWBANK::kMask}, unsigned{0}}) {
    for (unsigned address = 0x08; address < 0x40; ++address) {
      chip.write(static_cast<std::uint8_t>(address), {spare(address)});
    }
    chip.advance_us(1);
    chip.instruct(static_cast<std::uint8_t>(instruction));
    chip.advance_us(1);
  }
  std::array<std::uint8_t, 256> config{};
  for (unsigned address = reg::kAddrSlaveCfg; address < reg::kAddrStatus0; ++address) {
    config[address] = chip.read(static_cast<std::uint8_t>(address));
  }

  std::mt19937_64 random(4711);
  std::uint64_t reads = 0, writes = 0, accesses = 0;
  const sim::Slave& slave = *simulator.slave(1);
  chip.instruct(reg::kInstrControl | reg::kAgsOn);
  for (unsigned long turn = 0; slave.frames() < wanted; ++turn) {
    const auto address = static_cast<std::uint8_t>(random());
    const bool write = random() % 3 == 0;
    if (!write) {
      const std::uint8_t value = chip.read(address);
      ++reads;
      const auto check = [&](bool here, unsigned mask, unsigned expected) {
        if (here) {
          EXPECT_EQ(value & mask, expected) << std::hex << +address;
        }
      };
      check(is_spare(address), 0xFF, spare(address));
      check(address >= 0x40 && address < reg::kAddrRdata, 0xFF, 0);
      check(address >= reg::kAddrSlaveCfg && address < reg::kAddrStatus0, 0xFF, config[address]);
      check(address == reg::kAddrStatus0, 0xFA, 0xFA);  // no error flag
      check(address == reg::kAddrStatus9, 0xFF, reg::kResetStatus9);
      check(address == reg::kAddrSwbankfail || address == reg::kAddrIface, 0xFF, 0);
      ASSERT_FALSE(testing::Test::HasFailure()) << "turn " << turn;
    } else if (is_spare(address)) {
      chip.write(address, {spare(address)});
      ++writes;
    } else if (address >= reg::kAddrSlaveCfg && address < reg::kAddrStatus0) {
      chip.write(address, {config[address]});
      ++writes;
    } else if ((address >= 0x40 && address < reg::kAddrRdata) || address > reg::kAddrIface) {
      chip.write(address, {static_cast<std::uint8_t>(random())});  // reserved, read-only
      ++writes;
    } else if (address == reg::kAddrStatus0 || address == reg::kAddrStatus3) {
      chip.write(address, {static_cast<std::uint8_t>(random())});  // read-only
      ++writes;
    } else if (address == reg::kAddrSvalidLo || address == reg::kAddrSvalidHi) {
      chip.write(address, {0xFF});  // no effect
      ++writes;
    }
    if (turn % 64 == 0 && (chip.read(reg::kAddrInstr) & reg::INSTR::kMask) == 0) {
      ASSERT_EQ(chip.read(reg::kAddrRdata, 8),
                (Bytes{0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88}));
      ASSERT_EQ(chip.read(reg::kAddrStatus0) & ~reg::EOT::kMask,
                (reg::kResetStatus0 & ~reg::EOT::kMask) | reg::kRegendDone)
          << "REGEND and no error";
      ++accesses;
      chip.instruct(reg::kInstrControl | reg::kAgsOn);
      simulator.advance(500'000);  // 5 T to the next access that may be to 0xF4
    }
  }
  const auto& counters = clocked(simulator.slave(1))->control()->counters();
  EXPECT_EQ(counters.header_errors + counters.data_errors + counters.protocol_errors, 0U);
  EXPECT_EQ(counters.aborts, 0U);
  EXPECT_GT(accesses, wanted / 400);
  std::printf("%s: %llu frames, %llu reads, %llu writes, %llu register accesses\n", GetParam(),
              static_cast<unsigned long long>(slave.frames()),
              static_cast<unsigned long long>(reads), static_cast<unsigned long long>(writes),
              static_cast<unsigned long long>(accesses));
}

INSTANTIATE_TEST_SUITE_P(Host, HostHammer, testing::Values("spi", "spi2", "intel", "motorola"));

}  // namespace
