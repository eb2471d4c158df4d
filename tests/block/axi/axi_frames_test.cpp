// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A channel with the sampler by frames: when it answers, what it sends more, what it says of the
// eye, and where it leaves the word to the sampler by the acknowledge.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "Vaxi_channel.h"
#include "Vaxi_channel_frames.h"
#include "tests/block/axi/axi_frames_bench.hpp"
#include "tests/support/dice.hpp"

namespace mb4test {
namespace {

using Line = AxiFrames<Vaxi_channel_frames>;
using PlainLine = AxiFrames<Vaxi_channel>;

// The instant at which the last CRC bit has ended at the pin: an edge of MA, and the delay.
std::int64_t end_of_word(const Line& line) {
  const std::size_t last = 4 + line.slave.busy + line.slave.payload.size();
  return static_cast<std::int64_t>(line.rises.at(last - 1)) * Line::kUnit + line.delay;
}

TEST(AxiFramesBlock, AnyLengthAndDivider_WordIsGoodAndComesIn) {
  Dice dice;
  double most = 0;
  for (unsigned half = 5; half <= 10; ++half) {
    for (unsigned bits = 1; bits <= 64; ++bits) {
      Line line(bits, half);
      for (int i = 0; i < 6; ++i) {
        line.delay = line.period() * dice.below(121) / 10 + dice.below(Line::kUnit);
        line.slave.busy = dice.below(4);
        const std::uint64_t sent =
            (std::uint64_t{dice.below(1U << 31U)} << 33U | dice.below(1U << 31U)) &
            (bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1);
        line.frame(sent);
        ASSERT_TRUE(line.good()) << bits << " bits, " << 2 * half << " clocks";
        ASSERT_EQ(line.position(), sent);
        // From the start bit to the last one of the CRC.
        const double word = static_cast<double>(line.slave.payload.size()) + 1;
        const double clocks =
            static_cast<double>(static_cast<std::int64_t>(line.answered) * Line::kUnit -
                                end_of_word(line)) /
            Line::kUnit;
        ASSERT_GT(clocks, 0);
        ASSERT_LE(clocks, bits < 8 ? 26 : word + 9) << bits << " bits, " << 2 * half << " clocks";
        if (bits >= 26) {
          ASSERT_LE(clocks, 1.2 * word) << bits << " bits";
          most = std::max(most, clocks / word);
        }
      }
    }
  }
  std::printf("answer at most %.2f clocks for each bit behind the last one, from 26 bits on\n",
              most);
}

// An encoder that needs as long as START_LIMIT allows: the ring has gone round twice.
TEST(AxiFramesBlock, EncoderBusyFor1000Periods_WordIsGood) {
  Line line(26, 5);
  line.slave.busy = 1000;
  for (std::uint64_t sent : {0U, 0x3FFFFFFU, 0x1234567U}) {
    line.frame(sent);
    EXPECT_TRUE(line.good());
    EXPECT_EQ(line.position(), sent);
    EXPECT_EQ(line.eye(), line.expected());
  }
}

// hello-fpga manual, F tests: MA has 5 rising edges, the processing clocks, and all bits; here one
// more. The next frame can come at most 1 us later at 10 MHz.
TEST(AxiFramesBlock, OneEdgeMore_NextFrameAtMost1UsLater) {
  for (const unsigned busy : {0U, 3U, 20U}) {
    for (const unsigned delay : {0U, 7U, 95U}) {
      Line line(26, 5);
      PlainLine plain(26, 5);
      line.slave.busy = plain.slave.busy = busy;
      line.delay = plain.delay = delay * Line::kUnit;
      line.frame(0x2345678);
      const std::uint64_t with = line.now() - line.started;
      plain.frame(0x2345678);
      const std::uint64_t without = plain.now() - plain.started;
      ASSERT_TRUE(line.good() && plain.good());
      if (delay == 0) {
        EXPECT_EQ(plain.rises.size(), 5U + busy + 26 + 2 + 6);
      }
      EXPECT_EQ(line.rises.size(), plain.rises.size() + 1) << busy << " " << delay;
      EXPECT_EQ(line.delay_told(), delay);
      EXPECT_EQ(plain.delay_told(), delay);
      EXPECT_LE(with, without + 100) << busy << " " << delay;
      EXPECT_GT(with, without);
    }
  }
}

// With jitter the start bit may be missed once: then there are two.
TEST(AxiFramesBlock, Jitter_AtMostTwoEdgesMore) {
  Dice dice;
  Line line(26, 5);
  line.jitter = [&] { return line.period() * 55 / 100 * dice.below(4096) / 4096; };
  line.delay = 13 * Line::kUnit;
  unsigned two = 0;
  for (int i = 0; i < 3000; ++i) {
    line.slave.busy = 2;
    line.frame(dice.below(1U << 26U));
    ASSERT_TRUE(line.good());
    const std::size_t edges = 5 + 2 + 26 + 2 + 6;
    ASSERT_GE(line.rises.size(), edges);
    ASSERT_LE(line.rises.size(), edges + 2 + 2);
    two += line.rises.size() > edges + 1 ? 1 : 0;
  }
  std::printf("%u of 3000 frames with more than one edge more\n", two);
}

// The eye is what jitter leaves of the period, within a clock.
TEST(AxiFramesBlock, Eye_AgreesWithTheJitter) {
  Dice dice;
  for (const unsigned half : {5U, 7U, 10U}) {
    for (unsigned percent = 0; percent <= 50; percent += 5) {
      Line line(26, half);
      line.jitter = [&] { return line.period() * percent / 100 * dice.below(4096) / 4096; };
      unsigned smallest = 31;
      double sum = 0;
      for (int i = 0; i < 100; ++i) {
        line.delay = line.period() * dice.below(121) / 10 + dice.below(Line::kUnit);
        line.frame(dice.below(1U << 26U));
        ASSERT_TRUE(line.good());
        const Eye eye = line.eye();
        ASSERT_TRUE(eye.valid);
        ASSERT_EQ(eye, line.expected());
        smallest = std::min(smallest, eye.width);
        sum += eye.width;
      }
      const double free = 2.0 * half * (100 - percent) / 100;
      EXPECT_LE(std::abs(smallest - free), 1.0) << percent << " %, " << 2 * half << " clocks";
      EXPECT_LE(std::abs(sum / 100 - free), half == 5 ? 1.0 : 2.0) << percent << " %";
    }
  }
}

// A pulse of one or two clocks anywhere between two edges: the same word, the same eye.
TEST(AxiFramesBlock, StrayPulse_DoesNotMoveThePoint) {
  Dice dice;
  unsigned tried = 0;
  for (unsigned round = 0; round < 40; ++round) {
    std::vector<std::int64_t> moves;
    for (int i = 0; i < 80; ++i) moves.push_back(dice.below(3 * Line::kUnit));
    const std::uint64_t sent = dice.below(1U << 26U);
    Line line(26, 5);
    std::size_t next = 0;
    line.jitter = [&] { return moves[next++]; };
    line.delay = line.period() * dice.below(121) / 10;
    line.slave.busy = dice.below(6);
    line.frame(sent);
    ASSERT_TRUE(line.good());
    const Eye eye = line.eye();
    const std::vector<std::int64_t> edges = line.edges;
    const auto begun = static_cast<std::int64_t>(line.started);
    for (std::int64_t at = edges.front() / Line::kUnit; at < edges.back() / Line::kUnit; ++at) {
      const unsigned clocks = 1 + dice.below(2);
      bool free = true;  // at least three clocks to any edge
      for (const std::int64_t edge : edges)
        free &= edge / Line::kUnit + 3 < at || at + clocks + 3 < edge / Line::kUnit;
      if (!free) continue;
      next = 0;
      line.glitch(line.now() + 1 + static_cast<std::uint64_t>(at - begun), clocks);
      line.frame(sent);
      ++tried;
      ASSERT_TRUE(line.good() && line.position() == sent) << "pulse at " << at - begun;
      ASSERT_EQ(line.eye(), eye) << "pulse at " << at - begun;
    }
  }
  EXPECT_GT(tried, 1000U);
}

// A frame that is ended at any instant by the channel enable, a soft reset or a reset: the next one
// is as good, and its eye is its own.
TEST(AxiFramesBlock, FrameThatIsEnded_LeavesNothingBehind) {
  Dice dice;
  Line line(26, 5);
  line.jitter = [&] { return line.period() * 45 / 100 * dice.below(4096) / 4096; };
  for (int round = 0; round < 600; ++round) {
    line.delay = line.period() * dice.below(121) / 10 + dice.below(Line::kUnit);
    line.slave.busy = dice.below(10);
    line.slave.payload = "0" + bits_of(dice.below(1U << 28U), 28) + bits_of(dice.below(64), 6);
    line.m.start_i = 1;
    line.clock();
    line.m.start_i = 0;
    const unsigned instant = dice.below(700);
    for (unsigned i = 0; i < instant; ++i) line.clock();
    switch (dice.below(3)) {
      case 0:
        line.m.enabled_i = 0;
        break;
      case 1:
        line.m.clear_i = 1;
        break;
      default:
        line.reset();
    }
    line.clock();
    line.m.enabled_i = 1;
    line.m.clear_i = 0;
    for (unsigned i = 0; line.m.busy_o != 0 && i < 6000; ++i) line.clock();
    ASSERT_EQ(line.m.busy_o, 0);
    EXPECT_EQ(line.eye(), Eye{});
    const std::uint64_t sent = dice.below(1U << 26U);
    line.frame(sent);
    ASSERT_TRUE(line.good() && line.position() == sent) << round;
    ASSERT_EQ(line.eye(), line.expected()) << round;
  }
}

TEST(AxiFramesBlock, OtherDividers_AreLeftToTheAcknowledge) {
  namespace at = places::axi_pkg::eye_t;
  for (const unsigned half : {1U, 2U, 4U, 11U, 12U, 20U, 21U, 26U, 50U, 255U}) {
    Line line(26, half);
    PlainLine plain(26, half);
    line.delay = plain.delay = 3 * Line::kUnit;
    line.frame(0x1357924);
    plain.frame(0x1357924);
    EXPECT_TRUE(line.good()) << half;
    EXPECT_EQ(line.position(), 0x1357924U);
    EXPECT_EQ(line.eye(), Eye{});
    EXPECT_EQ(at::kUsed.of(line.m.eye_o), 0U);
    EXPECT_EQ(line.rises.size(), plain.rises.size()) << half;
  }
  EXPECT_EQ(at::kUsed.of(Line(26, 5).m.eye_o), 1U);
  EXPECT_EQ(at::kUsed.of(Line(26, 10).m.eye_o), 1U);
  EXPECT_EQ(at::kUsed.of(PlainLine(26, 5).m.eye_o), 0U);
}

TEST(AxiFramesBlock, NoWord_NoEyeAndNoOldOne) {
  for (int kind = 0; kind < 5; ++kind) {
    Line line(26, 5);
    line.frame(77);
    ASSERT_TRUE(line.eye().valid);
    switch (kind) {
      case 0:  // unplugged
        line.silent = true;
        line.frame(77);
        break;
      case 1:  // disabled
        line.m.enabled_i = 0;
        line.clock();
        break;
      case 2:  // soft reset
        line.m.clear_i = 1;
        line.clock();
        break;
      case 3:  // SLO is 0 at the start
        line.arrive_now(false);
        for (int i = 0; i < 20; ++i) line.clock();
        line.m.start_i = 1;
        line.clock();
        line.m.start_i = 0;
        break;
      case 4: {  // unplugged in the frame: SLO is 1 from then on
        line.cut_at = line.now() + 200;
        line.frame(0);
        EXPECT_FALSE(line.good());
        EXPECT_TRUE(line.crc_bad());
        // The frame has come to its end, and its eye is that of what came. The next one has none.
        EXPECT_EQ(line.eye(), line.expected());
        line.frame(0);
        EXPECT_FALSE(line.good());
        break;
      }
    }
    line.m.eval();
    EXPECT_EQ(line.eye(), Eye{}) << kind;
  }
}

}  // namespace
}  // namespace mb4test
