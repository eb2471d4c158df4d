// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The host writes 0xF4 at every phase around the moments that decide its effect: the start of a
// frame, its end, and the time at which a frame is due (pages 30, 32, Tables 37, 45; decision 19).
#include <gtest/gtest.h>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

constexpr sim::Time kClk = 50'000;  // 20 MHz in ps
constexpr sim::Time kStep = 7'000;  // of the phases
const char kEncoder26[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF\ntimeout = \"adaptive\"";

// Sends 0x07 and `byte` so that its last rising SCLK edge comes at `when`.
void instruct_at(Chip& chip, std::uint8_t byte, sim::Time when) {
  const auto& timing = chip.simulator.spi().timing();
  const sim::Time before = 16 * timing.sclk_low + 15 * timing.sclk_high;
  ASSERT_GT(when, chip.simulator.now() + before);
  chip.simulator.run_until(when - before);
  chip.instruct(byte);
}

// Table 37: frames come at their clock, for any change of INSTR at any time.
TEST(ChipInstrPhase, ChangedUnderAgs_ShiftsNoFrame) {
  Chip chip(one_slave(kEncoder26));
  chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x09);  // 10 us
  chip.instruct(reg::kAgsOn);
  auto& monitor = clocked(chip.simulator.line(1))->monitor();
  chip.advance_us(35);
  const sim::Time period = 200 * kClk;
  const sim::Time first = monitor.last(chip.simulator.now()).start;
  for (sim::Time phase = 0; phase < 10 * kClk; phase += kStep) {
    const sim::Time due = first + ((chip.simulator.now() - first) / period + 2) * period;
    instruct_at(chip, (phase / kStep) % 2 == 0 ? 0x05 : 0x03, due - 8 * kClk + phase);
    chip.simulator.run_until(due + period / 2);
    EXPECT_EQ(monitor.last(chip.simulator.now()).start, due) << "phase " << phase << " ps";
  }
  EXPECT_EQ(chip.status(), reg::kResetStatus0);
}

// docs/choices.md: after BREAK and AGS in one byte the first frame is due a whole period later, so
// that a slave that was left in a frame has time to end it.
TEST(ChipInstrPhase, BreakWithAgs_NextFrameIsAPeriodLater) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x63);
  chip.instruct(reg::kAgsOn);
  auto& monitor = clocked(chip.simulator.line(1))->monitor();
  chip.advance_us(350);
  const sim::Time before = monitor.last(chip.simulator.now()).start;
  instruct_at(chip, reg::kBreakAbort | reg::kAgsOn, before + 160 * sim::kPsPerUs);
  const sim::Time byte = before + 160 * sim::kPsPerUs;
  chip.advance_us(110);
  const sim::Time after = monitor.last(chip.simulator.now()).start;
  // In addition: the time of the byte to the core (ChipInstrTiming) and half a period of MA.
  EXPECT_GE(after, byte + 2000 * kClk);
  EXPECT_LE(after, byte + 2006 * kClk);
}

// Table 54: EOT = 0 is a frame. Between two of them INSTR may change without it.
TEST(ChipInstrPhase, ChangedUnderAgs_LeavesPinEotHigh) {
  Chip chip(one_slave(kEncoder26));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x63);  // 100 us
  chip.instruct(reg::kAgsOn);
  const auto eot_is = [&](bool level, sim::Time us) {
    return chip.simulator.run_while_waiting(
        [&] { return chip.simulator.pin(sim::Pin::kEot) == level; },
        chip.simulator.now() + us * sim::kPsPerUs);
  };
  ASSERT_TRUE(eot_is(false, 110));
  ASSERT_TRUE(eot_is(true, 10));
  for (unsigned i = 0; i < 20; ++i) {
    const std::uint8_t bytes[] = {0x05, 0x03, 0x43, 0x01, 0x07};
    chip.instruct(bytes[i % 5]);
    EXPECT_FALSE(eot_is(false, 2)) << i;
    chip.simulator.advance(kStep);
  }
  EXPECT_TRUE(eot_is(false, 110)) << "the next frame";
}

// The host writes the same INSTR again around the end of its frame. A write before the end asks for
// nothing; a later one asks for another frame. INSTR clears itself in both cases.
TEST(ChipInstrPhase, SameCodeAtTheEndOfItsFrame_IsOneFrameMoreOrNone) {
  bool none = false;
  bool one = false;
  Chip chip(one_slave(kEncoder26));
  chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  // How long a frame takes from its byte to pin EOT.
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  chip.advance_us(10);
  const sim::Time begin = chip.simulator.now() / kClk * kClk + 100 * kClk;
  instruct_at(chip, reg::kInstrCdm0, begin);
  ASSERT_TRUE(chip.wait_eot());
  const sim::Time length = chip.simulator.now() - begin;
  for (sim::Time phase = 0; phase < 20 * kClk; phase += kStep) {
    chip.advance_us(10);
    const auto frames = chip.simulator.slave(1)->frames();
    const sim::Time start = chip.simulator.now() / kClk * kClk + 100 * kClk;
    instruct_at(chip, reg::kInstrCdm0, start);
    instruct_at(chip, reg::kInstrCdm0, start + length - 14 * kClk + phase);
    chip.advance_us(20);
    EXPECT_EQ(chip.read(reg::kAddrInstr), 0) << "phase " << phase << " ps";
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
    const auto more = chip.simulator.slave(1)->frames() - frames - 1;
    EXPECT_LE(more, 1U) << "phase " << phase << " ps";
    EXPECT_TRUE(more == 0 ? !one : true) << "no frame after phases that gave one: " << phase;
    none = none || more == 0;
    one = one || more == 1;
  }
  EXPECT_TRUE(none && one) << "the phases reach from one side to the other";
}

// FREQAGS = AGSMIN: a frame waits for SL = 1. The same INSTR, written while the frame waits or just
// when it starts, asks for no second frame.
TEST(ChipInstrPhase, SameCodeAtTheStartOfItsFrame_IsOneFrame) {
  Chip chip(one_slave(kEncoder26));
  chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  for (sim::Time phase = 0; phase < 12 * kClk; phase += kStep) {
    const auto frames = chip.simulator.slave(1)->frames();
    clocked(chip.simulator.line(1))->faults().stick(false);
    chip.simulator.refresh_lines();
    chip.advance_us(1);
    chip.instruct(reg::kInstrCdm0);
    const sim::Time release = chip.simulator.now() / kClk * kClk + 40 * kClk;
    chip.simulator.at(release, [&chip] {
      clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
      chip.simulator.refresh_lines();
    });
    instruct_at(chip, reg::kInstrCdm0, release - 8 * kClk + phase);
    chip.advance_us(20);
    EXPECT_EQ(chip.simulator.slave(1)->frames(), frames + 1) << "phase " << phase << " ps";
    EXPECT_EQ(chip.read(reg::kAddrInstr), 0);
    EXPECT_EQ(chip.status(), reg::kResetStatus0);
  }
}

// The code that stands in INSTR under AGSINFINITE, written again while INIT runs: its frame is
// over, so it asks for another one.
TEST(ChipInstrPhase, SameCodeDuringInit_IsAFrameAfterIt) {
  Chip chip(one_slave(kEncoder26));
  chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x03, reg::kFreqagsAgsInfinite);
  chip.instruct(reg::kInstrCdm0 | reg::kAgsOn);
  chip.instruct(reg::kInitStart | reg::kInstrCdm0 | reg::kAgsOn);  // INIT waits for the frame
  ASSERT_TRUE(chip.simulator.run_while_waiting(
      [&] { return clocked(chip.simulator.line(1))->monitor().frames() == 2; }, sim::kPsPerSecond));
  chip.instruct(reg::kInstrCdm0 | reg::kAgsOn);
  EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kInitStart | reg::kInstrCdm0 | reg::kAgsOn);
  chip.advance_us(100);
  EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kInstrCdm0 | reg::kAgsOn);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 2U) << "beside the INIT";
  EXPECT_EQ(clocked(chip.simulator.line(1))->monitor().frames(), 3U);
}

}  // namespace
