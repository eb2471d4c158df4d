// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The top biss_axi with numbers of channels that the simulator has no model for: three channels,
// five with stream mode 1 and a longer TIMEOUT_LIMIT, and two with extras and 64 bits of stream
// mode 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "Vbiss_axi_3.h"
#include "Vbiss_axi_beats.h"
#include "Vbiss_axi_full.h"
#include "tests/block/axi/biss_axi_bench.hpp"

namespace {

namespace reg = biss_axi::regs;
using mb4test::Dice;
using Three = mb4test::BissAxiBench<Vbiss_axi_3, 3>;
using Beats = mb4test::BissAxiBench<Vbiss_axi_beats, 5>;
using Full = mb4test::BissAxiBench<Vbiss_axi_full, 2>;

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

// A soft reset, or a channel that is disabled, in a word whose bits are 1: SLO does not show that
// the encoder has not ended its frame. The channel holds starts back for as long as a timeout can
// last.
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

// Extras: 64 bits of position and a CRC of 16 bits, one beat of 64 bits for each channel.
TEST(BissAxiTop, PositionsOf64Bits_ComeInOneBeat) {
  Dice dice;
  Full bench;
  EXPECT_EQ(bench.read(reg::kAddrFeatures), 2U << 16U | 1U << 9U | 0xFFU);
  for (int round = 0; round < 40; ++round) {
    const unsigned bits = round < 8 ? 64 : 1 + dice.below(64);
    const std::uint32_t polynomial = round % 2 != 0 ? 0x190D9 : 0x43;
    bench.set_up(bits, 2 + dice.below(4), 60);
    bench.write(reg::kAddrCrcPolynomial, polynomial);
    std::uint64_t sent[2];
    for (unsigned c = 0; c < 2; ++c) {
      sent[c] = 0;
      for (int part = 0; part < 4; ++part) sent[c] = sent[c] << 16 | dice.below(0x10000);
      sent[c] = bits == 64 ? sent[c] : sent[c] & ((std::uint64_t{1} << bits) - 1);
      bench.set_word(c, sent[c], bits, 3 - c, polynomial);
      bench.encoders[c].delay = dice.below(100);
    }
    bench.clocks(130);
    bench.frame(1500);
    ASSERT_EQ(bench.beats.size(), 2U) << round;
    for (unsigned c = 0; c < 2; ++c) {
      EXPECT_EQ(bench.beats[c].words[0], sent[c]) << round << " bits " << bits;
      const unsigned flags = c == 0 ? 6U : 2U;  // nW, nE
      EXPECT_EQ(bench.beats[c].user, c << 8U | flags | 1U);
      EXPECT_EQ(bench.read(c, reg::kAddrSinglePointData), static_cast<std::uint32_t>(sent[c]));
      EXPECT_EQ(bench.read(c, reg::kAddrPositionHigh), static_cast<std::uint32_t>(sent[c] >> 32U));
    }
  }
}

// A sink that stops: beats are lost, STREAM_STATUS and LOST say so.
TEST(BissAxiTop, SinkThatStops_IsTold) {
  Full bench;
  bench.set_up(kBits, 2, 60);
  for (unsigned c = 0; c < 2; ++c) bench.set_word(c, 0x100 + c, kBits);
  bench.m.s_axis_tready = 0;
  for (int i = 0; i < 2; ++i) bench.frame(400);
  EXPECT_EQ(bench.read(reg::kAddrStreamStatus), 0U);
  bench.write(reg::kAddrIrqStatus, 0x1F);
  for (int i = 0; i < 2; ++i) {
    bench.frame(400);
    bench.write(reg::kAddrIrqStatus, 1);
  }
  EXPECT_EQ(bench.read(reg::kAddrStreamStatus), 1U);
  EXPECT_EQ(bench.read(reg::kAddrIrqStatus), 0x10U);
  bench.m.s_axis_tready = 1;
  bench.beats.clear();
  bench.clocks(20);
  EXPECT_EQ(bench.beats.size(), 5U);  // 4 in the FIFO, one at the output
}

// A cable that gets longer while frames run.
TEST(BissAxiTop, DelayThatMoves_IsAnAlarm) {
  Full bench;
  bench.set_up(kBits, 5, 200);
  for (unsigned c = 0; c < 2; ++c) bench.set_word(c, 0x100 + c, kBits);
  bench.encoders[1].delay = 40;
  bench.clocks(50);
  bench.frame(1500);
  bench.write(reg::kAddrDelayTolerance, 2);
  for (unsigned c = 0; c < 2; ++c) {
    const std::uint32_t delay = bench.read(c, reg::kAddrLineDelay);
    bench.write(reg::kAddrDelayReference, delay | 1U << 31U);
  }
  bench.write(reg::kAddrIrqEnable, 2);
  for (const unsigned delay : {40U, 42U, 38U, 43U}) {
    EXPECT_EQ(bench.read(reg::kAddrDelayAlarm), 0U) << delay;
    EXPECT_EQ(bench.m.irq, 0);
    bench.encoders[1].delay = delay;
    bench.frame(1500);
  }
  EXPECT_EQ(bench.read(reg::kAddrDelayAlarm), 2U);
  EXPECT_EQ(bench.m.irq, 1);
}

}  // namespace
