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

// mark_o follows a change of mark_i when the core has taken all bytes written before it, whatever
// waits behind them.
TEST(PostedBlock, Mark_ComesWhenTheBytesBeforeItAreTaken) {
  mb4test::Dice dice;
  mb4test::Owned<Venc_posted> owner;
  Venc_posted& posted = *owner;
  posted.wr_clk_i = posted.clk_i = 0;
  posted.wr_en_i = posted.mark_i = posted.ready_i = 0;
  for (const int level : {1, 0, 1}) {
    posted.wr_rst_ni = posted.rst_ni = static_cast<std::uint8_t>(level);
    posted.eval();
  }
  EXPECT_EQ(posted.mark_o, 0);
  unsigned sent = 0, taken = 0;
  const auto host_writes = [&](unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i) {
      posted.wr_en_i = 1;
      posted.wr_data_i = static_cast<std::uint16_t>(sent++);
      posted.wr_clk_i = 1;
      posted.eval();
      posted.wr_clk_i = 0;
      posted.wr_en_i = 0;
      posted.eval();
    }
  };
  const auto core_clock = [&](bool ready) {
    posted.ready_i = ready;
    posted.eval();
    taken += posted.valid_o != 0 && ready ? 1 : 0;
    posted.clk_i = 1;
    posted.eval();
    posted.clk_i = 0;
    posted.eval();
  };
  for (int round = 0; round < 500; ++round) {
    host_writes(dice.below(20));
    for (unsigned i = dice.below(10); i > 0; --i) core_clock(dice.below(2) != 0);
    const unsigned before = sent;
    posted.mark_i ^= 1;
    host_writes(dice.below(4));
    unsigned clocks_behind = 0;  // after the last byte
    while (posted.mark_o != posted.mark_i && clocks_behind < 20) {
      clocks_behind += taken == sent ? 1 : 0;
      core_clock(dice.below(3) != 0);
      ASSERT_TRUE(posted.mark_o != posted.mark_i || taken >= before) << round;
    }
    ASSERT_EQ(posted.mark_o, posted.mark_i) << round;
    for (unsigned i = dice.below(60); i > 0; --i) core_clock(true);
    ASSERT_EQ(posted.mark_o, posted.mark_i) << round;
  }
}

}  // namespace
