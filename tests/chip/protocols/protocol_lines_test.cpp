// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The behaviour of each line when both are in use with different protocols: pages 16, 23, 25, 27
// (Table 23), 28, 32 (Table 46).
#include <gtest/gtest.h>

#include "sim/lines/biss/biss_b_slave.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/protocol_chip.hpp"

namespace {

using mb4test::ProtocolChip;
using mb4test::valid;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

std::string channel(unsigned number, const std::string& protocol, const std::string& keys = "",
                    const std::string& channel_keys = "") {
  return "[[channel]]\nnumber = " + std::to_string(number) + "\n" + channel_keys +
         "[[channel.slave]]\nprotocol = \"" + protocol +
         "\"\ndata_bits = 16\ndata = " + std::to_string(0x1110 * number + 1) + "\n" + keys + "\n";
}

sim::BissBSlave& biss_b(ProtocolChip& chip, unsigned number) {
  return dynamic_cast<sim::BissBSlave&>(*chip.simulator.slave(number));
}

// Page 27: CHSEL selects one line; the other line gets no control data.
TEST(ProtocolLines, BissBRegisters_OnTheSelectedLineAlone) {
  for (const bool by_mo : {false, true}) {
    const std::string mo = by_mo ? "mo = true\n" : "";
    ProtocolChip chip(channel(1, "biss-b", "registers = { 0x10 = 0x51 }", mo) +
                          channel(2, "biss-b", "registers = { 0x10 = 0x52 }", mo),
                      {.freqs = 0, .freqr = 1, .biss_c_registers = false, .en_mo = by_mo});
    for (const unsigned line : {2U, 1U, 2U}) {
      chip.write(reg::kAddrChsel, {static_cast<std::uint8_t>(line)});
      chip.set_access(by_mo ? 1 : 0, 0x10, 1, false);
      ASSERT_TRUE(chip.frame(reg::kInstrControl));
      EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone) << line;
      EXPECT_EQ(chip.read(reg::kAddrRdata), 0x50 + line) << line;
      EXPECT_TRUE(chip.ma[2 - line].empty()) << line;
      EXPECT_TRUE(chip.mo[2 - line].empty()) << line;
      EXPECT_EQ(chip.mo[line - 1].size(), by_mo ? 2U : 0U) << line;
      chip.write_rdata({static_cast<std::uint8_t>(0xA0 + line)});
      chip.set_access(by_mo ? 1 : 0, 0x20, 1, true);
      ASSERT_TRUE(chip.frame(reg::kInstrControl));
      EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone) << line;
      EXPECT_EQ(chip.simulator.slave(line == 1 ? 1 : 5)->reg_read(0x20), 0xA0 + line);
      ASSERT_TRUE(chip.frame());
      EXPECT_EQ(chip.scdata(1, 16), 0x1111U);
      EXPECT_EQ(chip.scdata(5, 16), 0x2221U);
    }
    EXPECT_EQ(biss_b(chip, 1).access().counters().starts, 2U);
    EXPECT_EQ(biss_b(chip, 5).access().counters().starts, 4U);
  }
}

// CHSEL = 11: both get the same, line 1 is read. The hand-over waits for the slower slave.
TEST(ProtocolLines, BissBRegistersOnBothLines_WaitForBothHandOvers) {
  ProtocolChip chip(channel(1, "biss-b", "timeout = 3\nregisters = { 0x10 = 0x51 }") +
                        channel(2, "biss-b", "timeout = 40\nregisters = { 0x10 = 0x52 }"),
                    {.freqs = 0, .freqr = 1, .biss_c_registers = false});
  chip.write(reg::kAddrChsel, {reg::kChsel2Used | reg::kChsel1Used});
  chip.set_access(0, 0x10, 1, false);
  ASSERT_TRUE(chip.frame(reg::kInstrControl));
  EXPECT_EQ(chip.status(), reg::kResetStatus0 | reg::kRegendDone);
  EXPECT_EQ(chip.read(reg::kAddrRdata), 0x51);
  for (const unsigned line : {0U, 1U}) {
    ASSERT_GE(chip.ma[line].size(), 2U);
    EXPECT_GE(chip.ma[line][1].time - chip.ma[line][0].time, 40 * sim::kPsPerUs);
  }
  chip.write_rdata({0x77});
  chip.set_access(0, 0x20, 1, true);
  ASSERT_TRUE(chip.frame(reg::kInstrControl));
  EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x20), 0x77);
  EXPECT_EQ(chip.simulator.slave(5)->reg_read(0x20), 0x77);
}

// Decision 14: a reduced frame has no sensor data on either line, whatever the protocol of the
// other line is.
TEST(ProtocolLines, ReducedFrames_ClockOutNoWordOnTheOtherLine) {
  for (const char* other : {"biss-b", "ssi"}) {
    ProtocolChip chip(channel(1, "biss-c") + channel(2, other), {.freqs = 4});
    ASSERT_TRUE(chip.frame());
    EXPECT_EQ(chip.scdata(5, 16), 0x2221U);
    chip.advance_us(100);
    chip.simulator.slave(5)->set_data(0x1234);
    ASSERT_TRUE(chip.frame(reg::kInstrControlReduced));  // INSTR = 111
    EXPECT_LT(chip.ma[1].size(), 16U) << other;
    EXPECT_EQ(chip.scdata(5, 16), 0x2221U) << other;
    EXPECT_EQ(chip.svalid(), valid({1, 5})) << other;
  }
}

// Page 28, decision 37: a BiSS B access needs a selected BiSS B line. Without one it ends at once
// with an error, and RDATA is what it was; with one of two it runs on that one.
TEST(ProtocolLines, BissBAccess_LeavesTheOtherProtocolAlone) {
  for (const char* other : {"biss-c", "ssi"}) {
    for (const unsigned line : {1U, 2U}) {  // of the BiSS B slave
      const std::string biss_b_keys = "registers = { 0x10 = 0x51 }";
      ProtocolChip chip(line == 1 ? channel(1, "biss-b", biss_b_keys) + channel(2, other)
                                  : channel(1, other) + channel(2, "biss-b", biss_b_keys),
                        {.freqs = 4, .freqr = 1, .biss_c_registers = false});
      chip.set_access(0, 0x10, 1, false);
      for (const unsigned chsel : {0U, 1U, 2U, 3U}) {
        const bool fits = ((chsel == 0 ? 1U : chsel) & line) != 0;
        const std::string what = std::string(other) + ", BiSS B on " + std::to_string(line) +
                                 ", CHSEL " + std::to_string(chsel);
        chip.write(reg::kAddrChsel, {static_cast<std::uint8_t>(chsel)});
        const auto stale = static_cast<std::uint8_t>(0xE0 + chsel);
        chip.write_rdata({stale});
        ASSERT_TRUE(fits ? chip.frame(reg::kInstrControl) : chip.run(reg::kInstrControl, 5))
            << what;
        EXPECT_EQ(chip.read(reg::kAddrInstr), 0) << what;
        EXPECT_EQ(chip.ma[line - 1].empty(), !fits) << what;
        EXPECT_TRUE(chip.ma[2 - line].empty()) << what;
        EXPECT_EQ(chip.status(),
                  fits ? reg::kResetStatus0 | reg::kRegendDone
                       : (reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nREGERR::kMask)) |
                             reg::kRegendDone)
            << what;
        EXPECT_EQ(chip.read(reg::kAddrRdata), fits ? 0x51 : stale) << what;
      }
      ASSERT_TRUE(chip.frame());
      EXPECT_EQ(chip.svalid(), valid({1, 5}));
    }
  }
}

// Figure 16: SL = 0 on all lines in use, or nAGSERR = 0 after 4096 register clocks.
TEST(ProtocolLines, BissBInit_WaitsForBothLinesAndGivesUp) {
  ProtocolChip chip(channel(1, "biss-b", "timeout = 3") + channel(2, "biss-b", "timeout = 40"),
                    {.freqs = 0, .freqr = 1, .biss_c_registers = false});
  ASSERT_TRUE(chip.frame(reg::kInitStart));
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
  for (const unsigned line : {0U, 1U}) {
    ASSERT_EQ(chip.ma[line].size(), 2U);
    EXPECT_GE(chip.ma[line][1].time - chip.ma[line][0].time, 40 * sim::kPsPerUs);
    EXPECT_LE(chip.ma[line][1].time - chip.ma[line][0].time, 42 * sim::kPsPerUs);
  }
  for (const unsigned stuck : {1U, 2U}) {
    clocked(chip.simulator.line(stuck))->faults().stick(true);
    ASSERT_TRUE(chip.run(reg::kInitStart, 10'000)) << stuck;
    EXPECT_EQ(chip.status(), reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nAGSERR::kMask))
        << stuck;  // nAGSERR and nERR
    EXPECT_EQ(chip.read(reg::kAddrInstr), 0) << stuck;
    ASSERT_EQ(chip.ma[0].size(), 2U);
    const sim::Time low = chip.ma[0][1].time - chip.ma[0][0].time;
    EXPECT_GE(low, 4096 * chip.t_mar) << stuck;
    EXPECT_LE(low, 4098 * chip.t_mar) << stuck;
    clocked(chip.simulator.line(stuck))->faults().stick(std::nullopt);
    chip.simulator.refresh_lines();
    chip.advance_us(2000);
  }
  ASSERT_TRUE(chip.frame());
  EXPECT_EQ(chip.svalid(), valid({1, 5}));
}

// SSI has no INIT sequence, so MA of an SSI line rests. With SSI lines only, INIT just resets the
// flags.
TEST(ProtocolLines, InitOfSsi_MovesNoLine) {
  ProtocolChip mixed(channel(1, "ssi") + channel(2, "biss-c"), {.freqs = 4});
  ASSERT_TRUE(mixed.frame(reg::kInitStart));
  EXPECT_TRUE(mixed.ma[0].empty());
  EXPECT_EQ(mixed.ma[1].size(), 4U);
  EXPECT_EQ(mixed.status(), reg::kResetStatus0);
  ProtocolChip alone(channel(1, "ssi"), {.freqs = 4, .freqags = 0x00});
  clocked(alone.simulator.line(1))->faults().stick(false);
  alone.simulator.refresh_lines();
  alone.instruct(reg::kInstrCdm0);
  alone.advance_us(10);
  EXPECT_EQ(alone.status(), reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nAGSERR::kMask));
  ASSERT_TRUE(alone.run(reg::kInitStart, 1000));
  EXPECT_TRUE(alone.ma[0].empty());
  EXPECT_EQ(alone.status(), reg::kResetStatus0);
  EXPECT_EQ(alone.read(reg::kAddrInstr), 0);
}

// MO and ACTnSENS mean nothing to an SSI line.
TEST(ProtocolLines, SsiBesideMo_ReadsItsWordAndLeavesMoAlone) {
  ProtocolChip chip(channel(1, "ssi") + channel(2, "biss-c", "", "mo = true\n"),
                    {.freqs = 4, .en_mo = true, .mo_busy = 2});
  chip.write(reg::kAddrActnsens, {reg::ACTnSENS<1>::kMask});
  ASSERT_TRUE(chip.frame());
  EXPECT_TRUE(chip.mo[0].empty());
  EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMo1));
  EXPECT_EQ(chip.mo[1].size(), 4U);
  EXPECT_EQ(chip.scdata(1, 16), 0x1111U);
  EXPECT_EQ(chip.svalid(), valid({1, 5}));
}

// Page 15: control data belong to BiSS C. Bit 7 of 0xC0 has no meaning for a BiSS sensor.
TEST(ProtocolLines, CdmAndGrays_MeanNothingToBissB) {
  ProtocolChip chip(channel(1, "biss-b"), {.freqs = 4, .freqr = 0, .biss_c_registers = false});
  chip.write(reg::slave_cfg_address(1), {reg::kGraysGray | reg::kEnscdYes | 15});
  for (const unsigned instr : {2U, 4U, 6U}) {
    ASSERT_TRUE(chip.frame(static_cast<std::uint8_t>(instr)));
    ASSERT_EQ(chip.ma[0].size(), 2U * (16 + 6 + 4)) << instr;
    EXPECT_TRUE(chip.ma[0].back().level);
    EXPECT_EQ(chip.scdata(1, 16), 0x1111U);
    EXPECT_EQ(chip.read(reg::kAddrStatus8) & reg::CDS1::kMask, 0U);
  }
}

// An encoder may answer up to one period less 30 ns late, also with its last bit. The chip must not
// take a last bit of 1 for the end of the monoflop time.
TEST(ProtocolLines, SsiLastBitOneAndLate_NextFrameWaitsForTheMonoflop) {
  for (const unsigned freqs : {0U, 1U, 4U}) {
    const double most = 50.0 * mb4test::ma_clocks(freqs) - 30;
    ProtocolChip chip(
        "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"ssi\"\n"
        "data_bits = 13\ntimeout = 5\nsource = \"ramp\"\nstart = 1\nstep = 2\n"
        "response_ns = " +
            std::to_string(most) + "\n",
        {.freqs = freqs});
    chip.instruct(reg::kAgsOn);
    for (unsigned i = 0; i < 20; ++i) {
      chip.advance_us(23);
      chip.instruct(reg::kHoldbankPrevented | reg::kAgsOn);  // HOLDBANK
      const auto word = chip.scdata(1, 13);
      chip.instruct(reg::kAgsOn);
      const auto frames = chip.simulator.slave(1)->frames();
      EXPECT_EQ(word % 2, 1U) << freqs;
      EXPECT_LE(word, 2 * frames + 1) << freqs;
      EXPECT_GE(word + 6, 2 * frames) << freqs;
    }
    EXPECT_GT(chip.simulator.slave(1)->frames(), 30U) << freqs;
    EXPECT_EQ(chip.status() & reg::nSCDERR::kMask, reg::kNscderrGood)
        << freqs;  // HOLDBANK under AGSMIN: nAGSERR = 0
  }
}

}  // namespace
