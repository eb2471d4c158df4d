// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Posted bytes between the host and the core clock at hostile ratios.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "Venc_posted.h"
#include "tests/support/model_context.hpp"

namespace {

// Two free clocks in picoseconds; host writes every `gap` host edges.
TEST(PostedBlock, HostBytesOf160nsAndAnyCoreClock_NoneIsLostOrDoubled) {
  for (const unsigned clk_ps : {40'000U, 50'000U, 60'000U, 72'300U, 79'999U, 99'999U}) {
    for (unsigned phase = 0; phase < clk_ps; phase += clk_ps / 13) {
      mb4test::Owned<Venc_posted> owner;
      Venc_posted& posted = *owner;
      posted.wr_clk_i = posted.clk_i = 0;
      posted.wr_rst_ni = posted.rst_ni = 0;
      posted.wr_en_i = posted.mark_i = 0;
      posted.ready_i = 1;
      posted.eval();
      for (int i = 0; i < 3; ++i) {
        posted.clk_i = 1;
        posted.wr_clk_i = 1;
        posted.eval();
        posted.clk_i = 0;
        posted.wr_clk_i = 0;
        posted.eval();
      }
      posted.wr_rst_ni = posted.rst_ni = 1;
      posted.eval();
      // A byte lasts eight SCLK periods of 20 ns; its write comes with the last rising edge.
      std::uint64_t host_edge = 160'000;
      std::uint64_t core_edge = phase + 1;
      std::vector<std::uint16_t> sent, received;
      std::mt19937 random(7);
      while (received.size() < 300 && host_edge < 300'000'000) {
        if (host_edge <= core_edge) {
          if (sent.size() < 300) {
            posted.wr_en_i = 1;
            posted.wr_data_i = static_cast<std::uint16_t>(random());
            sent.push_back(posted.wr_data_i);
          }
          posted.wr_clk_i = 1;
          posted.eval();
          posted.wr_clk_i = 0;
          posted.wr_en_i = 0;
          posted.eval();
          host_edge += 160'000;
        } else {
          posted.eval();
          if (posted.valid_o != 0) received.push_back(posted.data_o);
          posted.clk_i = 1;
          posted.eval();
          posted.clk_i = 0;
          posted.eval();
          core_edge += clk_ps;
        }
      }
      EXPECT_EQ(sent, received) << "clk " << clk_ps << " phase " << phase;
    }
  }
}

// The queue holds 128 bytes while the core clock stands still; they come in order when it runs.
TEST(PostedBlock, CoreClockStandsStill_128BytesWaitAndNoneIsLost) {
  mb4test::Owned<Venc_posted> owner;
  Venc_posted& posted = *owner;
  posted.wr_clk_i = posted.clk_i = 0;
  posted.wr_en_i = 0;
  posted.ready_i = 1;
  for (const int level : {1, 0, 1}) {
    posted.wr_rst_ni = posted.rst_ni = static_cast<std::uint8_t>(level);
    posted.eval();
  }
  std::vector<std::uint16_t> sent, received;
  const auto core_clock = [&] {
    posted.eval();
    if (posted.valid_o != 0 && posted.ready_i != 0) received.push_back(posted.data_o);
    posted.clk_i = 1;
    posted.eval();
    posted.clk_i = 0;
    posted.eval();
  };
  for (unsigned round = 0; round < 5; ++round) {
    for (unsigned i = 0; i < 128; ++i) {
      posted.wr_en_i = 1;
      posted.wr_data_i = static_cast<std::uint16_t>(round * 1000 + i);
      sent.push_back(posted.wr_data_i);
      posted.wr_clk_i = 1;
      posted.eval();
      posted.wr_clk_i = 0;
      posted.wr_en_i = 0;
      posted.eval();
    }
    for (unsigned i = 0; i < 400; ++i) {
      posted.ready_i = i % 3 != 0;  // sometimes the core takes no byte
      core_clock();
    }
    ASSERT_EQ(received, sent) << "round " << round;
  }
}

}  // namespace
