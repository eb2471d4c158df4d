// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What starts a read of the BiSS C master on AXI, alone. Expected values: the manual's registers
// 0x04..0x1C, the acceptance tests F-2, F-6, F-7, F-9, and docs/axi.md for values out of range.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "Vaxi_start.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

struct Config {
  bool soft_reset = false, external_clock = false, single_point = false, request = false;
  std::uint32_t sample_divider = 5;
  unsigned ma_divider = 4, position_bits = 26;
  std::uint64_t port() const {
    namespace at = mb4test::places::axi_pkg::cfg_t;
    // Whether the CRC is checked is the port check_i here.
    return at::kSoftReset(soft_reset) | at::kExternalClock(external_clock) |
           at::kSinglePoint(single_point) | at::kRequest(request) |
           at::kSampleDivider(sample_divider) | at::kMaDivider(ma_divider) |
           at::kPositionBits(position_bits);
  }
};

namespace frame_t = mb4test::places::axi_pkg::frame_t;

class AxiStartBlock : public testing::Test {
 protected:
  AxiStartBlock() {
    m.cfg_i = config.port();
    m.check_i = m.busy_i = m.in_frame_i = m.any_i = 0;
    m.ext_sample_clk_i = m.sample_en_i = 0;
    m.crc_bits_i = 6;
    block.reset();
    m.any_i = m.sample_en_i = 1;
  }

  // Channels are in a frame for frame_clocks after a start, and in the timeout for as long again.
  void clock() {
    m.cfg_i = config.port();
    const bool started = m.start_o != 0;
    block.clock();
    if (started) left = 2 * frame_clocks;
    m.in_frame_i = left > frame_clocks;
    m.busy_i = left > 0;
    if (left > 0) --left;
    m.eval();
    ++now;
    if (m.start_o != 0) starts.push_back(now);
    skips += m.skip_o;
    if (m.done_o != 0) dones.push_back(now);
    if ((m.sample_clk_o != 0) != high) edges.push_back(now);
    high = m.sample_clk_o != 0;
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }
  void forget() {
    starts.clear();
    dones.clear();
    edges.clear();
    skips = 0;
  }
  void pulse_request() {
    config.request = true;
    clocks(10);
    config.request = false;
    clocks(10);
  }
  std::uint64_t half_last() const { return frame_t::kHalfLast.of(m.frame_o); }
  std::uint64_t data_bits() const { return frame_t::kDataLast.of(m.frame_o) + 1; }
  std::uint64_t ma_edges() const { return frame_t::kEdges.of(m.frame_o); }
  bool check() const { return frame_t::kCheck.of(m.frame_o) != 0; }
  bool single() const { return frame_t::kSingle.of(m.frame_o) != 0; }

  mb4test::Block<Vaxi_start> block;
  Vaxi_start& m = block.model;
  Config config;
  unsigned frame_clocks = 1, left = 0, now = 0, skips = 0;
  bool high = false;
  std::vector<unsigned> starts, dones, edges;
};

// 0x10: f = f_aclk / 2N; 0 acts as 1 (3.9). A read starts with each rising edge.
TEST_F(AxiStartBlock, InternalClock_HasAHalfPeriodOfTheDivider) {
  for (const unsigned divider : {1000U, 0U, 1U, 2U, 3U, 17U, 255U, 256U}) {
    const unsigned half = divider == 0 ? 1 : divider;
    config.sample_divider = divider;
    clocks(2000);
    forget();
    clocks(20 * half);
    ASSERT_EQ(edges.size(), 20U) << divider;
    for (unsigned i = 1; i < 20; ++i) ASSERT_EQ(edges[i] - edges[i - 1], half) << divider;
    if (half < 17) continue;
    ASSERT_EQ(starts.size(), 10U) << divider;
    EXPECT_EQ(starts[9] - starts[0], 9 * 2 * half);
    EXPECT_EQ(skips, 0U);
  }
}

TEST_F(AxiStartBlock, EveryBitOfTheDivider_Counts) {
  for (unsigned bit = 11; bit < 28; ++bit) {
    config.sample_divider = 1;
    clocks(10);
    config.sample_divider = 1U << bit;
    clocks(2);
    forget();
    clocks(2040);
    EXPECT_TRUE(edges.empty()) << bit;
  }
  // A smaller value counts at once.
  config.sample_divider = 1000;
  clocks(3);
  EXPECT_FALSE(edges.empty());
}

// 0x04, F-7: one read for each rising edge of the pin while sample_en is 1, three clocks after the
// clock edge that takes it.
TEST_F(AxiStartBlock, ExternalClock_StartsAReadWithEachRisingEdgeWhileEnabled) {
  config.external_clock = true;
  clocks(20);
  for (const bool enabled : {true, false, true}) {
    m.sample_en_i = enabled;
    clocks(5);
    forget();
    for (unsigned pulse = 1; pulse <= 5; ++pulse) {
      m.ext_sample_clk_i = 1;
      clocks(4);
      EXPECT_EQ(m.start_o != 0, enabled);
      clocks(16);
      EXPECT_TRUE(m.sample_clk_o);
      m.ext_sample_clk_i = 0;
      clocks(20);
      EXPECT_FALSE(m.sample_clk_o);
      EXPECT_EQ(starts.size(), enabled ? pulse : 0);
    }
    EXPECT_EQ(skips, 0U);
    EXPECT_EQ(dones.size(), starts.size());
  }
  // A level is no edge.
  m.sample_en_i = 0;
  clocks(5);
  m.ext_sample_clk_i = 1;
  clocks(10);
  forget();
  m.sample_en_i = 1;
  clocks(20);
  EXPECT_TRUE(starts.empty());
  EXPECT_FALSE(single());
}

// 0x08, 0x0C, F-6: in single-point mode a change from 0 to 1 starts one read, and the sample clock
// none; in the other mode a request does nothing.
TEST_F(AxiStartBlock, Request_StartsOneReadInSinglePointMode) {
  config.external_clock = true;
  clocks(20);
  forget();
  pulse_request();
  EXPECT_TRUE(starts.empty());
  config.single_point = true;
  m.sample_en_i = 0;  // holds no request back
  clocks(20);
  EXPECT_TRUE(starts.empty());
  for (unsigned i = 1; i <= 3; ++i) {
    m.ext_sample_clk_i = i % 2;
    pulse_request();
    EXPECT_EQ(starts.size(), i);
    EXPECT_TRUE(single());
  }
  EXPECT_EQ(skips, 0U);
}

// F-9: an edge while a frame or a timeout runs is skipped.
TEST_F(AxiStartBlock, EdgeInFrameOrTimeout_IsSkipped) {
  config.single_point = true;
  frame_clocks = 100;
  for (unsigned i = 0; i < 10; ++i) pulse_request();  // in a frame from the first on
  EXPECT_EQ(starts.size(), 1U);
  EXPECT_EQ(skips, 9U);
  ASSERT_EQ(dones.size(), 1U);
  EXPECT_EQ(dones[0] - starts[0], 101U);
  clocks(20);
  pulse_request();
  EXPECT_EQ(starts.size(), 2U);
  // An edge every two clocks, and SLO of all channels is 0: every second edge meets the read of the
  // one before, which no channel has begun.
  clocks(400);
  frame_clocks = 0;
  config.single_point = false;
  config.sample_divider = 1;
  clocks(10);
  forget();
  clocks(400);
  EXPECT_EQ(starts.size(), 100U);
  EXPECT_EQ(skips, 100U);
  EXPECT_EQ(dones.size(), 100U);
}

TEST_F(AxiStartBlock, NoChannelOrSoftReset_NeitherStartNorSkip) {
  config.single_point = true;
  for (const bool reset : {false, true}) {
    for (const bool busy : {false, true}) {
      config.soft_reset = reset;
      m.any_i = reset;
      left = busy ? 60 : 0;
      frame_clocks = 30;
      forget();
      clocks(2);
      pulse_request();
      EXPECT_EQ(starts.size() + skips, 0U);
      clocks(60);
    }
  }
  // The same request after the soft reset.
  config.soft_reset = false;
  clocks(5);
  pulse_request();
  EXPECT_EQ(starts.size(), 1U);
}

// 0x14, 0x18: 0 acts as 1 and as 32 bits, more than 32 bits as 32 (docs/axi.md). A word has two
// flags and 6 bits of CRC; MA has 4 edges more from the start bit on (axi_channel).
TEST_F(AxiStartBlock, EveryCodeOfDividerAndBits_MakesTheFrame) {
  config.single_point = true;
  for (unsigned code = 0; code < 256; ++code) {
    config.ma_divider = code;
    config.position_bits = 255 - code;
    m.check_i = code % 2;
    pulse_request();
    const unsigned bits =
        config.position_bits == 0 || config.position_bits > 32 ? 32 : config.position_bits;
    EXPECT_EQ(half_last(), code == 0 ? 0 : code - 1);
    EXPECT_EQ(data_bits(), bits + 2) << config.position_bits;
    EXPECT_EQ(ma_edges(), 4 + bits + 2 + 6) << config.position_bits;
    EXPECT_EQ(check(), code % 2 != 0);
    // What the registers say later counts from the next frame on.
    const auto frame = m.frame_o;
    config.ma_divider = code ^ 0xFF;
    config.position_bits = 7;
    m.check_i = !m.check_i;
    clocks(5);
    EXPECT_EQ(m.frame_o, frame);
  }
}

}  // namespace
