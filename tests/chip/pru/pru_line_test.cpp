// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The start bit of every lateness, the edges of MA, and lines on which nobody answers.
#include <algorithm>
#include <string>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/chip/pru/pru_sim.hpp"

namespace mb4test {
namespace {

std::string encoder(const std::string& channel, unsigned bits, const std::string& slave) {
  return "[[channel]]\nnumber = 1\n" + channel +
         "[[channel.slave]]\nprotocol = \"biss-c\"\ncrc = 0x43\ndata_bits = " +
         std::to_string(bits + 2) + "\n" + slave;
}
const std::string kRamp = "source = \"ramp\"\nstart = 100\nstep = 5\n";

// P-6. Up to the limit of 40 us the processing time is exact, above it the frame is dropped.
TEST(PruLine, StartBitOfEveryLateness_IsCountedUpToTheLimit) {
  for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
    const unsigned limit = 40 * mhz;
    for (unsigned late = 0; late <= limit + 1; ++late) {
      SCOPED_TRACE(std::to_string(mhz) + " MHz, " + std::to_string(late) + " periods");
      PruSim pru(pru_scenario(
          encoder("delay_ns = 130\n", 12, kRamp + "busy_periods = " + std::to_string(late) + "\n"),
          80'000'000));
      const PruFrame run = pru.start(12, 8, mhz);
      const PruFrame frame = pru.frame();
      ASSERT_EQ(frame.processing(), late);
      ASSERT_EQ(frame.flags(), late > limit ? kPruLate : 0U);
      if (late > limit) {
        ASSERT_EQ(frame.position, run.position);
        ASSERT_EQ(frame.crc(), run.crc());
      } else {
        ASSERT_EQ(frame.position, frame.sent >> 2U);
        ASSERT_EQ(frame.ma_rises, 5 + 12 + 8 + late);
      }
    }
  }
}

// R-P13: whatever the line delay.
TEST(PruLine, EdgesOfMa_DoNotDependOnTheLineDelay) {
  for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
    for (const unsigned periods : {0U, 1U, 12U}) {
      for (const unsigned late : {0U, 3U}) {
        for (const unsigned bits : {1U, 13U, 23U, 55U}) {
          SCOPED_TRACE(std::to_string(mhz) + " MHz, " + std::to_string(periods) + " periods, " +
                       std::to_string(late) + " late, " + std::to_string(bits) + " bits");
          const unsigned delay_ns = periods == 0 ? 0 : periods * 1000 / mhz - 40;
          PruSim pru(pru_scenario(encoder("delay_ns = " + std::to_string(delay_ns) + "\n", bits,
                                          "busy_periods = " + std::to_string(late) + "\n")));
          pru.start(bits, 8, mhz, 200);
          const std::uint64_t word = 0x5A3C'9687'1E2D'4B59 & ((std::uint64_t{1} << bits) - 1);
          pru.simulator.slave(1)->set_data(word << 2U | 3U);
          const PruFrame frame = pru.frame();
          // The start bit may come behind the edge that would have been the last; MA cannot know.
          EXPECT_GE(frame.ma_rises, 5 + bits + 8 + late);
          EXPECT_LE(frame.ma_rises, 5 + bits + 8 + late + (bits + 8 > periods ? 0U : 2U));
          EXPECT_EQ(frame.position, word);
          EXPECT_EQ(frame.processing(), late);
          // An acknowledge without any delay comes behind rising edge 2.
          EXPECT_EQ(frame.line_delay(), std::max(1U, periods) + (mhz == 10 ? 2U : 0U));
          EXPECT_EQ(frame.flags(), 0U);
        }
      }
    }
  }
}

// R-P15, in the middle of frames at each rate, and the frame after is good without the host.
TEST(PruLine, NobodyAnswers_IsToldAndTheNextFrameIsGood) {
  for (const unsigned mhz : {1U, 2U, 5U, 10U}) {
    for (const char* what : {"unplugged", "low", "high"}) {
      SCOPED_TRACE(std::to_string(mhz) + " MHz, " + what);
      const bool low = std::string(what) == "low";
      PruSim pru(pru_scenario(encoder("delay_ns = 200\n", 14, kRamp)));
      pru.start(14, 8, mhz);
      PruFrame good;
      for (unsigned i = 0; i < 6; ++i) good = pru.frame();
      sim::ClockedLine& line = *clocked(pru.simulator.line(1));
      if (std::string(what) == "unplugged") {
        pru.simulator.inject("[[fault]]\nkind = \"unplug\"\nslave = 1\nat_us = 0\nfor_us = 310\n");
      } else {
        line.faults().stick(!low);
        pru.simulator.refresh_lines();
      }
      const unsigned n = 3 + 14 + 8;
      for (unsigned i = 0; i < 3; ++i) {
        const PruFrame none = pru.frame();
        EXPECT_EQ(none.position, good.position);
        EXPECT_EQ(none.crc(), good.crc());
        EXPECT_EQ(none.flags(), kPruNoSlave | (mhz == 10 ? 0U : kPruAverage));
        EXPECT_EQ(none.raw(), low ? 0x00U : 0xFFU);
        EXPECT_EQ(none.ma_rises, low ? 0U : 2 + n);
        EXPECT_EQ(none.line_delay(), low ? good.line_delay() : n + (mhz == 10 ? 2U : 0U));
        EXPECT_EQ(none.processing(), 0U);
        EXPECT_EQ(none.count, good.count + 1 + i);
        EXPECT_EQ(none.irq & prureg::FRAME_ENDED::kMask, 1U);
        EXPECT_EQ((none.irq & prureg::ERROR::kMask) != 0, i == 0);  // the flag rose once
        EXPECT_EQ(none.latch == good.latch, low);
      }
      if (std::string(what) != "unplugged") {
        line.faults().stick({});
        pru.simulator.refresh_lines();
        pru.simulator.advance(60 * sim::kPsPerUs);  // what the encoder had begun is over
      } else {
        pru.simulator.advance(60 * sim::kPsPerUs);
      }
      const PruFrame again = pru.frame();
      EXPECT_EQ(again.flags() & ~kPruAverage, 0U);
      EXPECT_EQ(again.position, again.sent >> 2U);
      EXPECT_GT(again.position, good.position);
    }
  }
}

// R-P5, and the rate counts from the frame behind the one that runs.
TEST(PruLine, Frequency_IsReadBehindEachFrame) {
  PruSim pru(pru_scenario(encoder("", 12, kRamp)));
  const auto period_of = [&pru] {
    const std::uint32_t first = pru.frame().latch;
    return pru.frame().latch - first;
  };
  pru.start(12, 8, 0);  // no legal value yet: 1 MHz
  EXPECT_EQ(period_of(), 20'000U);
  const auto microseconds = [&pru] {
    // From rising edge 1 to the update less OVERHEAD: 25 periods of MA.
    const PruFrame frame = pru.frame();
    const std::uint32_t now = pru.read(prureg::kAddrTimeLow);
    return (now - frame.latch) / 200.0 - 27;
  };
  EXPECT_NEAR(microseconds(), 24, 1.5);
  for (const unsigned code : {2U, 10U, 5U, 7U, 0U, 255U, 1U}) {
    pru.write(prureg::kAddrLengths, code << 16U, 4);
    pru.frame();
    const bool legal = code == 1 || code == 2 || code == 5 || code == 10;
    const unsigned mhz = legal ? code : 5;
    EXPECT_NEAR(microseconds(), 24.0 / mhz, 1.5) << code;
  }
}

}  // namespace
}  // namespace mb4test
