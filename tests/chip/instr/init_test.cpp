// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS C INIT together with other events: other writes of 0xF4, BREAK, the slaves' timeout, frames
// that are due (pages 32..34; decisions 3, 8, 19, 25).
#include <gtest/gtest.h>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const char kAdaptive[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ntimeout = \"adaptive\"";
const char k20us[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ntimeout = 20.0";

// Decisions 19, 25: INIT that waits for a frame, or runs, is not lost by another write of 0xF4 and
// reads back 1 until its end.
TEST(ChipInit, OtherWritesMeanwhile_DoNotEndIt) {
  for (const unsigned byte : {0x00U, 0x01U, 0x40U, 0x20U}) {
    Chip chip(one_slave(kAdaptive, "delay_ns = 1000.0"));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x04, 0x7F);
    chip.instruct(reg::kInstrCdm0);
    chip.instruct(reg::kInitStart);
    for (int i = 0; i < 40; ++i) {
      chip.instruct(static_cast<std::uint8_t>(byte));
      const unsigned value = chip.read(reg::kAddrInstr);
      if (chip.simulator.pin(sim::Pin::kEot)) break;  // it has ended
      EXPECT_EQ(value, 0x10 | byte);
    }
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrInstr), byte);
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
    EXPECT_EQ(chip.simulator.slave(1)->frames(), 1U);
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), 2U) << "the frame and the INIT";
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().last(chip.simulator.now()).rising, 2U);
    EXPECT_EQ(chip.read(reg::kAddrScdata), 9) << "1000 ns, a quarter of 500 ns";
  }
}

// Decision 35: SCDATA1 and SCDATA5 hold line delays after INIT, so all SVALID are 0, without an
// error; the next frame sets those of its words.
TEST(ChipInit, AllSvalid_AreZeroBehindIt) {
  for (const unsigned freqs : {0x00U, 0x04U}) {
    Chip chip(one_slave(kAdaptive, "delay_ns = 150.0") +
              "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 14\ncrc = 0x43\n"
              "[[channel]]\nnumber = 2\n[[channel.slave]]\nprotocol = \"biss-c\"\n" +
              kAdaptive + "\n");
    chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(freqs),
                          reg::kFreqagsAgsMin);
    chip.write(reg::slave_cfg_address(2), {reg::kEnscdYes | 13, reg::kScrclenCrc6, 0x00, 0x00});
    chip.write(reg::slave_cfg_address(5), {reg::kEnscdYes | 27, reg::kScrclenCrc6, 0x00, 0x00});
    chip.write(reg::kAddrSlaveloc5, {reg::kResetSlaveloc5 | reg::kSlaveloc5Split,
                                     reg::kCfgch2BissC | reg::kCfgch1BissC});
    const std::vector<std::uint8_t> all{0x0A, 0x02};
    const std::vector<std::uint8_t> none{0x00, 0x00};
    for (int frame = 0; frame < 2; ++frame) {  // a word in each bank
      chip.instruct(reg::kInstrCdm0);
      ASSERT_TRUE(chip.wait_eot());
      EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2), all);
      chip.advance_us(20);
    }
    chip.instruct(reg::kInitStart);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kNer));
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2), none);
    EXPECT_EQ(chip.read(reg::kAddrScdata), freqs == 0 ? 7 : 2)
        << "150 ns in quarters of 100 and 500 ns";
    EXPECT_EQ(chip.read(reg::scdata_address(5)), 1);
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    EXPECT_EQ(chip.read(reg::kAddrSvalidLo, 2), all);
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
  }
}

// Page 16: the slave answers "with a rising edge at SL after the BiSS timeout"; INIT and EOT = 0
// last until then, so that the next frame finds SL = 1.
TEST(ChipInit, LastsUntilTheSlavesTimeout) {
  Chip chip(one_slave(k20us));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x00);
  const sim::Time start = chip.simulator.now();
  chip.instruct(reg::kInitStart);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_GT(chip.simulator.now() - start, 20 * sim::kPsPerUs);
  EXPECT_TRUE(chip.simulator.pin(sim::Pin::kSl1));
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.status(), reg::kResetStatus0) << "no nAGSERR";
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
}

// docs/choices.md: INIT waits for the slaves' timeout, at most 1024 MA periods; page 33: SL that
// stays low is no error.
TEST(ChipInit, SlStaysLowAfterAFrame_WaitsFor1024PeriodsOnly) {
  for (const unsigned later_us : {0U, 150U}) {
    Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ntimeout = 1000.0"));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);  // 100 ns a period
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    const sim::Time end = chip.simulator.now();
    chip.advance_us(later_us);
    chip.instruct(reg::kInitStart);
    const auto until = [&](const auto& condition) {
      const sim::Time begin = chip.simulator.now();
      while (!condition() && chip.simulator.now() - begin < 300 * sim::kPsPerUs) {
        chip.simulator.advance(100 * sim::kPsPerNs);
      }
    };
    until([&] { return clocked(chip.simulator.line(1))->monitor().frames() == 2U; });
    const double limit_us = later_us == 0 ? 102.4 : later_us;
    EXPECT_NEAR(static_cast<double>(chip.simulator.now() - end), limit_us * sim::kPsPerUs,
                2.0 * sim::kPsPerUs);
    EXPECT_FALSE(chip.simulator.pin(sim::Pin::kSl1));
    EXPECT_FALSE(chip.simulator.pin(sim::Pin::kEot));
    const sim::Time begin = chip.simulator.now();
    until([&] { return chip.simulator.pin(sim::Pin::kEot); });
    EXPECT_NEAR(static_cast<double>(chip.simulator.now() - begin), 102.4 * sim::kPsPerUs,
                2.0 * sim::kPsPerUs);
    EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
    EXPECT_EQ(chip.status() & reg::nAGSERR::kMask, reg::kNagserrGood) << "nAGSERR";
  }
}

// docs/choices.md: INIT looks for the acknowledge at 255 sampling points. After one without an
// answer the line is free for the next one, and for frames.
TEST(ChipInit, NoSlaveAnswers_TheLineIsFreeForWhatFollows) {
  Chip chip(one_slave(kAdaptive));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  auto& line = *clocked(chip.simulator.line(1));
  line.faults().stick(true);
  chip.instruct(reg::kInitStart);
  ASSERT_TRUE(chip.wait_eot(60)) << "SL is high: no timeout to wait for";
  EXPECT_EQ(chip.status(), reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nAGSERR::kMask))
      << "nERR = nAGSERR = 0";
  EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
  line.faults().stick(std::nullopt);
  chip.advance_us(50);
  chip.instruct(reg::kInitStart);
  ASSERT_TRUE(chip.wait_eot(20)) << "nothing to wait for";
  EXPECT_EQ(line.monitor().frames(), 2U);
  EXPECT_EQ(line.monitor().last(chip.simulator.now()).rising, 2U) << "answered at once";
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
}

// Page 33: BREAK ends all current actions: INIT does not begin again.
TEST(ChipInit, Break_EndsIt) {
  for (unsigned phase = 0; phase < 30; ++phase) {
    Chip chip(one_slave(k20us));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x04, reg::kFreqagsAgsMin);
    chip.instruct(reg::kInitStart);
    chip.simulator.advance(phase * 173 * sim::kPsPerNs);
    chip.instruct(reg::kBreakAbort);
    chip.advance_us(1);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kEot)) << phase;
    EXPECT_EQ(chip.read(reg::kAddrInstr), 0) << phase;
    const auto frames = clocked(chip.simulator.line(1))->monitor().frames();
    chip.advance_us(100);
    EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), frames) << phase;
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1));
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
  }
}

// Page 32, decision 3: a frame that is requested in the slaves' timeout finds SL low.
TEST(ChipInstr, AskedForInTheSlavesTimeout_NoFrameAndAgsError) {
  Chip chip(one_slave(k20us));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x00);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  chip.instruct(reg::kInstrCdm0);
  chip.advance_us(50);
  EXPECT_EQ(chip.status(), reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nAGSERR::kMask))
      << "nERR = nAGSERR = 0";
  EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), 1U);
}

// Page 34: a frame that is due while INIT runs is left out, with nAGSERR = 0; it does not come
// later, and the following ones keep their time.
TEST(ChipAgs, DueDuringInit_IsOmittedAndTheNextIsInTime) {
  Chip chip(one_slave(kAdaptive, "delay_ns = 20000.0"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, 0x63);  // T_MA 400 ns; 100 us
  chip.instruct(reg::kAgsOn);
  auto& monitor = clocked(chip.simulator.line(1))->monitor();
  chip.advance_us(350);
  const sim::Time third = monitor.last(chip.simulator.now()).start;
  const sim::Time period = 100 * sim::kPsPerUs;
  chip.simulator.run_until(third + period - 10 * sim::kPsPerUs);
  chip.instruct(reg::kInitStart | reg::kAgsOn);
  chip.simulator.run_until(third + period + 60 * sim::kPsPerUs);
  EXPECT_EQ(chip.status(), reg::kResetStatus0 & ~(reg::nERR::kMask | reg::nAGSERR::kMask));
  EXPECT_LT(monitor.last(chip.simulator.now()).start, third + period) << "the INIT was the last";
  chip.simulator.run_until(third + 2 * period + 80 * sim::kPsPerUs);
  EXPECT_EQ(monitor.last(chip.simulator.now()).start, third + 2 * period);
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
}

}  // namespace
