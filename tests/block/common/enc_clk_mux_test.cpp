// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The clock switch alone, at hostile ratios.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

#include "Venc_clk_mux.h"
#include "tests/support/model_context.hpp"

namespace {

// A reset is an edge to Verilator.
void reset(Venc_clk_mux& mux) {
  for (const int level : {1, 0, 1}) {
    mux.rst_ni = static_cast<std::uint8_t>(level);
    mux.eval();
  }
}

// Page 23, decision 32: no pulse shorter than half a period of the clock it belongs to. The choice
// is changed at times between `shortest` and `shortest` + `spread`; returns how often clk_o moved.
std::uint64_t no_short_pulse(std::uint64_t half0, std::uint64_t half1, std::uint64_t shortest,
                             std::uint64_t spread) {
  mb4test::Owned<Venc_clk_mux> owner;
  Venc_clk_mux& mux = *owner;
  mux.clk0_i = mux.clk1_i = 0;
  mux.sel_i = 0;
  reset(mux);
  std::mt19937_64 random(11);
  std::uint64_t now = 0, next0 = half0, next1 = half1, next_sel = 1'000'000;
  std::uint64_t last_change = 0;
  std::uint64_t edges = 0;
  int level = 0;
  while (now < 400'000'000) {
    now = std::min({next0, next1, next_sel});
    if (now == next0) {
      mux.clk0_i = !mux.clk0_i;
      next0 += half0;
    }
    if (now == next1) {
      mux.clk1_i = !mux.clk1_i;
      next1 += half1;
    }
    if (now == next_sel) {
      mux.sel_i = !mux.sel_i;
      next_sel += shortest + random() % spread;
    }
    mux.eval();
    if (mux.clk_o != level) {
      if (level == 1 || edges > 0) {
        EXPECT_GE(now - last_change, std::min(half0, half1)) << now;
      }
      level = mux.clk_o;
      last_change = now;
      ++edges;
    }
  }
  return edges;
}

TEST(ClockMuxBlock, SwitchingAtAnyPhase_NoShortPulse) {
  for (const std::uint64_t half1 : {20'000ULL, 25'100ULL, 50'000ULL, 7'000ULL}) {
    EXPECT_GT(no_short_pulse(25'000, half1, 400'000, 700'000), 4000U);
  }
}

// CLKENI set and cleared again before the switch has come to an end.
TEST(ClockMuxBlock, ChoiceTakenBackAtAnyTime_NoShortPulse) {
  for (const std::uint64_t half1 : {20'000ULL, 25'100ULL, 50'000ULL, 7'000ULL}) {
    EXPECT_GT(no_short_pulse(25'000, half1, 10'000, 300'000), 1000U);
  }
}

// A pin CLK that never toggled does not keep the oscillator from being chosen.
TEST(ClockMuxBlock, FirstClockNeverToggles_SecondCanBeChosen) {
  mb4test::Owned<Venc_clk_mux> owner;
  Venc_clk_mux& mux = *owner;
  mux.clk0_i = mux.clk1_i = 0;
  mux.sel_i = 1;
  reset(mux);
  unsigned rises = 0;
  for (int i = 0; i < 40; ++i) {
    const auto before = mux.clk_o;
    mux.clk1_i = !mux.clk1_i;
    mux.eval();
    if (mux.clk_o != 0 && before == 0) ++rises;
  }
  EXPECT_GE(rises, 16U);
}

// A pin CLK that stops after it has run, low or high, is given up; when it comes back it can be
// chosen again, and no pulse is short.
TEST(ClockMuxBlock, FirstClockStopsAfterItHasRun_SecondCanBeChosen) {
  for (const int rest : {0, 1}) {
    mb4test::Owned<Venc_clk_mux> owner;
    Venc_clk_mux& mux = *owner;
    mux.clk0_i = mux.clk1_i = 0;
    mux.sel_i = 0;
    reset(mux);
    std::uint64_t now = 0, last_change = 0;
    unsigned rises = 0;
    int level = 0;
    const auto eval = [&] {
      mux.eval();
      if (mux.clk_o == level) return;
      if (rises > 0) {
        EXPECT_GE(now - last_change, 20'000U) << now << " rest " << rest;
      }
      level = mux.clk_o;
      last_change = now;
      rises += level != 0 ? 1U : 0U;
    };
    // Half periods: 25 ns of the pin, 20 ns of the oscillator, which runs all the time.
    const auto run = [&](std::uint64_t until, bool pin_runs) {
      while (now < until) {
        now += 5'000;
        if (now % 20'000 == 0) mux.clk1_i = !mux.clk1_i;
        if (pin_runs && now % 25'000 == 0) mux.clk0_i = !mux.clk0_i;
        eval();
      }
    };
    run(2'000'000, true);
    EXPECT_GE(rises, 35U);
    while (mux.clk0_i != rest) run(now + 5'000, true);
    run(now + 1'000'000, false);
    const unsigned before = rises;
    mux.sel_i = 1;
    run(now + 20'000'000, false);
    EXPECT_EQ(rises, before) << "the pin may only be slow";
    run(now + 60'000'000, false);
    EXPECT_GE(rises, before + 300U) << "rest " << rest;
    mux.sel_i = 0;
    run(now + 1'000'000, false);
    const unsigned stopped = rises;
    run(now + 1'000'000, false);
    EXPECT_EQ(rises, stopped);
    run(now + 1'000'000, true);
    EXPECT_GE(rises, stopped + 15U) << "the pin is back";
  }
}

}  // namespace
