// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What the host tells the master and hears of it: RUN and its 40 us, the timer, triggers that are
// lost, times, a limit that changes while a frame runs.
#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "tests/chip/pru/pru_sim.hpp"

namespace mb4test {
namespace {

constexpr std::uint32_t kMhz = 200;  // clocks of a microsecond

std::string encoder(unsigned bits, const std::string& slave = "") {
  return "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\ncrc = 0x43\n"
         "data_bits = " +
         std::to_string(bits + 2) + "\n" + slave;
}

// Rising edges of MA, as clocks since the simulation began.
std::uint64_t next_rise(PruSim& pru) {
  const sim::Pin ma = *pru.simulator.pin_by_name("ma_o");
  bool before = pru.simulator.pin(ma);
  EXPECT_TRUE(pru.simulator.run_while_waiting(
      [&] {
        const bool level = pru.simulator.pin(ma);
        const bool rises = level && !before;
        before = level;
        return rises;
      },
      pru.simulator.now() + 5'000 * sim::kPsPerUs));
  return pru.simulator.clk_cycles();
}

// R-P4: 40 us, a frame at 1 MHz, and the timer starts with it.
TEST(PruHost, Run_Waits40MicrosecondsAndStartsTheTimer) {
  for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
    PruSim pru(pru_scenario(encoder(12)));
    pru.write(prureg::kAddrLengths, 12U | 8U << 8U | mhz << 16U);
    pru.write(prureg::kAddrIrqEnable, prureg::FRAME_ENDED_ENABLE::kMask);
    pru.write(prureg::kAddrRun, 1);
    const std::uint64_t run = pru.simulator.clk_cycles();
    const std::uint64_t first = next_rise(pru);
    // The first rise comes a period of 1 MHz behind the start.
    EXPECT_NEAR(static_cast<double>(first - run), 41.0 * kMhz, 10);
    const PruFrame of_run = pru.frame();
    const PruFrame second = pru.frame();
    const double periods = 100 + 1.0 / mhz - 1;  // 100 us behind the start of the first
    EXPECT_NEAR(second.latch - of_run.latch, periods * kMhz, 2) << mhz;
    EXPECT_EQ(pru.frame().latch - second.latch, 100 * kMhz);
  }
}

// The first frame of each RUN has 1 MHz, whatever the frames of the one before had.
TEST(PruHost, EachRun_BeginsAt1Mhz) {
  PruSim pru(pru_scenario(encoder(12)));
  for (unsigned turn = 0; turn < 3; ++turn) {
    pru.write(prureg::kAddrRun, 0);
    pru.write(prureg::kAddrLengths, 12U | 8U << 8U | 10U << 16U);
    pru.write(prureg::kAddrRun, 1);
    const std::uint64_t run = pru.simulator.clk_cycles();
    std::uint64_t rise = next_rise(pru);
    EXPECT_NEAR(static_cast<double>(rise - run), 41.0 * kMhz, 10) << turn;
    for (unsigned i = 0; i < 10; ++i) {
      EXPECT_EQ(next_rise(pru) - rise, kMhz) << turn;
      rise += kMhz;
    }
    pru.simulator.advance(500 * sim::kPsPerUs);  // frames at 10 MHz
  }
}

// LATCH_TIME is TIME_LOW of the first rising edge of MA.
TEST(PruHost, LatchTime_IsTheTimeOfTheFirstEdge) {
  PruSim pru(pru_scenario(encoder(12)));
  pru.start(12, 8, 5);
  const std::uint64_t edge = next_rise(pru);
  // The value of an access is that of a clock within it.
  const std::uint64_t before = pru.simulator.clk_cycles();
  const std::uint32_t time = pru.read(prureg::kAddrTimeLow);
  const std::uint64_t after = pru.simulator.clk_cycles();
  ASSERT_LT(after - before, 12U);
  const std::uint32_t latch = pru.read(prureg::kAddrLatchTime);
  EXPECT_GE(time - latch, before - edge);
  EXPECT_LE(time - latch, after - edge);
}

// R-P10: a frame that is longer than the period starts the next one at once; the triggers between
// are lost.
TEST(PruHost, FrameLongerThanThePeriod_StartsTheNextOneAtOnce) {
  PruSim pru(pru_scenario(encoder(53)));
  const auto lost = [](const PruFrame& frame) { return (frame.irq & prureg::LOST::kMask) != 0; };
  pru.start(53, 8, 1, 1000);
  EXPECT_FALSE(lost(pru.frame()));
  PruFrame before = pru.frame();
  EXPECT_FALSE(lost(before));
  EXPECT_NE(before.irq & prureg::TRIGGER::kMask, 0U);
  pru.write(prureg::kAddrTriggerPeriod, 30 * kMhz);
  pru.frame();
  before = pru.frame();
  for (unsigned i = 0; i < 5; ++i) {
    const PruFrame frame = pru.frame();
    EXPECT_TRUE(lost(frame));
    EXPECT_EQ(frame.flags() & ~kPruAverage, 0U);
    // 66 periods to the last bit, 27 us, and some clocks.
    EXPECT_NEAR(frame.latch - before.latch, (65.0 + 27.0) * kMhz, 2.0 * kMhz);
    before = frame;
  }
  // A host that does not clear FRAME_ENDED loses a frame, and is told so too.
  pru.write(prureg::kAddrTriggerPeriod, 200 * kMhz);
  pru.frame();
  pru.frame();
  pru.simulator.advance(500 * sim::kPsPerUs);
  EXPECT_TRUE(lost(pru.frame()));
}

// A limit that the host writes while a frame runs is that of the next one.
TEST(PruHost, ProcTimeMaxWhileAFrameWaits_CountsFromTheNextOne) {
  for (const unsigned busy : {300U, 900U}) {
    PruSim pru(pru_scenario(encoder(12, "busy_periods = " + std::to_string(busy) + "\n")));
    pru.write(prureg::kAddrProcTimeMax, 1000);
    EXPECT_EQ(pru.start(12, 8, 1, 2000).processing(), busy);
    next_rise(pru);
    pru.simulator.advance(30 * sim::kPsPerUs);
    pru.write(prureg::kAddrProcTimeMax, 10);
    const PruFrame own = pru.frame();
    EXPECT_EQ(own.processing(), busy);
    EXPECT_EQ(own.flags(), 0U);
    const PruFrame next = pru.frame();
    EXPECT_EQ(next.processing(), 11U);
    EXPECT_EQ(next.flags(), kPruLate);
  }
}

// The next interrupt; nothing is read.
void wait_for_frame(PruSim& pru) {
  pru.write(prureg::kAddrIrqStatus, 0x1F);
  const sim::Pin irq = *pru.simulator.pin_by_name("irq_o");
  EXPECT_TRUE(pru.simulator.run_while_waiting([&] { return pru.simulator.pin(irq); },
                                              pru.simulator.now() + 5'000 * sim::kPsPerUs));
}

// Reading POS_HI keeps POS_LO for one read of it, whatever frames come in between and whatever else
// is read.
TEST(PruHost, PosHi_KeepsPosLoForOneRead) {
  PruSim pru(pru_scenario(encoder(50, "source = \"ramp\"\nstart = 0x2_FFFF_FF00\nstep = 77\n")));
  const auto position = [&pru] { return *pru.simulator.slave(1)->sent_word() >> 2U; };
  pru.start(50, 8, 5, 150);
  for (unsigned i = 0; i < 8; ++i) {
    const std::uint64_t before = position();
    EXPECT_EQ(pru.read(prureg::kAddrPosHi), before >> 32U);
    for (unsigned frames = i % 3; frames != 0; --frames) wait_for_frame(pru);
    pru.read(prureg::kAddrStatus);
    EXPECT_EQ(pru.read(prureg::kAddrPosLo), before & 0xFFFF'FFFFU) << i;
    EXPECT_EQ(pru.read(prureg::kAddrPosLo), position() & 0xFFFF'FFFFU) << i;
    wait_for_frame(pru);
  }
}

// R-P20 and R-P13: lengths out of range, as the edges of MA tell them.
TEST(PruHost, LengthsOutOfRange_ActAsTheNearestThatFit) {
  struct Row {
    unsigned data, tail, bits;  // bits: of position, nE, nW and CRC
  };
  for (const Row& row :
       {Row{0, 0, 1}, Row{0, 8, 9}, Row{1, 8, 9}, Row{20, 32, 52}, Row{20, 33, 52},
        Row{20, 255, 52}, Row{55, 8, 63}, Row{56, 8, 63}, Row{64, 8, 63}, Row{255, 8, 63},
        Row{63, 0, 63}, Row{64, 0, 63}, Row{128, 0, 63}, Row{255, 255, 63}}) {
    PruSim pru(pru_scenario(encoder(53)));
    pru.start(row.data, row.tail, 5, 200);
    const PruFrame frame = pru.frame();
    EXPECT_EQ(frame.ma_rises, 5 + row.bits + frame.processing()) << row.data << ' ' << row.tail;
  }
}

// A byte without its strobe keeps its value, also where a register has one byte.
TEST(PruHost, ByteWithoutItsStrobe_KeepsItsValue) {
  PruSim pru(pru_scenario(encoder(12)));
  pru.start(12, 8, 5);
  pru.write(prureg::kAddrRun, 0, 0xE);
  pru.write(prureg::kAddrIrqEnable, 0, 0xE);
  EXPECT_EQ(pru.read(prureg::kAddrRun), 1U);
  EXPECT_EQ(pru.read(prureg::kAddrIrqEnable), prureg::FRAME_ENDED_ENABLE::kMask);
  wait_for_frame(pru);
  pru.write(prureg::kAddrIrqStatus, 0x1F, 0xE);
  EXPECT_NE(pru.read(prureg::kAddrIrqStatus) & prureg::FRAME_ENDED::kMask, 0U);
}

// Between two triggers, and behind the end of RUN, no event comes.
TEST(PruHost, BetweenTwoTriggers_NoEvent) {
  PruSim pru(pru_scenario(encoder(12)));
  pru.start(12, 8, 5, 1000);
  pru.frame();
  pru.simulator.advance(300 * sim::kPsPerUs);
  EXPECT_EQ(pru.read(prureg::kAddrIrqStatus), 0U);
  pru.write(prureg::kAddrRun, 0);
  pru.write(prureg::kAddrIrqStatus, 0x1F);
  pru.simulator.advance(2'000 * sim::kPsPerUs);
  EXPECT_EQ(pru.read(prureg::kAddrIrqStatus), 0U);
}

// Clocks from one change of the memory to the next one, while triggers wait: each frame starts at
// once.
class PruFramesInARow {
 public:
  explicit PruFramesInARow(PruSim& pru) : pru_(pru) { next(); }
  std::uint64_t next() {
    wait_for_frame(pru_);
    const std::uint64_t before = std::exchange(now_, pru_.simulator.clk_cycles());
    return now_ - before;
  }

 private:
  PruSim& pru_;
  std::uint64_t now_ = 0;
};

// FREQUENCY acts from the frame two behind the one that it was written in, also where triggers wait
// already, and from its first clock on.
TEST(PruHost, FrequencyWhileTriggersWait_ActsTwoFramesLaterAndWhole) {
  PruSim pru(pru_scenario(encoder(12)));
  pru.start(12, 8, 2, 10);
  pru.frame();
  PruFramesInARow frames(pru);
  const std::uint64_t slow = frames.next();
  EXPECT_NEAR(static_cast<double>(slow), (25.5 / 2 + 27) * kMhz, 0.5 * kMhz);  // 25 periods, 27 us
  pru.write(prureg::kAddrLengths,
            prureg::DATA_LENGTH::of(12) | prureg::CRC_ERR_WAR::of(8) | prureg::FREQUENCY::of(10));
  EXPECT_EQ(frames.next(), slow);  // it was running
  const std::uint64_t quick = frames.next();
  EXPECT_NEAR(static_cast<double>(quick), (25.5 / 10 + 27) * kMhz, 0.1 * kMhz);
  for (unsigned i = 0; i < 3; ++i) EXPECT_EQ(frames.next(), quick);
}

// R-P17: a word that the host writes in the clock in which another one is taken, or in any clock
// beside it, is neither lost nor mixed with that one.
TEST(PruHost, ControlWordWrittenBesideTheTake_IsSentWhole) {
  constexpr std::uint32_t kWrite06To60 = 0x8C16C194;
  constexpr std::uint32_t kWrite5ATo61 = 0x8C30D680;
  constexpr sim::Time kClock = sim::kPsPerUs / kMhz;
  constexpr unsigned kPeriodUs = 100;
  unsigned replaced = 0;
  unsigned behind = 0;
  for (unsigned clock = 0; clock < 24; ++clock) {
    PruSim pru(pru_scenario(encoder(12, "registers = { 0x60 = 1, 0x61 = 1, 0x62 = 1 }\n")));
    pru.start(12, 8, 10, kPeriodUs);
    pru.frame();
    wait_for_frame(pru);
    const sim::Time told = pru.simulator.now();
    pru.write(prureg::kAddrIrqStatus, 0x1F);
    pru.write(prureg::kAddrCtrl, kWrite06To60);
    // The next frame's end takes it; irq_o tells that some clocks later.
    pru.simulator.advance(told + kPeriodUs * sim::kPsPerUs - (24 - clock) * kClock -
                          pru.simulator.now());
    pru.write(prureg::kAddrCtrl, kWrite5ATo61);
    pru.simulator.advance(110 * kPeriodUs * sim::kPsPerUs);
    const auto byte = [&pru](std::uint8_t address) {
      return unsigned{pru.simulator.slave(1)->reg_read(address)};
    };
    ASSERT_TRUE(byte(0x60) == 1 || byte(0x60) == 6) << clock;
    (byte(0x60) == 1 ? replaced : behind) += 1;
    EXPECT_EQ(byte(0x61), 0x5AU) << clock;
    EXPECT_EQ(byte(0x62), 1U) << clock;
    EXPECT_EQ(pru.read(prureg::kAddrCtrl), 0U) << clock;
  }
  EXPECT_GT(replaced, 4U);
  EXPECT_GT(behind, 4U);
}

// A trigger in the 40 us of RUN is lost and told; a period that becomes smaller than what has
// passed ends at once; 1 acts as 2.
TEST(PruHost, TriggersThatDoNotFit_DoWhatThePageSays) {
  PruSim pru(pru_scenario(encoder(12)));
  const sim::Pin pin = *pru.simulator.pin_by_name("trigger_i");
  pru.write(prureg::kAddrLengths, 12U | 8U << 8U | 5U << 16U);
  pru.write(prureg::kAddrTriggerPeriod, 0);
  pru.write(prureg::kAddrRun, 1);
  pru.simulator.advance(10 * sim::kPsPerUs);
  EXPECT_EQ(pru.read(prureg::kAddrIrqStatus), 0U);
  pru.simulator.set_pin(pin, true);
  pru.simulator.advance(sim::kPsPerUs);
  EXPECT_EQ(pru.read(prureg::kAddrIrqStatus), prureg::LOST::kMask);
  pru.simulator.advance(300 * sim::kPsPerUs);
  EXPECT_EQ(pru.read(prureg::kAddrFrameCount), 1U);  // that of RUN alone
  pru.write(prureg::kAddrIrqEnable, prureg::FRAME_ENDED_ENABLE::kMask);

  pru.write(prureg::kAddrTriggerPeriod, 5000 * kMhz);
  pru.simulator.advance(700 * sim::kPsPerUs);
  EXPECT_EQ(pru.read(prureg::kAddrFrameCount), 1U);
  pru.write(prureg::kAddrTriggerPeriod, 500 * kMhz);
  pru.simulator.advance(100 * sim::kPsPerUs);
  EXPECT_EQ(pru.read(prureg::kAddrFrameCount), 2U);
  for (const unsigned period : {1U, 2U}) {
    pru.write(prureg::kAddrTriggerPeriod, period);
    pru.simulator.advance(1000 * sim::kPsPerUs);
    pru.write(prureg::kAddrIrqStatus, 0x1F);
    pru.simulator.advance(100 * sim::kPsPerUs);
    EXPECT_NE(pru.read(prureg::kAddrIrqStatus) & prureg::LOST::kMask, 0U) << period;
  }
}

// OVERHEAD counts clocks behind the last sample, of which the first four always pass.
TEST(PruHost, Overhead_MovesTheMemoryByClocks) {
  std::uint64_t least = 0;
  for (const unsigned overhead : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 200U, 10'000U}) {
    PruSim pru(pru_scenario(encoder(12)));
    pru.write(prureg::kAddrOverhead, overhead);
    pru.start(12, 8, 5, 200);
    pru.frame();
    const std::uint64_t rise = next_rise(pru);
    wait_for_frame(pru);
    const std::uint64_t clocks = pru.simulator.clk_cycles() - rise;
    if (overhead == 0) least = clocks;
    EXPECT_EQ(clocks - least, std::max(overhead, 4U) - 4U) << overhead;
  }
  // 24 periods from the first edge of MA to the last bit, the sample within its period, and some
  // clocks.
  EXPECT_NEAR(static_cast<double>(least), 24.5 / 5 * kMhz, 0.5 / 5 * kMhz + 10);
}

}  // namespace
}  // namespace mb4test
