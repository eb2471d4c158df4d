// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS B register access between automatic frames, and with MO: pages 13, 16, 28, 32 to 34.
#include <gtest/gtest.h>

#include "sim/lines/biss/biss_b_slave.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/protocol_chip.hpp"

namespace {

using mb4test::ProtocolChip;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

std::string bus(const std::string& channel_keys, const std::string& slave_keys) {
  return "[[channel]]\nnumber = 1\n" + channel_keys +
         "[[channel.slave]]\nprotocol = \"biss-b\"\ndata_bits = 16\ndata = 0x1234\n" + slave_keys;
}

sim::BissBSlave& slave(ProtocolChip& chip) {
  return dynamic_cast<sim::BissBSlave&>(*chip.simulator.slave(1));
}

// Runs until MA of line 1 has risen `count` times.
bool ma_rises(ProtocolChip& chip, unsigned count) {
  bool ma = true;
  return chip.simulator.run_while_waiting(
      [&] {
        const bool level = chip.simulator.pin(sim::Pin::kMa1);
        if (level && !ma) --count;
        ma = level;
        return count == 0;
      },
      chip.simulator.now() + 100 * sim::kPsPerUs);
}

bool access_ends(ProtocolChip& chip) {
  return chip.simulator.run_while_waiting([&] { return (chip.status() & reg::REGEND::kMask) != 0; },
                                          chip.simulator.now() + 200 * sim::kPsPerUs);
}

// SL has this level for this time, whatever the slave sends.
void hold_sl(ProtocolChip& chip, bool level, sim::Time time) {
  clocked(chip.simulator.line(1))->faults().stick(level);
  chip.simulator.refresh_lines();
  chip.simulator.advance(time);
  clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
}

// After a register access the slave gets its register timeout before the next frame begins, also if
// the last bit on the cable is 1, or the next bit that the slave would send. On a bus the slaves
// pass on MO = 1.
class BissBUnderAgsmin : public testing::TestWithParam<std::tuple<double, unsigned, bool>> {};

TEST_P(BissBUnderAgsmin, FramesGoOnBehindTheRegisterTimeout) {
  const auto [cable_ns, freqr, by_mo] = GetParam();
  const double t_mar_ns = 100.0 * (2U << freqr);
  if (cable_ns > t_mar_ns - 30) return;  // I405
  ProtocolChip chip(bus("delay_ns = " + std::to_string(cable_ns) + (by_mo ? "\nmo = true\n" : "\n"),
                        "timeout = 2\nregister_timeout = " +
                            std::to_string((by_mo ? 0.0015 : 0.0008) * t_mar_ns) + "\n"),
                    {.freqs = 0, .freqr = freqr, .biss_c_registers = false, .en_mo = by_mo});
  const auto& counters = slave(chip).access().counters();
  chip.instruct(reg::kAgsOn);
  for (unsigned value = 0; value < 16; ++value) {
    for (const bool write : {true, false}) {
      chip.write_rdata({static_cast<std::uint8_t>(write ? value : 0xFF)});
      chip.set_access(by_mo ? 1 : 0, 0x20, 1, write);
      chip.instruct(reg::kAgsOn | reg::kInstrControl);
      ASSERT_TRUE(chip.simulator.run_while_waiting(
          [&] {
            return !slave(chip).in_register_mode() && clocked(chip.simulator.line(1))->sl() &&
                   (write ? counters.writes : counters.reads) == value + 1;
          },
          chip.simulator.now() + 2000 * sim::kPsPerUs))
          << value;
      const auto frames = slave(chip).frames();
      chip.advance_us(60);
      EXPECT_GT(slave(chip).frames(), frames + 5) << value;
      EXPECT_EQ(counters.protocol_errors, 0U) << value;
      EXPECT_EQ(counters.aborts, 0U) << value;
      EXPECT_EQ(chip.status() & ~(reg::kConstStatus0 | reg::EOT::kMask),
                unsigned{reg::kNerrGood | reg::kNagserrGood | reg::kNdelayerrGood |
                         reg::kNscderrGood | reg::kNregerrGood | reg::kRegendDone})
          << value;
      EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn) << value;
      EXPECT_EQ(chip.read(reg::kAddrRdata), value) << write;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cables, BissBUnderAgsmin,
                         testing::Combine(testing::Values(0.0, 60.0, 190.0, 370.0),
                                          testing::Values(0U, 1U, 3U, 5U), testing::Bool()));

// The same if the access ends with an error: a wrong echo, a wrong CRC of the slave.
TEST(ChipBissBAgs, AccessWithAnError_FramesGoOnBehindTheRegisterTimeout) {
  for (unsigned value = 0; value < 16; ++value) {
    for (const bool write : {true, false}) {
      ProtocolChip chip(bus("", "timeout = 2\nregister_timeout = 1.2\n"),
                        {.freqs = 0, .freqr = 3, .biss_c_registers = false});
      slave(chip).access().set_wrong_data_crc(!write);
      slave(chip).reg_write(0x20, static_cast<std::uint8_t>(value));
      chip.write_rdata({static_cast<std::uint8_t>(0x10 * value)});
      chip.set_access(0, 0x20, 1, write);
      chip.instruct(reg::kAgsOn | reg::kInstrControl);
      if (write) {
        // The echo of one data bit is wrong.
        ASSERT_TRUE(chip.simulator.run_while_waiting([&] { return slave(chip).in_register_mode(); },
                                                     chip.simulator.now() + 100 * sim::kPsPerUs));
        chip.simulator.advance((20 + value / 2) * chip.t_mar);
        hold_sl(chip, !clocked(chip.simulator.line(1))->sl(), chip.t_mar);
      }
      ASSERT_TRUE(access_ends(chip));
      EXPECT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask), reg::kRegendDone)
          << value << write;
      // The rest of the byte has not gone out: the slave does not take it.
      EXPECT_EQ(slave(chip).reg_read(0x20), value) << write;
      chip.advance_us(10);
      const auto frames = slave(chip).frames();
      chip.advance_us(60);
      EXPECT_GT(slave(chip).frames(), frames + 5) << value << write;
      EXPECT_EQ(slave(chip).access().counters().protocol_errors, 0U) << value << write;
      EXPECT_EQ(chip.status() & (reg::nAGSERR::kMask | reg::nSCDERR::kMask),
                unsigned{reg::kNagserrGood | reg::kNscderrGood})
          << value << write;
    }
  }
}

// The chip ignores SL during the address part, because a slave may send the address back.
TEST(ChipBissBAgs, SlInTheAddressPart_IsNotLookedAt) {
  for (const bool write : {true, false}) {
    ProtocolChip chip(bus("", "timeout = 2\nregisters = { 0x10 = 0x5A }\n"),
                      {.freqs = 0, .freqr = 3, .biss_c_registers = false});
    chip.write_rdata({0xC3});
    chip.set_access(0, 0x10, 1, write);
    chip.instruct(reg::kInstrControl);
    ASSERT_TRUE(ma_rises(chip, 2));
    // 17 cells; up to an eighth after the first edge of the byte.
    hold_sl(chip, true, 16 * chip.t_mar + chip.t_mar / 8);
    ASSERT_TRUE(access_ends(chip));
    EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone) << write;
    EXPECT_EQ(chip.read(reg::kAddrRdata), write ? 0xC3 : 0x5A);
    EXPECT_EQ(slave(chip).reg_read(0x10), write ? 0xC3 : 0x5A);
  }
}

// Decision 6, docs/choices.md: what comes back of the stop bits of a write is not checked.
TEST(ChipBissBAgs, SlInTheStopBitOfAWrite_IsNotLookedAt) {
  constexpr unsigned kAddressCells = 17;
  constexpr unsigned kByteCells = 14;
  ProtocolChip chip(bus("", "timeout = 2\nregisters = { 0x10 = 0x5A, 0x11 = 0xA5 }\n"),
                    {.freqs = 0, .freqr = 3, .biss_c_registers = false});
  chip.write_rdata({0xC3, 0x3C});
  chip.set_access(0, 0x10, 2, true);
  chip.instruct(reg::kInstrControl);
  // The stop bit of the first byte comes back in the next cell, the first of the second byte.
  ASSERT_TRUE(ma_rises(chip, kAddressCells + kByteCells + 1));
  chip.simulator.advance(chip.t_mar / 2);
  ASSERT_FALSE(clocked(chip.simulator.line(1))->sl());
  hold_sl(chip, true, chip.t_mar);
  ASSERT_TRUE(access_ends(chip));
  EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone);
  EXPECT_EQ(slave(chip).reg_read(0x10), 0xC3);
  EXPECT_EQ(slave(chip).reg_read(0x11), 0x3C);
}

// Table 56: REGEND = 0 from the instruction on, although the access has to wait for its turn.
TEST(ChipBissBAgs, SecondAccess_RegendFallsWithTheInstruction) {
  ProtocolChip chip(bus("", "timeout = 2\nregisters = { 0x10 = 0x5A, 0x11 = 0xA5 }\n"),
                    {.freqs = 0, .freqr = 1, .biss_c_registers = false, .freqags = 0xFF});
  chip.instruct(reg::kAgsOn);  // one frame every 4 ms
  for (const unsigned address : {0x10U, 0x11U}) {
    chip.set_access(0, address, 1, false);
    chip.instruct(reg::kAgsOn | reg::kInstrControl);
    EXPECT_EQ(chip.status() & (reg::nREGERR::kMask | reg::REGEND::kMask), reg::kNregerrGood)
        << address;
    ASSERT_TRUE(
        chip.simulator.run_while_waiting([&] { return (chip.status() & reg::REGEND::kMask) != 0; },
                                         chip.simulator.now() + 10'000 * sim::kPsPerUs));
    EXPECT_EQ(chip.read(reg::kAddrRdata), address == 0x10 ? 0x5A : 0xA5);
    EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn);
  }
}

// Figure 16 on a bus.
TEST(ChipBissBAgs, InitOnABus_EndsWithTheHandOver) {
  ProtocolChip chip(bus("mo = true\n", "timeout = 2\n"),
                    {.freqs = 0, .freqr = 1, .biss_c_registers = false, .en_mo = true});
  for (unsigned i = 0; i < 2; ++i) {
    ASSERT_TRUE(chip.frame(reg::kInitStart));
    EXPECT_EQ(chip.ma[0].size(), 2U);
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
    ASSERT_TRUE(chip.frame());
    EXPECT_EQ(chip.scdata(1, 16), 0x1234U);
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
  }
}

// HOLDBANK concerns the banks of SCDATA (page 33); a register access does not use them.
TEST(ChipBissBAgs, HeldSwitch_DoesNotKeepARegisterAccess) {
  ProtocolChip chip(bus("", "timeout = 2\nregisters = { 0x10 = 0x5A }\n"),
                    {.freqs = 0, .freqr = 1, .biss_c_registers = false});
  ASSERT_TRUE(chip.run(reg::kHoldbankPrevented | reg::kInstrCdm0, 1000));
  chip.advance_us(50);
  chip.set_access(0, 0x10, 1, false);
  ASSERT_TRUE(chip.run(reg::kHoldbankPrevented | reg::kInstrControl, 1000));
  EXPECT_EQ(chip.read(reg::kAddrRdata), 0x5A);
  EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone);
  EXPECT_EQ(chip.read(reg::kAddrSwbankfail), 0);
}

}  // namespace
