// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Automatic frames: datasheet pages 30..32, Tables 37, 44.
#include <gtest/gtest.h>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

constexpr sim::Time kClk = 50'000;  // 20 MHz in ps
const char kTiny[] = "data_bits = 1\ncrc = 0\ndata = 1\nflag_bits = 0\ntimeout = \"adaptive\"";
const char kEncoder26[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ntimeout = \"adaptive\"";

// Table 37 in clocks.
std::uint64_t ags_period(unsigned code) {
  return code < 0x80 ? 20ULL * (code + 1) : 625ULL * (code - 127);
}

// Start times of the next `count` frames on channel 1.
std::vector<sim::Time> frame_starts(Chip& chip, unsigned count, sim::Time limit) {
  std::vector<sim::Time> starts;
  auto& monitor = clocked(chip.simulator.line(1))->monitor();
  std::uint64_t seen = monitor.frames();
  const sim::Time end = chip.simulator.now() + limit;
  bool was_high = true;
  chip.simulator.run_while_waiting(
      [&] {
        const bool ma = chip.simulator.pin(sim::Pin::kMa1);
        if (was_high && !ma && monitor.frames() != seen) {
          seen = monitor.frames();
          starts.push_back(chip.simulator.now());
        }
        was_high = ma;
        return starts.size() >= count;
      },
      end);
  return starts;
}

class AgsRate : public testing::TestWithParam<unsigned> {};

TEST_P(AgsRate, Frames_AreExactlyOnePeriodApart) {
  const unsigned code = GetParam();
  Chip chip(one_slave(kTiny));
  chip.configure_slave1(1, 0, 0x00, static_cast<std::uint8_t>(code));
  chip.instruct(reg::kAgsOn);
  const auto starts = frame_starts(chip, 4, (6 * ags_period(code) + 100) * kClk);
  ASSERT_EQ(starts.size(), 4U);
  for (std::size_t i = 1; i < starts.size(); ++i) {
    EXPECT_EQ(starts[i] - starts[i - 1], ags_period(code) * kClk);
  }
  chip.advance_us(2);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask),
            reg::kNerrGood | reg::kNagserrGood | reg::kNscderrGood);
  chip.instruct(0);
}

INSTANTIATE_TEST_SUITE_P(Table37Fast, AgsRate, testing::Range(0U, 0x7CU));
INSTANTIATE_TEST_SUITE_P(Table37Slow, AgsRate, testing::Range(0x80U, 0x100U));

// Table 37: 0x7C..0x7F make no rate: AGSMIN runs at the frame's own pace, AGSINFINITE not at all.
TEST(ChipAgs, AgsMinAndInfinite_AreNoRates) {
  for (const unsigned code : {0x7CU, 0x7DU, 0x7EU, 0x7FU}) {
    Chip chip(one_slave(kTiny));
    chip.configure_slave1(1, 0, 0x00, static_cast<std::uint8_t>(code));
    chip.instruct(reg::kAgsOn);
    chip.advance_us(200);
    if (code == 0x7C) {
      EXPECT_GT(chip.simulator.slave(1)->frames(), 200U - 10U) << "at most 1 us each";
    } else {
      EXPECT_EQ(chip.simulator.slave(1)->frames(), 0U) << code;
    }
    EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask),
              reg::kNerrGood | reg::kNagserrGood | reg::kNscderrGood);
  }
}

TEST(ChipAgs, HundredThousandFrames_NoDrift) {
  Chip chip(one_slave(kTiny));
  chip.configure_slave1(1, 0, 0x00, 0x01);
  chip.instruct(reg::kAgsOn);
  const auto first = frame_starts(chip, 1, 100'000'000).at(0);
  const auto frames = clocked(chip.simulator.line(1))->monitor().frames();
  chip.simulator.run_until(first + 100'000 * 40 * kClk - 10 * kClk);
  const auto last = frame_starts(chip, 1, 100'000'000).at(0);
  EXPECT_EQ(last - first, 100'000ULL * 40 * kClk);
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), frames + 100'000);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask),
            reg::kNerrGood | reg::kNagserrGood | reg::kNscderrGood);
}

// Decision 19: AGS = 1 written again neither restarts nor shifts the repetition.
TEST(ChipAgs, AgsWrittenAgain_DoesNotShiftTheFrames) {
  Chip chip(one_slave(kTiny));
  chip.configure_slave1(1, 0, 0x00, 0x09);
  chip.instruct(reg::kAgsOn);
  const auto first = frame_starts(chip, 1, 100'000'000).at(0);
  for (int i = 0; i < 20; ++i) {
    chip.simulator.advance(1'234'567);
    chip.instruct(i % 2 == 0 ? reg::kInstrCdm1 | reg::kAgsOn
                             : reg::kAgsOn);  // another CDM, AGS stays
  }
  const auto later = frame_starts(chip, 1, 100'000'000).at(0);
  EXPECT_EQ((later - first) % (200 * kClk), 0U);
}

// Page 34: a frame that is due while the last one has not finished is left out: nAGSERR = 0; the
// next one is tried.
TEST(ChipAgs, RateTooHigh_FramesAreOmittedAndFlagged) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x01);  // 2 us, the frame needs 4
  chip.instruct(reg::kAgsOn);
  chip.advance_us(50);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask), 0);
  const auto frames = chip.simulator.slave(1)->frames();
  EXPECT_GT(frames, 5U);
  EXPECT_LT(frames, 15U);
  EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn) << "decision 21: AGS stays";
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
}

// BREAK clears nAGSERR, also if it comes in the clock in which a frame is due and left out, because
// another one runs or because SL is 0.
TEST(ChipAgs, BreakWhileFramesAreLeftOut_NoErrorStays) {
  for (const bool sl_low : {false, true}) {
    Chip chip(one_slave(kEncoder26));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x01);  // 2 us are 40 clocks
    if (sl_low) {
      clocked(chip.simulator.line(1))->faults().stick(false);
      chip.simulator.refresh_lines();
    }
    for (unsigned clock = 0; clock < 40; ++clock) {
      chip.instruct(reg::kAgsOn);
      chip.advance_us(20);
      ASSERT_EQ(chip.status() & reg::nAGSERR::kMask, 0) << clock;
      chip.simulator.advance(clock * kClk);
      chip.instruct(reg::kBreakAbort);
      EXPECT_EQ(chip.status() & reg::nAGSERR::kMask, unsigned{reg::kNagserrGood})
          << clock << " clocks, SL low " << sl_low;
      chip.advance_us(10);
    }
  }
}

TEST(ChipAgs, ErrorWithQuirk_ClearsAgs) {
  Chip chip(one_slave(kEncoder26, "", "[chip.quirks]\nAGS_CLEARED_ON_ERROR = true"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x01);
  chip.instruct(reg::kAgsOn);
  chip.advance_us(50);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask), 0);
  EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
}

// Page 30: AGSMIN restarts with the slave's timeout.
TEST(ChipAgs, AgsMin_PitchIsFramePlusTimeout) {
  Chip chip(one_slave(kEncoder26, "delay_ns = 0.0"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  chip.instruct(reg::kAgsOn);
  const auto starts = frame_starts(chip, 12, 1'000'000'000);
  ASSERT_EQ(starts.size(), 12U);
  // N + 5 edges and 1.5 periods of adaptive timeout at 100 ns are 4.05 us.
  const double limit_us = (34 + 5 + 1.5) * 0.1;
  for (std::size_t i = 3; i < starts.size(); ++i) {
    const double pitch_us = static_cast<double>(starts[i] - starts[i - 1]) * 1e-6;
    EXPECT_GE(pitch_us, limit_us - 0.1);
    EXPECT_LE(pitch_us, limit_us + 0.2);
    if (i == 3) RecordProperty("pitch_ns", static_cast<int>(pitch_us * 1000));
  }
  std::printf("AGSMIN pitch %.3f us, limit %.3f us\n",
              static_cast<double>(starts[5] - starts[4]) * 1e-6, limit_us);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask),
            reg::kNerrGood | reg::kNagserrGood | reg::kNscderrGood);
}

// Page 30: AGSMIN "requires completed BiSS frames to ensure a low level at SL at the end of each
// frame". After a frame that is clocked out SL shows the slave's timeout, and the next frame waits
// for its end. After a frame that is too short, a data bit of 1 looks like that end: the next frame
// comes during the slave's timeout, and none of its words is valid.
TEST(ChipAgs, AgsMin_NeedsFramesThatAreClockedOut) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0xFFFFFFF\ntimeout = 20.0"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  const sim::Time clocks = (34 + 5) * 2 * kClk;
  const sim::Time timeout = 20 * sim::kPsPerUs;
  chip.instruct(reg::kAgsOn);
  auto starts = frame_starts(chip, 5, 1'000'000'000);
  ASSERT_EQ(starts.size(), 5U);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_GE(starts[i] - starts[i - 1], clocks + timeout);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask),
            reg::kNerrGood | reg::kNagserrGood | reg::kNscderrGood);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  chip.instruct(reg::kBreakAbort);
  chip.advance_us(50);
  chip.write(reg::kAddrSvalidLo, {0});
  chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 11});
  chip.instruct(reg::kAgsOn);
  // The monitor cannot tell frames that follow each other at once: rests of MA.
  sim::Time edge = chip.simulator.now();
  sim::Time rest = 0;
  bool level = true;
  chip.simulator.run_while_waiting(
      [&] {
        const bool ma = chip.simulator.pin(sim::Pin::kMa1);
        if (ma != level) {
          if (chip.simulator.slave(1)->frames() > 5)
            rest = std::max(rest, chip.simulator.now() - edge);
          edge = chip.simulator.now();
          level = ma;
        }
        return false;
      },
      chip.simulator.now() + 15 * sim::kPsPerUs);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 6U);
  EXPECT_GT(rest, 0U);
  EXPECT_LT(rest, timeout / 4) << "it does not wait for the slave";
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), 0);
  chip.instruct(reg::kBreakAbort);
  chip.advance_us(50);
  chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 27});
  chip.instruct(reg::kAgsOn);
  chip.advance_us(100);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask),
            reg::kNerrGood | reg::kNagserrGood | reg::kNscderrGood);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
}

// C08, page 32: GETSENS to the falling edge of MA takes 2 / f_CLK + 1 / (2 f_MA), counted from the
// clock edge that sees GETSENS, for a pulse of one clock at any phase.
TEST(ChipGetsens, PulseOfOneClock_MaFallsAfterTwoClocksAndHalfAPeriod) {
  // 0x10 is not permitted (page 30); docs/choices.md says what it does.
  for (const unsigned code : {0U, 1U, 3U, 9U, 0x10U, 0x11U, 0x1FU}) {
    Chip chip(one_slave(kEncoder26));
    chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(code),
                          reg::kFreqagsAgsInfinite);
    chip.instruct(reg::kAgsOn);
    chip.advance_us(200);
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), 0U);
    const sim::Time half = code < 0x10 ? code + 1 : 10 * (code - 15);
    std::uint64_t frames = 0;
    for (const sim::Time before : {1ULL, 1'000ULL, 12'500ULL, 25'000ULL, 37'500ULL, 49'999ULL}) {
      // The next rising edge of CLK but one.
      const auto cycles = chip.simulator.clk_cycles();
      while (chip.simulator.clk_cycles() == cycles) chip.simulator.advance(500);
      const sim::Time seen = chip.simulator.now() / 500 * 500 + kClk;
      chip.simulator.run_until(seen - before);
      chip.simulator.set_pin(sim::Pin::kGetsens, true);
      chip.simulator.advance(kClk);
      chip.simulator.set_pin(sim::Pin::kGetsens, false);
      const auto starts = frame_starts(chip, 1, 1'000'000'000);
      ASSERT_EQ(starts.size(), 1U) << before;
      EXPECT_EQ(starts[0] - seen, (2 + half) * kClk) << "code " << code << ", raised " << before;
      ASSERT_TRUE(chip.wait_eot());
      chip.advance_us(700);
      EXPECT_EQ(chip.simulator.slave(1)->frames(), ++frames) << "one pulse, one frame";
    }
  }
}

// Page 32: GETSENS works by its level: held high it starts the next frame too, if HOLDCDM = 0.
TEST(ChipGetsens, HeldHigh_FramesRepeatUnlessHoldCdm) {
  for (const bool hold : {false, true}) {
    Chip chip(one_slave(kEncoder26));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x7E);
    chip.write(reg::kAddrCtrl,
               {static_cast<std::uint8_t>(hold ? reg::kRegversBissC | reg::kHoldcdmHold
                                               : reg::kRegversBissC)});
    chip.instruct(reg::kAgsOn);
    chip.simulator.set_pin(sim::Pin::kGetsens, true);
    chip.advance_us(100);
    if (hold) {
      EXPECT_EQ(chip.simulator.slave(1)->frames(), 1U);
      chip.simulator.set_pin(sim::Pin::kGetsens, false);
      chip.advance_us(1);
      chip.simulator.set_pin(sim::Pin::kGetsens, true);
      chip.advance_us(100);
      EXPECT_EQ(chip.simulator.slave(1)->frames(), 2U);
    } else {
      EXPECT_GT(chip.simulator.slave(1)->frames(), 15U);
    }
    EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask),
              reg::kNerrGood | reg::kNagserrGood | reg::kNscderrGood);
  }
}

// Pages 31, 32: with AGSINFINITE a frame is started by GETSENS or by INSTR; without AGS GETSENS
// does nothing.
TEST(ChipGetsens, AgsInfinite_InstrStartsAFrameAndStays) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x7F);
  chip.simulator.set_pin(sim::Pin::kGetsens, true);
  chip.advance_us(20);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 0U);
  chip.simulator.set_pin(sim::Pin::kGetsens, false);
  chip.instruct(reg::kInstrCdm0 | reg::kAgsOn);
  chip.advance_us(50);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 1U);
  EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kInstrCdm0 | reg::kAgsOn);
}

// Table 45 with AGS = 1: INSTR chooses CDM of the frames to come.
TEST(ChipAgs, InstrUnderAgs_ChoosesCdmAndStays) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x31);  // 50 us
  const sim::Time period = 50 * sim::kPsPerUs;
  const sim::Time start = chip.simulator.now();
  const sim::ClockedSlave& slave = *clocked(chip.simulator.slave(1));
  unsigned periods = 0;
  // CDM with CDS = 0 and with CDS = 1; 011: NOT CDSSEL.
  struct Row {
    unsigned byte;
    bool cdm[2];
  };
  for (const Row& row : {Row{0x01, {false, false}}, Row{0x03, {true, true}},
                         Row{0x05, {false, false}}, Row{0x07, {true, false}}}) {
    chip.instruct(static_cast<std::uint8_t>(row.byte));
    for (const unsigned cds : {0U, 1U, 1U, 0U, 1U, 0U}) {
      if (cds == 1) clocked(chip.simulator.line(1))->faults().flip_next_frame({1});
      chip.simulator.run_until(start + period / 2 + ++periods * period);  // between two frames
      EXPECT_EQ(slave.last_cdm(), row.cdm[cds]) << row.byte << " CDS " << cds;
      EXPECT_EQ(chip.read(reg::kAddrInstr), row.byte);
      EXPECT_EQ((chip.read(reg::kAddrStatus3) & reg::CDSSEL::kMask) != 0, cds == 1) << "CDSSEL";
    }
  }
  EXPECT_EQ(slave.frames(), periods);
  EXPECT_EQ(slave.cdm_count(), periods);
}

// Decision 8: BREAK and AGS in one byte: abort, then the repetition runs again; the flags are 1.
TEST(ChipAgs, BreakWithAgs_RecoversFromASilentSensor) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x31);
  clocked(chip.simulator.line(1))->faults().stick(true);
  chip.simulator.refresh_lines();
  chip.instruct(reg::kAgsOn);
  chip.advance_us(500);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::EOT::kMask), 0)
      << "missed frames raise nAGSERR (docs/choices.md: AGS with a rate)";
  clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
  chip.instruct(reg::kBreakAbort | reg::kAgsOn);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask),
            reg::kNerrGood | reg::kNagserrGood);
  EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kAgsOn);
  const auto frames = chip.simulator.slave(1)->frames();
  chip.advance_us(500);
  EXPECT_EQ(chip.status() & (reg::nERR::kMask | reg::nAGSERR::kMask | reg::nSCDERR::kMask),
            reg::kNerrGood | reg::kNagserrGood | reg::kNscderrGood);
  EXPECT_GE(chip.simulator.slave(1)->frames(), frames + 9);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
}

// Page 33, decision 15: HOLDBANK under AGS. The next frame due runs into the other bank, nAGSERR
// stays 1, and SWBANKFAIL is 1 until the next good switch. With the quirk the chip omits the frame
// and sets nAGSERR = 0.
TEST(ChipAgs, HoldBank_RunsFramesOrWithTheQuirkOmitsThem) {
  for (const bool error : {true, false}) {
    Chip chip(one_slave(
        kEncoder26, "",
        std::string("[chip.quirks]\nAGSERR_ON_HOLDBANK = ") + (error ? "true" : "false")));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x31);
    chip.instruct(reg::kAgsOn);
    chip.advance_us(130);
    const auto frames = chip.simulator.slave(1)->frames();
    chip.instruct(reg::kHoldbankPrevented | reg::kAgsOn);
    chip.advance_us(500);
    EXPECT_EQ(chip.status() & reg::nAGSERR::kMask, error ? 0 : reg::kNagserrGood);
    EXPECT_EQ(chip.read(reg::kAddrSwbankfail), reg::kSwbankfailFailed);
    EXPECT_EQ(chip.simulator.slave(1)->frames(), error ? frames + 1 : frames + 10);
    chip.instruct(reg::kAgsOn);
    chip.advance_us(120);
    EXPECT_EQ(chip.read(reg::kAddrSwbankfail), 0);
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
  }
}

}  // namespace
