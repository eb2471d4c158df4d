// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The top biss_axi with numbers of channels that the simulator has no model for: three channels, and
// five with stream mode 1 and a longer TIMEOUT_LIMIT.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "Vbiss_axi_3.h"
#include "Vbiss_axi_beats.h"
#include "tests/block/axi/biss_axi_bench.hpp"

namespace {

namespace reg = biss_axi::regs;
using mb4test::Dice;
using Three = mb4test::BissAxiBench<Vbiss_axi_3, 3>;
using Beats = mb4test::BissAxiBench<Vbiss_axi_beats, 5>;

constexpr unsigned kBits = 12;

// F-3 with three channels.
TEST(BissAxiTop, ThreeChannels_OneBeatWithAllWordsAndTheirDelays) {
  Dice dice;
  Three bench;
  for (int round = 0; round < 60; ++round) {
    const unsigned bits = 1 + dice.below(32);
    const unsigned divider = 2 + dice.below(6);
    bench.set_up(bits, divider, 60);
    std::vector<std::uint64_t> sent;
    for (unsigned c = 0; c < 3; ++c) {
      sent.push_back((std::uint64_t{dice.below(0x10000)} << 16 | dice.below(0x10000)) &
                     ((std::uint64_t{1} << bits) - 1));
      bench.set_word(c, sent.back(), bits);
      bench.encoders[c].delay = dice.below(120);
      bench.encoders[c].slave.busy = dice.below(5);
    }
    bench.clocks(130);
    bench.frame(1500);
    ASSERT_EQ(bench.beats.size(), 1U) << round;
    EXPECT_EQ(bench.beats[0].words, sent) << round;
    EXPECT_EQ(bench.beats[0].user, 7U) << round;
    EXPECT_TRUE(bench.beats[0].last);
    EXPECT_EQ(bench.read(reg::kAddrSinglePointValid), 7U);
    for (unsigned c = 0; c < 3; ++c) {
      EXPECT_EQ(bench.read(c, reg::kAddrLineDelay), bench.encoders[c].delay);
      EXPECT_EQ(bench.read(c, reg::kAddrSinglePointData), sent[c]);
    }
    EXPECT_EQ(bench.read(3, reg::kAddrSinglePointData), 0U) << "no channel 3";
  }
}

// Edges of the sample clock come while the beats of the frame before are made.
TEST(BissAxiTop, BeatsWhileStartsCome_AreThoseOfTheirFrame) {
  Beats bench;
  bench.set_up(kBits, 1, 20);
  bench.encoders[0].wire = Beats::Wire::kHigh;  // ends its frame last, and rests at once
  for (unsigned c = 1; c < 5; ++c) bench.set_word(c, 0x100 + c, kBits);
  bench.write(reg::kAddrSampleDivider, 1);
  bench.write(reg::kAddrMode, 0);
  bench.beats.clear();
  bench.clocks(12'000);
  ASSERT_GT(bench.beats.size(), 45U);
  bench.beats.resize(45);
  for (unsigned i = 0; i < 45; ++i) {
    const mb4test::AxiBeat& beat = bench.beats[i];
    const unsigned channel = i % 5;
    EXPECT_EQ(beat.user >> 8, channel) << i;
    EXPECT_EQ(beat.last, channel == 4) << i;
    EXPECT_EQ(beat.user & 1U, channel == 0 ? 0U : 1U) << i;
    EXPECT_EQ(beat.words[0], channel == 0 ? 0U : 0x100 + channel) << i;
  }
}

// 3.9: SLO = 0 after a begun frame holds starts back for TIMEOUT_LIMIT clocks, here 8000, and no
// longer.
TEST(BissAxiTop, LineStuckLowInAFrame_HoldsStartsBackForTheLimit) {
  Beats bench;
  bench.set_up(kBits, 4, 100);
  for (unsigned c = 0; c < 5; ++c) bench.set_word(c, 0x100 + c, kBits);
  bench.write(reg::kAddrSampleClock, 1);
  bench.write(reg::kAddrMode, 0);
  bench.m.ext_sample_clk = 1;
  bench.clocks(20);
  while (bench.encoders[0].rises.size() < 10) bench.clock();
  bench.encoders[2].wire = Beats::Wire::kLow;
  bench.beats.clear();
  while (bench.beats.empty()) bench.clock();
  const std::uint64_t ended = bench.now;
  const std::size_t edges = bench.encoders[0].falls.size();
  for (int i = 0; i < 12'000 && bench.encoders[0].falls.size() == edges; ++i) {
    bench.m.ext_sample_clk = i / 4 % 2 != 0 ? 1 : 0;
    bench.clock();
  }
  EXPECT_NEAR(static_cast<double>(bench.now - ended), 8000, 40);
}

// A soft reset, or a channel that is disabled, in a word whose bits are 1: SLO does not show that the
// encoder has not ended its frame. The channel holds starts back for as long as a timeout can last.
TEST(BissAxiTop, FrameThatWasEnded_HoldsStartsBackForTheLimit) {
  for (const bool soft : {true, false}) {
    Three bench;
    bench.set_up(kBits, 5, 1500);
    for (unsigned c = 0; c < 3; ++c) bench.set_word(c, 0xFFF, kBits);
    bench.request();
    while (bench.encoders[1].rises.size() < 10) bench.clock();
    if (soft) {
      bench.write(reg::kAddrSoftReset, 1);
      bench.write(reg::kAddrSoftReset, 0);
    } else {
      bench.write(reg::kAddrChannelEnable, 0b101);
      bench.clocks(400);  // the others end their frames
      bench.write(reg::kAddrChannelEnable, 0b111);
    }
    const std::uint64_t ended = bench.now;
    const std::size_t falls = bench.encoders[1].falls.size();
    while (bench.encoders[1].falls.size() <= falls + 1 && bench.now < ended + 6000) {
      bench.request();
      bench.clocks(40);
    }
    EXPECT_NEAR(static_cast<double>(bench.now - ended), soft ? 4000 : 3600, 100) << soft;
    bench.clocks(3000);
    for (unsigned c = 0; c < 3; ++c) EXPECT_EQ(bench.read(c, reg::kAddrSinglePointData), 0xFFFU);
  }
}

}  // namespace
