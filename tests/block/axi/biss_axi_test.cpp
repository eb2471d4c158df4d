// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The top biss_axi with numbers of channels that the simulator has no model for: three channels,
// five with stream mode 1 and a longer TIMEOUT_LIMIT, two with extras and 64 bits of stream mode 1,
// and two with POR_PIN and ALIGN_LATCH.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "Vbiss_axi_3.h"
#include "Vbiss_axi_beats.h"
#include "Vbiss_axi_full.h"
#include "Vbiss_axi_por.h"
#include "tests/block/axi/biss_axi_bench.hpp"

namespace {

namespace reg = biss_axi::regs;
using mb4test::Dice;
using Three = mb4test::BissAxiBench<Vbiss_axi_3, 3>;
using Beats = mb4test::BissAxiBench<Vbiss_axi_beats, 5>;
using Full = mb4test::BissAxiBench<Vbiss_axi_full, 2>;
using Por = mb4test::BissAxiBench<Vbiss_axi_por, 2>;

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
    EXPECT_EQ(bench.m.irq, 0) << "of the page, which it does not have";
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

// A sink that stops: frames are lost whole, STREAM_STATUS and LOST say so.
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
  EXPECT_EQ(bench.read(reg::kAddrStreamStatus), 2U << 16U | 1U);
  EXPECT_EQ(bench.read(reg::kAddrIrqStatus), 0x10U);
  bench.m.s_axis_tready = 1;
  bench.beats.clear();
  bench.clocks(20);
  ASSERT_EQ(bench.beats.size(), 4U);  // 3 in the FIFO, one at the output
  for (unsigned i = 0; i < 4; ++i) EXPECT_EQ(bench.beats[i].last, i % 2 != 0);
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

// axi_aresetn at any clock of a frame, and a start 0 to 3 us after it, while the encoder's timeout
// is 20 us: no word of the old frame comes as good. Without POR_PIN the reset cuts low pulses of
// MA, with it none.
template <typename Bench>
void reset_in_frames(unsigned channels, bool por_pin, std::uint64_t& good) {
  constexpr unsigned kHalf = 5;
  Dice dice;
  Bench bench;
  unsigned cut = 0;
  for (int round = 0; round < 150; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round << " por_pin " << por_pin);
    std::vector<std::uint64_t> sent;
    const auto new_words = [&](unsigned ones) {
      sent.clear();
      for (unsigned c = 0; c < channels; ++c) {
        sent.push_back(ones != 0 ? 0xFFF : dice.below(0x1000));
        bench.set_word(c, sent.back(), kBits);
      }
    };
    const auto set_up = [&] {
      bench.set_up(kBits, kHalf, 2000);
      if (round % 2 != 0) bench.write(reg::kAddrCrcCheck, 0);
    };
    new_words(dice.below(2));
    set_up();
    bench.clocks(4100);
    for (auto& encoder : bench.encoders) {
      encoder.rises.clear();
      encoder.falls.clear();
    }
    bench.frame(dice.below(350));
    bench.m.axi_aresetn = 0;
    bench.clocks(1 + dice.below(20));
    bench.m.axi_aresetn = 1;
    bench.beats.clear();
    set_up();
    bench.clocks(dice.below(300));
    bench.request();
    bench.clocks(800);
    for (const mb4test::AxiBeat& beat : bench.beats) EXPECT_EQ(beat.user, 0U) << "a wrong word";
    for (const auto& encoder : bench.encoders) {
      ASSERT_EQ(encoder.rises.size(), encoder.falls.size()) << "MA rests at 1";
      for (std::size_t i = 0; i < encoder.falls.size(); ++i) {
        if (encoder.rises[i] - encoder.falls[i] < kHalf) ++cut;
        if (i != 0) {
          EXPECT_GE(encoder.falls[i] - encoder.rises[i - 1], kHalf);
        }
      }
    }
    bench.clocks(3500);
    new_words(0);
    bench.frame(900);
    ASSERT_EQ(bench.beats.size(), 1U);
    EXPECT_EQ(bench.beats[0].user, (1U << channels) - 1);
    EXPECT_EQ(bench.beats[0].words.size(), por_pin ? 1U : channels);
    good += bench.beats.size();
  }
  if (por_pin) {
    EXPECT_EQ(cut, 0U);
  } else {
    EXPECT_GT(cut, 0U);
  }
}

TEST(BissAxiTop, ResetInAFrame_BringsNoWrongWord) {
  std::uint64_t good = 0;
  reset_in_frames<Three>(3, false, good);
  reset_in_frames<Por>(2, true, good);
  EXPECT_EQ(good, 300U);
}

// A sink that stops at random, five channels of which any are enabled, 16 beats in the FIFO. Each
// packet is a frame, in order; what is missing was lost, and the page has counted it.
// MB4_AXI_PACKETS: frames.
template <typename Bench>
void packets_of(unsigned channels, bool page, std::uint64_t frames) {
  Dice dice;
  Bench bench;
  bench.set_up(kBits, 1, 20);
  std::uint64_t lost = 0, whole = 0, packets = 0, counted = 0;
  unsigned stop = 0;
  std::uint64_t next = 0;  // the oldest frame that the next packet may be
  std::uint64_t last = 0;  // the newest one that has begun
  std::vector<std::uint64_t> enables(4096);
  std::vector<mb4test::AxiBeat> packet;
  const auto clocks = [&](unsigned count) {
    for (; count != 0; --count) {
      if (stop == 0 && dice.below(600) == 0) stop = dice.below(4000);
      bench.m.s_axis_tready = stop != 0 ? 0 : dice.below(8) != 0 ? 1 : 0;
      if (stop != 0) --stop;
      bench.clock();
    }
    for (mb4test::AxiBeat& beat : bench.beats) {
      packet.push_back(beat);
      if (!beat.last) continue;
      ++packets;
      // The word is the frame's number, modulo 4096.
      const std::uint64_t number = packet[0].words[0];
      while (next <= last && next % 4096 != number) {
        ++next;
        ++lost;
      }
      ASSERT_LE(next, last) << "no frame " << number << ": out of order";
      std::size_t place = 0;
      for (unsigned c = 0; c < channels; ++c) {
        if ((enables[number] >> c & 1U) == 0) continue;
        ASSERT_LT(place, packet.size()) << "frame " << next << " is short";
        ASSERT_EQ(packet[place].user, c << 8U | 7U) << "frame " << next;
        ASSERT_EQ(packet[place].words[0], number);
        ASSERT_EQ(packet[place].last, place + 1 == packet.size());
        ++place;
      }
      ASSERT_EQ(place, packet.size()) << "frame " << next << " is long";
      ++next;
      ++whole;
      packet.clear();
    }
    bench.beats.clear();
  };
  for (last = 0; last < frames; ++last) {
    const unsigned enable = 1 + dice.below((1U << channels) - 1);
    enables[last % 4096] = enable;
    for (unsigned c = 0; c < channels; ++c) bench.set_word(c, last % 4096, kBits);
    bench.write(reg::kAddrChannelEnable, enable);
    bench.request();
    ASSERT_NO_FATAL_FAILURE(clocks(140 + dice.below(60)));
  }
  --last;
  stop = 0;
  for (int i = 0; i < 200; ++i) {
    bench.m.s_axis_tready = 1;
    bench.clock();
  }
  stop = 1;
  ASSERT_NO_FATAL_FAILURE(clocks(1));
  EXPECT_TRUE(packet.empty());
  lost += last + 1 - next;
  if (page) {
    counted = bench.read(reg::kAddrStreamStatus) >> 16U;
    EXPECT_EQ(counted, lost & 0xFFFF);
  }
  EXPECT_EQ(whole + lost, frames);
  EXPECT_GT(lost, frames / 50);
  EXPECT_GT(whole, frames / 50);
  std::printf("%llu frames: %llu packets, %llu whole, %llu frames lost\n",
              static_cast<unsigned long long>(frames), static_cast<unsigned long long>(packets),
              static_cast<unsigned long long>(whole), static_cast<unsigned long long>(lost));
}

TEST(BissAxiTop, SinkThatStopsAtRandom_GetsWholePackets) {
  const char* text = std::getenv("MB4_AXI_PACKETS");
  const std::uint64_t frames = text != nullptr ? std::strtoull(text, nullptr, 0) : 2000;
  packets_of<Beats>(5, false, frames / 2);
  packets_of<Full>(2, true, frames / 2);
}

}  // namespace
