// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Line delay through the whole chip (page 12, I304, I305, sampling points; pages 16, 32, 33): long
// lines, both directions of the permissible deviation, INIT at every FREQS code.
#include <gtest/gtest.h>

#include <string>

#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"
#include "tests/support/chip_fixture.hpp"
#include "tests/support/control_host.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const char kEncoder[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF";
constexpr sim::Time kClock = 50 * sim::kPsPerNs;

// All codes of FREQS that Table 35 permits.
std::vector<unsigned> all_codes() {
  std::vector<unsigned> codes;
  for (unsigned code = 0; code < 32; ++code) {
    if (sim::ma_divider(code) != 0) codes.push_back(code);
  }
  return codes;
}

sim::Time period_of(unsigned code) { return sim::ma_divider(code) * kClock; }

// Frame by hand; true if SVALID1 = 1, nSCDERR = 1 and the position is right.
bool good_frame(Chip& chip, std::uint64_t limit_us = 5000,
                std::uint8_t instruction = reg::kInstrCdm0) {
  chip.instruct(instruction);
  if (!chip.wait_eot(limit_us)) return false;
  const auto status = chip.spi({reg::kSpiOpcodeReadStatus, 0, 0});
  return (status[1] & reg::nSCDERR::kMask) != 0 && (status[1] & reg::EOT::kMask) != 0 &&
         (status[2] & reg::SVALID<1>::kMask) != 0 &&
         chip.read(reg::kAddrScdata, 4) == std::vector<std::uint8_t>{0xBF, 0x37, 0xAF, 0x0A};
}

// Decision 17, I304: normal frames over lines of many MA periods, one after the other.
TEST(ChipLine, DelayOf10To1000Periods_NormalFramesWork) {
  for (const unsigned code : {0x00U, 0x03U, 0x09U}) {
    for (const unsigned periods : {1U, 10U, 100U, 1000U}) {
      Chip chip(one_slave(kEncoder));
      chip.simulator.line(1)->set_round_trip(periods * period_of(code));
      chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(code));
      for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(good_frame(chip)) << code << " " << periods;
        // MA has stopped while edges are still on the line: it has made no more than the start bit
        // needed.
        const auto frame = clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now());
        EXPECT_GE(frame.rising, std::max(39U, periods)) << code << " " << periods;
        EXPECT_LE(frame.rising, std::max(39U, periods + 7U)) << code << " " << periods;
        chip.simulator.advance(3 * periods * period_of(code));
        EXPECT_TRUE(clocked(chip.simulator.slave(1))->idle());
      }
    }
  }
}

// Decision 17, docs/timing.md: on a long line MA stops as soon as the start bit is known: with CDM
// = 1 it keeps a low level that it has then, only CDM = 0 takes the rising edge that ends it.
TEST(ChipLine, LongLine_CdmOneSendsNoEdgeTooMany) {
  std::uint64_t kept = 0;
  for (unsigned eighths = 0; eighths < 16; ++eighths) {
    std::uint64_t rising[2] = {};
    for (const unsigned cdm : {0U, 1U}) {
      Chip chip(one_slave(kEncoder));
      chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsMin);
      chip.simulator.line(1)->set_round_trip(50 * period_of(3) + eighths * period_of(3) / 8);
      ASSERT_TRUE(good_frame(chip, 5000, cdm == 0 ? 0x04 : 0x02));
      chip.simulator.advance(60 * period_of(3));
      EXPECT_EQ(clocked(chip.simulator.slave(1))->last_cdm(), cdm == 1);
      rising[cdm] = clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising;
    }
    EXPECT_GE(rising[0], rising[1]);
    EXPECT_LE(rising[0], rising[1] + 1);
    kept += rising[0] - rising[1];
  }
  EXPECT_EQ(kept, 8U) << "in every second half period MA is low";
}

// I306: a slave may end its frame after MA has rested for 55 % of a period. Then SL is low after
// the last bit for no longer than that, and the slave has taken CDM before the master can know.
TEST(ChipLine, SlaveTimeoutOf55Percent_FramesAndCdmAreRight) {
  for (const unsigned code : all_codes()) {
    const auto period = period_of(code);
    for (const unsigned percent : {0U, 60U, 230U}) {
      const double us = static_cast<double>(period) * 0.55 / sim::kPsPerUs;
      Chip chip(one_slave(std::string(kEncoder) + "\ntimeout = " + std::to_string(us)));
      chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(code),
                            reg::kFreqagsAgsMin);
      chip.simulator.line(1)->set_round_trip(period / 100 * percent);
      for (const unsigned hold : {0U, 1U}) {
        chip.write(reg::kAddrCtrl, {static_cast<std::uint8_t>(reg::kRegversBissC | hold)});
        for (const unsigned instr : {reg::kInstrCdm1, reg::kInstrCdm0, reg::kInstrCdm1}) {
          ASSERT_TRUE(good_frame(chip, 5000, static_cast<std::uint8_t>(instr)))
              << code << " " << percent << " " << hold << " " << instr;
          chip.simulator.advance(5 * period);
          EXPECT_TRUE(clocked(chip.simulator.slave(1))->idle());
          EXPECT_EQ(clocked(chip.simulator.slave(1))->last_cdm(), instr == 0x02)
              << code << " " << percent;
          EXPECT_EQ(chip.simulator.pin(sim::Pin::kMa1), hold == 0 || instr == 0x04);
        }
      }
      EXPECT_EQ(chip.status(), reg::kResetStatus0);
    }
  }
}

// Page 12: the delay is measured anew in every frame.
TEST(ChipLine, AnotherCableBetweenFrames_IsMeasuredAnew) {
  Chip chip(one_slave(kEncoder));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00);
  for (unsigned i = 0; i < 200; ++i) {
    const sim::Time delay = (i * 7919U) % 2500U * sim::kPsPerNs;
    chip.simulator.line(1)->set_round_trip(delay);
    ASSERT_TRUE(good_frame(chip)) << delay;
    chip.advance_us(10);
  }
}

// Both lines at once, each with its own delay; with page 12's measurement per channel.
TEST(ChipLine, TwoChannelsOfDifferentDelay_BothFramesAreGood) {
  const std::string text =
      std::string("[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n") +
      kEncoder + "\n[[channel]]\nnumber = 2\n[[channel.slave]]\nprotocol = \"biss-c\"\n" +
      kEncoder + "\n";
  Chip chip(text);
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 27, reg::kScrclenCrc6, 0x00, 0x00});
  chip.write(reg::kAddrSlaveloc5,
             {reg::kResetSlaveloc5 | reg::kSlaveloc5Split,
              reg::kCfgch2BissC | reg::kCfgch1BissC});  // SLAVELOC5, both channels BiSS C
  const unsigned delays[][2] = {{0, 0}, {0, 1230}, {1230, 0}, {37, 112}, {9000, 400}, {25, 50}};
  for (const auto& [first, second] : delays) {
    chip.simulator.line(1)->set_round_trip(first * sim::kPsPerNs);
    chip.simulator.line(2)->set_round_trip(second * sim::kPsPerNs);
    chip.advance_us(50);
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    const auto status = chip.spi({reg::kSpiOpcodeReadStatus, 0, 0, 0});
    EXPECT_EQ(status[1] & 0x11, 0x11) << first << " " << second;
    EXPECT_EQ(status[2] & 0x02, 0x02) << first << " " << second;
    EXPECT_EQ(status[3] & 0x02, 0x02) << first << " " << second;
    // Page 33: SCDATA1 and SCDATA5 of one INIT. Table 68's erratum 3 (Z1) is not there: one delay
    // may be longer than the other line's delay and timeout.
    chip.advance_us(50);
    chip.instruct(reg::kInitStart);
    ASSERT_TRUE(chip.wait_eot());
    if (first < 6350 && second < 6350) {
      EXPECT_EQ(chip.status() & (reg::nAGSERR::kMask | reg::EOT::kMask),
                reg::kNagserrGood | reg::kEotIdle)
          << first << " " << second;
      EXPECT_EQ(chip.read(reg::kAddrScdata), first / 25 + 1) << first << " " << second;
      EXPECT_EQ(chip.read(reg::scdata_address(5)), second / 25 + 1) << first << " " << second;
    } else {
      EXPECT_EQ(chip.status() & (reg::nAGSERR::kMask | reg::EOT::kMask), reg::kEotIdle)
          << "beyond 255 quarters: nAGSERR";
      chip.instruct(reg::kBreakAbort);
    }
  }
}

// I305 in the strict reading. The acknowledge is a falling edge; with a skew of the SL wire every
// rising edge deviates from it by exactly that much, every falling one not at all. A bit is taken
// more than one and up to two quarters after the measured edge (docs/timing.md): rising edges may
// be 25 % of T_MA late and 50 % early, at every phase of the delay; one picosecond more fails at
// some phase.
TEST(ChipLine, DeviationFromTheFirstMeasurement_25PercentLateAnd50EarlyAndNoMore) {
  for (const unsigned code : {0x00U, 0x01U, 0x02U, 0x05U}) {
    const auto period = static_cast<std::int64_t>(period_of(code));
    const auto bad_phases = [&](std::int64_t late) {
      // Positive skew delays falling edges, the acknowledge too: rising edges come early.
      const sim::WireFaults sl{0, -late, 0, 0};
      Chip chip(one_slave(kEncoder));
      chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(code));
      clocked(chip.simulator.line(1))->set_faults({}, sl);
      unsigned bad = 0;
      for (std::int64_t quarter = 0; quarter < 5; ++quarter) {
        for (const std::int64_t off :
             {std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, period / 8, period / 5}) {
          const std::int64_t ack = 2 * period + quarter * period / 4 + off;
          // The skew must not count as delay.
          const std::int64_t delay = ack - (late < 0 ? -late : 0);
          chip.simulator.line(1)->set_round_trip(static_cast<sim::Time>(delay));
          if (!good_frame(chip, 100)) {
            ++bad;
            chip.instruct(reg::kBreakAbort);
          }
          chip.advance_us(20);
        }
      }
      return bad;
    };
    for (const std::int64_t late :
         {period / 4, period / 5, std::int64_t{0}, -period / 4, -period / 3, -period / 2}) {
      EXPECT_EQ(bad_phases(late), 0U) << "FREQS " << code << ", late by " << late << " ps";
    }
    EXPECT_GT(bad_phases(period / 4 + 1), 0U) << "FREQS " << code;
    EXPECT_GT(bad_phases(-period / 2 - 1), 0U) << "FREQS " << code;
  }
}

// Page 33, decision 2: INIT counts the quarters up to and including the first that reads 0: the
// modelled delay to the quarter, at each of the 31 codes.
TEST(ChipInit, EveryFreqsCode_MeasuresTheDelayToTheQuarter) {
  ASSERT_EQ(all_codes().size(), 31U);
  for (const unsigned code : all_codes()) {
    const sim::Time quarter = period_of(code) / 4;
    Chip chip(one_slave(kEncoder));
    chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
    chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(code));
    for (const sim::Time n : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U, 50U, 129U, 254U}) {
      // SL falls just before the sampling point, at the point (too late for it), and just after the
      // point before it.
      for (const sim::Time delay : {(n + 1) * quarter - 1, n * quarter, n * quarter + 1}) {
        chip.simulator.line(1)->set_round_trip(delay);
        chip.instruct(reg::kInitStart);
        ASSERT_TRUE(chip.wait_eot(100'000)) << code << " " << n;
        EXPECT_EQ(chip.status() & (reg::nAGSERR::kMask | reg::EOT::kMask),
                  reg::kNagserrGood | reg::kEotIdle)
            << code << " " << n;
        EXPECT_EQ(chip.read(reg::kAddrScdata), n + 1)
            << "FREQS " << code << ", delay " << delay << " ps";
        EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising, 2U);
      }
    }
    // 255 is the limit; beyond it the sequence is aborted.
    chip.simulator.line(1)->set_round_trip(255 * quarter);
    chip.instruct(reg::kInitStart);
    ASSERT_TRUE(chip.wait_eot(100'000)) << code;
    EXPECT_EQ(chip.status() & (reg::nAGSERR::kMask | reg::EOT::kMask), reg::kEotIdle) << code;
    EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
  }
}

// Page 32: INIT sets nSCDERR, nREGERR, nDELAYERR, nAGSERR to 1 and REGEND to 0. Each is brought to
// the other level before.
TEST(ChipInit, AfterErrors_SetsTheFlagsAndResetsRegend) {
  Chip chip(one_slave(kEncoder));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00);
  mb4test::ControlHost host(chip);
  host.select(0x01);
  const auto expect_init_resets = [&](std::uint8_t flag, bool level) {
    EXPECT_EQ((chip.status() & flag) != 0, level) << unsigned{flag};
    chip.advance_us(50);
    chip.instruct(reg::kInitStart);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.status(), reg::kResetStatus0) << unsigned{flag};
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kNer));
  };
  clocked(chip.simulator.line(1))->faults().flip_next_frame({5});
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  expect_init_resets(0x10, false);  // nSCDERR

  chip.simulator.line(1)->set_round_trip(10 * sim::kPsPerUs);
  chip.instruct(reg::kInitStart);
  ASSERT_TRUE(chip.wait_eot());
  chip.simulator.line(1)->set_round_trip(0);
  expect_init_resets(0x40, false);  // nAGSERR

  host.set_read(0, 0x44, 1);
  ASSERT_NE(host.run_single(200), 0U);
  expect_init_resets(0x04, true);  // REGEND

  host.set_read(5, 0x44, 1);  // no slave of this ID
  ASSERT_NE(host.run_single(200), 0U);
  expect_init_resets(0x08, false);  // nREGERR
}

// TI TIDEP0022, Table 10: line delay in MA clocks for lengths and frequencies, 12 filled rows at 1,
// 2 and 5 MHz. 138 ns and 16.6 ns/m there and back.
TEST(ChipInit, TiTable10_LineDelayInClocksIsAsPrinted) {
  struct Row {
    unsigned number;
    unsigned ma_mhz;
    unsigned metres;
    unsigned clocks;
  };
  const Row rows[] = {{1, 1, 2, 1},      {2, 1, 15 + 2, 1},  {3, 1, 25 + 2, 1},
                      {4, 1, 40 + 2, 1}, {5, 1, 65 + 2, 2},  {6, 2, 2, 1},
                      {7, 2, 15 + 2, 1}, {8, 2, 25 + 2, 2},  {10, 2, 65 + 2, 3},
                      {11, 5, 2, 1},     {12, 5, 15 + 2, 3}, {13, 5, 25 + 2, 3}};
  for (const Row& row : rows) {
    for (const unsigned clk_mhz : {20U, 10U}) {
      if (clk_mhz % (2 * row.ma_mhz) != 0) continue;  // not of Table 35
      Chip chip(one_slave(
          kEncoder,
          "cable_m = " + std::to_string(row.metres) + "\nns_per_m = 8.3\ntransceiver_ns = 69",
          "f_clk_hz = " + std::to_string(clk_mhz) + "000000"));
      const unsigned half = clk_mhz / row.ma_mhz / 2;
      chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(half - 1));
      chip.instruct(reg::kInitStart);
      ASSERT_TRUE(chip.wait_eot());
      const unsigned quarters = chip.read(reg::kAddrScdata);
      EXPECT_EQ((quarters + 3) / 4, row.clocks)
          << "row " << row.number << ", " << quarters << " quarters, CLK " << clk_mhz << " MHz";
      EXPECT_TRUE(good_frame(chip));
    }
  }
}

}  // namespace
