// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The stream of the BiSS C master on AXI in mode 1 with five channels and a FIFO of 16 beats.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <vector>

#include "Vaxi_stream_beats.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

using mb4test::Block;
using Stream = Block<Vaxi_stream_beats>;

constexpr unsigned kChannels = 5;

struct Beat {
  std::uint32_t data;
  std::uint32_t user;
  bool last;
  bool operator==(const Beat&) const = default;
};

// Position, and 3 crc_bad, 2 nwarn, 1 nerr, 0 good.
void set_word(Vaxi_stream_beats& m, unsigned channel, std::uint32_t position, unsigned flags) {
  using namespace mb4test::places::axi_pkg::word_t;
  kPosition.in(channel, kAllBits).set(m.words_i, position);
  kCrcBad.in(channel, kAllBits).set(m.words_i, flags >> 3U);
  kNwarn.in(channel, kAllBits).set(m.words_i, flags >> 2U);
  kNerr.in(channel, kAllBits).set(m.words_i, flags >> 1U);
  kGood.in(channel, kAllBits).set(m.words_i, flags);
}

void begin(Stream& stream) {
  auto& m = stream.model;
  m.clear_i = m.done_i = 0;
  m.enabled_i = 0;
  m.s_axis_tready = 1;
  for (auto& word : m.words_i.m_storage) word = 0;
  for (auto& word : m.mores_i.m_storage) word = 0;
  stream.reset();
}

// 3.9: tuser 0 valid, 1 nE, 2 nW, 3 CRC error, 15..8 channel; tlast at the last.
TEST(AxiStreamBlock, RandomReadsAndSinks_GiveOneBeatForEachEnabledChannelInOrder) {
  mb4test::Dice dice;
  const auto random = [&] { return dice.below(0x1000'0000); };
  for (const unsigned busy : {0U, 50U, 80U}) {  // per cent of clocks without TREADY
    Stream stream;
    auto& m = stream.model;
    begin(stream);
    std::deque<Beat> expected;
    unsigned beats = 0;
    const auto clock = [&] {
      m.s_axis_tready = random() % 100 >= busy ? 1 : 0;
      m.eval();
      if (m.s_axis_tvalid != 0 && m.s_axis_tready != 0) {
        ASSERT_FALSE(expected.empty());
        EXPECT_EQ((Beat{m.s_axis_tdata, m.s_axis_tuser, m.s_axis_tlast != 0}), expected.front());
        expected.pop_front();
        ++beats;
      }
      EXPECT_EQ(m.overrun_o, 0);
      stream.clock();
    };
    for (unsigned read = 0; read < 500; ++read) {
      const unsigned enabled = random() % 31 + 1;
      m.enabled_i = static_cast<std::uint8_t>(enabled);
      for (unsigned c = 0; c < kChannels; ++c) {
        const auto position = random();
        const unsigned flags = random() % 16;
        set_word(m, c, position, flags);
        if ((enabled >> c & 1U) != 0) {
          expected.push_back({position, c << 8U | flags, (enabled >> (c + 1)) == 0});
        }
      }
      EXPECT_EQ(m.busy_o, 0);
      m.done_i = 1;
      clock();
      m.done_i = 0;
      // The words must stay for one clock a channel.
      for (unsigned i = 0; i < 60; ++i) {
        EXPECT_EQ(m.busy_o, i < kChannels);
        if (m.busy_o == 0) {
          for (unsigned c = 0; c < kChannels; ++c) set_word(m, c, random(), random() % 16);
        }
        clock();
      }
    }
    EXPECT_GT(beats, 1000U);
  }
}

TEST(AxiStreamBlock, SinkThatStops_LosesNewFramesAndSaysSo) {
  Stream stream;
  auto& m = stream.model;
  begin(stream);
  m.enabled_i = 1;
  m.s_axis_tready = 0;
  unsigned overruns = 0;
  for (unsigned read = 0; read < 20; ++read) {
    set_word(m, 0, read, 1);
    m.done_i = 1;
    stream.clock();
    m.done_i = 0;
    for (unsigned i = 0; i < 10; ++i) {
      overruns += m.overrun_o;
      stream.clock();
    }
  }
  EXPECT_EQ(overruns, 20U - 17U);  // 16 in the FIFO, one at the output
  m.s_axis_tready = 1;
  std::vector<std::uint32_t> seen;
  for (unsigned i = 0; i < 40; ++i) {
    m.eval();
    if (m.s_axis_tvalid != 0) seen.push_back(m.s_axis_tdata);
    stream.clock();
  }
  ASSERT_EQ(seen.size(), 17U);
  for (unsigned i = 0; i < 17; ++i) EXPECT_EQ(seen[i], i);
}

// A frame goes into the FIFO of 16 beats whole or not at all, whatever the sink does. Enables and
// soft resets that come between the end of the frame and its last beat do not change its packet.
TEST(AxiStreamBlock, RandomStops_LeavePacketsWholeAndInOrder) {
  mb4test::Dice dice;
  Stream stream;
  auto& m = stream.model;
  begin(stream);
  std::deque<std::vector<Beat>> packets;  // that have ended and may come
  std::vector<Beat> packet;
  unsigned lost = 0, whole = 0, sent = 0, stop = 0;
  const auto clock = [&] {
    if (stop == 0 && dice.below(20) == 0) stop = dice.below(400);
    m.s_axis_tready = static_cast<CData>(stop != 0 ? 0U : dice.below(2));
    if (stop != 0) --stop;
    m.eval();
    if (m.s_axis_tvalid != 0 && m.s_axis_tready != 0) {
      packet.push_back({m.s_axis_tdata, m.s_axis_tuser, m.s_axis_tlast != 0});
      if (m.s_axis_tlast != 0) {
        ASSERT_FALSE(packets.empty());
        ASSERT_EQ(packet, packets.front());
        packets.pop_front();
        packet.clear();
        ++whole;
      }
    }
    stream.clock();
  };
  for (unsigned read = 0; read < 20'000; ++read) {
    const unsigned enabled = dice.below(31) + 1;
    m.enabled_i = static_cast<std::uint8_t>(enabled);
    std::vector<Beat> frame;
    for (unsigned c = 0; c < kChannels; ++c) {
      const unsigned flags = dice.below(16);
      set_word(m, c, read, flags);
      if ((enabled >> c & 1U) == 0) continue;
      frame.push_back({read, c << 8U | flags, (enabled >> (c + 1)) == 0});
    }
    m.done_i = 1;
    ASSERT_NO_FATAL_FAILURE(clock());
    m.done_i = 0;
    m.eval();
    ++sent;
    if (m.overrun_o != 0) {
      ++lost;
      EXPECT_EQ(m.busy_o, 0);
    } else {
      packets.push_back(frame);
    }
    for (unsigned i = 0; i < kChannels + dice.below(20); ++i) {
      m.clear_i = dice.below(8) == 0 ? 1 : 0;
      m.enabled_i = static_cast<std::uint8_t>(dice.below(32));
      ASSERT_NO_FATAL_FAILURE(clock());
    }
    m.clear_i = 0;
    while (m.busy_o != 0) ASSERT_NO_FATAL_FAILURE(clock());
  }
  for (unsigned i = 0; i < 2000; ++i) ASSERT_NO_FATAL_FAILURE(clock());
  EXPECT_TRUE(packets.empty());
  EXPECT_TRUE(packet.empty());
  EXPECT_EQ(whole + lost, sent);
  EXPECT_GT(lost, 1000U);
  EXPECT_GT(whole, 1000U);
}

// The FIFO is used up to its last place: a frame is lost only if its beats do not fit.
TEST(AxiStreamBlock, FrameThatFits_IsNotLost) {
  Stream stream;
  auto& m = stream.model;
  begin(stream);
  m.s_axis_tready = 0;
  const auto frame = [&](unsigned enabled) {
    m.enabled_i = static_cast<std::uint8_t>(enabled);
    m.done_i = 1;
    stream.clock();
    m.done_i = 0;
    m.eval();
    const bool kept = m.overrun_o == 0;
    for (unsigned i = 0; i < 8; ++i) stream.clock();
    return kept;
  };
  // One beat at the output, 14 in the FIFO.
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(frame(0b11111));
  EXPECT_FALSE(frame(0b11100));
  EXPECT_TRUE(frame(0b10010));
  EXPECT_FALSE(frame(0b00100));
  // A soft reset that comes with the end of a frame ends it as one that is not lost.
  m.clear_i = 1;
  EXPECT_TRUE(frame(0b00100));
  EXPECT_EQ(m.busy_o, 0);
  m.clear_i = 0;
  m.s_axis_tready = 1;
  unsigned beats = 0, lasts = 0;
  for (unsigned i = 0; i < 40; ++i) {
    m.eval();
    beats += m.s_axis_tvalid;
    lasts += m.s_axis_tvalid & m.s_axis_tlast;
    stream.clock();
  }
  EXPECT_EQ(beats, 17U);
  EXPECT_EQ(lasts, 4U);
}

}  // namespace
