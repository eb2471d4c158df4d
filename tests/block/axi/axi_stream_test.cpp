// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The stream of the BiSS C master on AXI in mode 1 with five channels and a FIFO of 16 beats.
#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <vector>

#include "Vaxi_stream_beats.h"
#include "tests/support/model_context.hpp"

namespace {

using mb4test::Block;
using Stream = Block<Vaxi_stream_beats>;

constexpr unsigned kChannels = 5;
constexpr unsigned kWordBits = 36;  // axi_pkg::word_t

struct Beat {
  std::uint32_t data;
  std::uint32_t user;
  bool last;
  bool operator==(const Beat&) const = default;
};

// Position, and 3 crc_bad, 2 nwarn, 1 nerr, 0 good.
void set_word(Vaxi_stream_beats& m, unsigned channel, std::uint32_t position, unsigned flags) {
  const std::uint64_t word = std::uint64_t{position} << 4U | flags;
  for (unsigned bit = 0; bit < kWordBits; ++bit) {
    const unsigned place = channel * kWordBits + bit;
    const std::uint32_t mask = 1U << place % 32;
    const bool one = (word >> bit & 1U) != 0;
    m.words_i[place / 32] = one ? m.words_i[place / 32] | mask : m.words_i[place / 32] & ~mask;
  }
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

TEST(AxiStreamBlock, SinkThatStops_LosesNewBeatsAndSaysSo) {
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

}  // namespace
