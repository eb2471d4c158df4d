// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// INIT after BREAK or a reset has cut something. The slaves may still be in their frame or timeout
// then (decision 46; pages 16, 32, 33).
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

constexpr sim::Time kPeriod = 50 * sim::kPsPerNs;  // T of CLK at 20 MHz

// 100 ns a period of MA, so 25 ns a sampling point: 237 ns are ten of them.
constexpr char kDelay[] = "delay_ns = 237.0";
constexpr unsigned kDelayPoints = 0x0A;
constexpr std::array<unsigned, 3> kTimeoutsUs{2, 20, 38};

std::string slave_with(unsigned timeout_us, const std::string& data = "0xAAF37BF") {
  return "data_bits = 28\ncrc = 0x43\ndata = " + data +
         "\ntimeout = " + std::to_string(timeout_us) + ".0";
}

std::string register_slave(unsigned timeout_us) {
  return slave_with(timeout_us) + "\nregisters = { 0x00 = [0x12] }";
}

struct CutChip : Chip {
  explicit CutChip(unsigned timeout_us, const std::string& keys = "", std::uint8_t freqags = 0x00)
      : Chip(one_slave(keys.empty() ? slave_with(timeout_us) : keys, kDelay)) {
    simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
    simulator.bus().set_timing({});
    configure_slave1(28, reg::kScrclenCrc6, 0x00, freqags);
    advance_us(100);  // the reset is long ago
  }
  const sim::MaMonitor& monitor() { return clocked(simulator.line(1))->monitor(); }
  // INIT has ended, with the right line delay, without an error, and MA has rested before it.
  void expect_init(const std::string& what) {
    ASSERT_TRUE(wait_eot(1000)) << what;
    EXPECT_EQ(status(), reg::kResetStatus0) << what;
    EXPECT_EQ(read(reg::kAddrInstr), 0) << what;
    EXPECT_EQ(read(reg::kAddrScdata), kDelayPoints) << what;
    EXPECT_EQ(monitor().last(simulator.now()).rising, 2U) << what;
  }
};

// Page 33: "the measured line delay"; decision 46, each phase of a frame and of the timeout.
TEST(ChipInitCut, BehindABreakInAFrame_MeasuresTheDelayInEachPhase) {
  constexpr int kOneByte = -1;
  for (const unsigned timeout_us : kTimeoutsUs) {
    for (const int gap_us : {kOneByte, 0, 10, 30, 60}) {
      // 4.4 us of a frame in steps of 130 ns, then its timeout.
      for (unsigned phase = 0; phase < 54; ++phase) {
        const sim::Time at =
            phase < 36 ? phase * 130 * sim::kPsPerNs
                       : 4680 * sim::kPsPerNs + (phase - 36U) * timeout_us * sim::kPsPerUs / 17;
        CutChip chip(timeout_us);
        chip.instruct(reg::kInstrCdm0);
        chip.simulator.advance(at);
        if (gap_us == kOneByte) {
          chip.instruct(reg::kBreakAbort | reg::kInitStart);
        } else {
          chip.instruct(reg::kBreakAbort);
          chip.simulator.advance(static_cast<sim::Time>(gap_us) * sim::kPsPerUs);
          chip.instruct(reg::kInitStart);
        }
        EXPECT_EQ(chip.read(reg::kAddrInstr), reg::kInitStart) << "waits, or runs";
        chip.expect_init("timeout " + std::to_string(timeout_us) + " us, gap " +
                         std::to_string(gap_us) + ", phase " + std::to_string(phase));
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

// A word of ones leaves SL at 1 in the middle of the frame: SL tells nothing of the slave, and only
// the rest of MA counts.
TEST(ChipInitCut, SlIsHighInTheSlavesFrame_InitWaitsFor1024Clocks) {
  for (unsigned phase = 0; phase < 22; ++phase) {
    CutChip chip(38, slave_with(38, "0xFFFFFFF"));
    chip.instruct(reg::kInstrCdm0);
    chip.simulator.advance((900 + phase * 90) * sim::kPsPerNs);
    chip.instruct(reg::kBreakAbort | reg::kInitStart);
    chip.advance_us(1);
    const sim::Time rest = chip.monitor().last(chip.simulator.now()).last_edge;
    chip.expect_init(std::to_string(phase));
    const auto clocks = (chip.monitor().last(chip.simulator.now()).start - rest) / kPeriod;
    EXPECT_GE(clocks, 1024U) << phase;
    EXPECT_LE(clocks, 1024U + 40U) << phase;
    if (testing::Test::HasFailure()) return;
  }
}

// The 1,024 T count from the return of SL to 1.
TEST(ChipInitCut, SlLowInTheTimeout_TheClocksCountFromItsReturn) {
  CutChip chip(38);
  chip.instruct(reg::kInstrCdm0);
  chip.advance_us(5);
  ASSERT_FALSE(chip.simulator.pin(sim::Pin::kSl1)) << "the slave's timeout";
  chip.instruct(reg::kBreakAbort | reg::kInitStart);
  ASSERT_TRUE(chip.simulator.run_while_waiting([&] { return chip.simulator.pin(sim::Pin::kSl1); },
                                               chip.simulator.now() + 60 * sim::kPsPerUs));
  const sim::Time high = chip.simulator.now();
  chip.expect_init("");
  const auto clocks = (chip.monitor().last(chip.simulator.now()).start - high) / kPeriod;
  EXPECT_GE(clocks, 1024U);
  EXPECT_LE(clocks, 1024U + 40U);
}

// Page 32: "the last slave may not be defined and the SLx line is digital low. An initialisation
// sequence started by INIT can be used": the wait has an end, 2,048 T of SL = 0.
TEST(ChipInitCut, SlStaysLow_InitComesAfter2048Clocks) {
  CutChip chip(38);
  chip.instruct(reg::kInstrCdm0);
  chip.advance_us(2);
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.instruct(reg::kBreakAbort | reg::kInitStart);
  const sim::Time start = chip.simulator.now();
  const auto frames = chip.monitor().frames();
  ASSERT_TRUE(chip.simulator.run_while_waiting(
      [&] { return chip.monitor().frames() == frames + 1; }, start + 400 * sim::kPsPerUs));
  EXPECT_NEAR(static_cast<double>((chip.simulator.now() - start) / kPeriod), 2048, 40);
  ASSERT_TRUE(chip.wait_eot(500));
  EXPECT_EQ(chip.status(), reg::kResetStatus0) << "page 33: SL = 0 is no error";
}

// Times from the write of INIT to the first edge of MA.
sim::Time wait_of_init(Chip& chip, bool same_byte) {
  auto& monitor = clocked(chip.simulator.line(1))->monitor();
  const auto frames = monitor.frames();
  if (!same_byte) chip.instruct(reg::kBreakAbort);
  chip.instruct(same_byte ? reg::kBreakAbort | reg::kInitStart : reg::kInitStart);
  const sim::Time start = chip.simulator.now();
  EXPECT_TRUE(chip.simulator.run_while_waiting([&] { return monitor.frames() > frames; },
                                               start + 200 * sim::kPsPerUs));
  const sim::Time wait = chip.simulator.now() - start;
  EXPECT_TRUE(chip.wait_eot());
  return wait;
}

// Decision 46: a BREAK that cut nothing delays nothing, a second one neither, and none is left of
// a wait that is over.
TEST(ChipInitCut, BreakThatCutNothing_DelaysNothing) {
  for (const bool same_byte : {false, true}) {
    CutChip chip(2);
    EXPECT_LT(wait_of_init(chip, same_byte), sim::kPsPerUs) << "idle chip";
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot());
    chip.advance_us(10);
    EXPECT_LT(wait_of_init(chip, same_byte), sim::kPsPerUs) << "after a frame and its timeout";
    chip.instruct(reg::kInstrCdm0);
    chip.advance_us(1);
    chip.instruct(reg::kBreakAbort);
    chip.advance_us(70);
    EXPECT_LT(wait_of_init(chip, same_byte), sim::kPsPerUs) << "long after one that cut";
    // The wait of the first BREAK goes on, and the second one adds nothing to it.
    chip.instruct(reg::kInstrCdm0);
    chip.advance_us(1);
    chip.instruct(reg::kBreakAbort);
    const sim::Time cut = chip.simulator.now();
    chip.advance_us(40);
    const sim::Time wait = chip.simulator.now() - cut + wait_of_init(chip, same_byte);
    EXPECT_NEAR(static_cast<double>(wait / kPeriod), 1024, 100);
  }
}

// BREAK cuts INIT, its wait for the slaves, and an access between two of its frames.
TEST(ChipInitCut, BreakInInitOrAccess_TheNextInitWaits) {
  for (unsigned phase = 0; phase < 40; ++phase) {
    CutChip chip(20);
    chip.instruct(reg::kInitStart);
    chip.simulator.advance(phase < 20 ? phase * 47 * sim::kPsPerNs : phase * sim::kPsPerUs / 2);
    chip.instruct(reg::kBreakAbort | reg::kInitStart);
    chip.expect_init("INIT, phase " + std::to_string(phase));
    if (testing::Test::HasFailure()) return;
  }
  CutChip chip(2, register_slave(2), 0x63);  // 100 us
  chip.write(reg::kAddrRegadr, {0x00, 0x00});
  chip.write(reg::kAddrCtrl, {reg::kCtsRegisterAccess | reg::kRegversBissC});
  chip.instruct(reg::kInstrControl | reg::kAgsOn);
  chip.advance_us(250);  // 30 us after the second frame's timeout
  const auto frames = chip.monitor().frames();
  ASSERT_GE(frames, 2U);
  chip.instruct(reg::kBreakAbort | reg::kInitStart);
  chip.advance_us(45);
  EXPECT_EQ(chip.monitor().frames(), frames) << "the access has been cut";
  chip.expect_init("access");
}

// Frames of AGS after the BREAK: INIT waits for their end too.
TEST(ChipInitCut, FramesAfterTheBreak_InitWaitsForRest) {
  for (unsigned phase = 0; phase < 40; ++phase) {
    CutChip chip(5, "", 0x09);  // 10 us
    chip.instruct(reg::kAgsOn);
    chip.simulator.advance((50'000 + phase * 700) * sim::kPsPerNs);
    chip.instruct(reg::kBreakAbort | reg::kAgsOn);
    chip.simulator.advance(phase * 700 * sim::kPsPerNs);
    chip.instruct(reg::kInitStart);
    unsigned polls = 0;
    while ((chip.read(reg::kAddrInstr) & reg::kInitStart) != 0) ASSERT_LT(++polls, 1000U) << phase;
    EXPECT_EQ(chip.status() & reg::nAGSERR::kMask, reg::kNagserrGood) << phase;
    EXPECT_EQ(chip.read(reg::kAddrScdata), kDelayPoints) << phase;
    if (testing::Test::HasFailure()) return;
  }
}

// A brother: NRES in the slave's frame, then INIT as soon as the host has configured the chip.
TEST(ChipInitCut, BehindAReset_MeasuresTheDelayInEachPhase) {
  for (const unsigned timeout_us : kTimeoutsUs) {
    for (unsigned phase = 0; phase < 40; ++phase) {
      CutChip chip(timeout_us);
      chip.instruct(reg::kInstrCdm0);
      chip.simulator.advance(phase * 160 * sim::kPsPerNs);
      chip.simulator.set_pin(sim::Pin::kNres, false);
      chip.simulator.advance(200 * sim::kPsPerNs);
      chip.simulator.set_pin(sim::Pin::kNres, true);
      chip.simulator.advance(300 * sim::kPsPerNs);
      chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, 0x00);
      chip.instruct(reg::kInitStart);
      chip.expect_init("timeout " + std::to_string(timeout_us) + " us, phase " +
                       std::to_string(phase));
      if (testing::Test::HasFailure()) return;
    }
  }
}

}  // namespace
