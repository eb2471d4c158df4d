// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What line delays are good for: the alarm and the shifted starts, with five channels.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "Vaxi_delays.h"
#include "axi_regs.hpp"
#include "tests/block/axi/axi_bus.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace reg = biss_axi::regs;

constexpr unsigned kChannels = 5, kNoAck = 1023;

class AxiDelaysBlock : public testing::Test {
 protected:
  AxiDelaysBlock() {
    m.clear_i = m.index_i = m.done_i = m.start_i = 0;
    m.bus_i = 0;
    m.enabled_i = 0x1F;
    m.shift_i = 0;
    for (auto& word : m.results_i.m_storage) word = 0;
    block.reset();
  }
  void set_delay(unsigned channel, unsigned delay) {
    using namespace mb4test::places::axi_pkg::result_t;
    kDelay.in(channel, kAllBits).set(m.results_i, delay);
  }
  // The end of a frame, and what is made of its delays. Returns the number of alarms.
  unsigned done() {
    m.done_i = 1;
    block.clock();
    m.done_i = 0;
    unsigned alarms = 0, clocks = 0;
    for (; m.busy_o != 0 && clocks < 100; ++clocks) {
      m.eval();
      alarms += m.alarm_o;
      block.clock();
    }
    EXPECT_EQ(clocks, 2 * kChannels);
    return alarms;
  }
  mb4test::Dice dice;
  mb4test::Block<Vaxi_delays> block;
  Vaxi_delays& m = block.model;
};

TEST_F(AxiDelaysBlock, RandomDelays_AlarmIfWatchedEnabledAndBeyondTheTolerance) {
  unsigned alarmed = 0;  // expected DELAY_ALARM
  for (int round = 0; round < 500; ++round) {
    const unsigned tolerance = dice.below(dice.below(3) == 0 ? 1024 : 10);
    mb4test::write_page(block, reg::kAddrDelayTolerance, tolerance);
    m.enabled_i = static_cast<std::uint8_t>(dice.below(32));
    unsigned moved = 0;
    for (unsigned c = 0; c < kChannels; ++c) {
      const unsigned reference = dice.below(1024);
      const bool watched = dice.below(4) != 0;
      const int delay =
          dice.below(4) == 0
              ? static_cast<int>(dice.below(1024))
              : std::clamp(static_cast<int>(reference + dice.below(23)) - 11, 0, 1023);
      m.index_i = static_cast<std::uint8_t>(c);
      mb4test::write_page(block, reg::kAddrDelayReference,
                          reference | (watched ? 1U << 31U : 0U) | 0x12300000U);
      EXPECT_EQ(mb4test::read_page(block, reg::kAddrDelayReference),
                reference | (watched ? 1U << 31U : 0U));
      set_delay(c, static_cast<unsigned>(delay));
      const unsigned away = static_cast<unsigned>(std::abs(delay - static_cast<int>(reference)));
      if (watched && (m.enabled_i >> c & 1U) != 0 && away > tolerance) moved |= 1U << c;
    }
    unsigned count = 0;
    for (unsigned c = 0; c < kChannels; ++c) count += moved >> c & 1U;
    EXPECT_EQ(done(), count);
    alarmed |= moved;
    ASSERT_EQ(mb4test::read_page(block, reg::kAddrDelayAlarm), alarmed);
    const unsigned clear = dice.below(64);
    mb4test::write_page(block, reg::kAddrDelayAlarm, clear);
    alarmed &= ~clear;
    ASSERT_EQ(mb4test::read_page(block, reg::kAddrDelayAlarm), alarmed);
  }
  m.clear_i = 1;
  block.clock();
  m.clear_i = 0;
  EXPECT_EQ(mb4test::read_page(block, reg::kAddrDelayAlarm), 0U);
}

// 3.9, ALIGN_LATCH: half the difference to the largest delay of the enabled channels.
TEST_F(AxiDelaysBlock, RandomDelays_ShiftTheStarts) {
  for (int round = 0; round < 300; ++round) {
    m.enabled_i = static_cast<std::uint8_t>(1 + dice.below(31));
    std::array<unsigned, kChannels> delays{};
    unsigned most = 0;
    for (unsigned c = 0; c < kChannels; ++c) {
      delays[c] = dice.below(6) == 0 ? kNoAck : dice.below(1023);
      set_delay(c, delays[c]);
      if ((m.enabled_i >> c & 1U) != 0 && delays[c] != kNoAck) most = std::max(most, delays[c]);
    }
    done();
    // Later results do not count before the next end of a frame.
    for (unsigned c = 0; c < kChannels; ++c) set_delay(c, dice.below(1024));
    m.shift_i = static_cast<std::uint8_t>(dice.below(32));
    std::array<std::vector<unsigned>, kChannels> starts;
    for (unsigned clock = 0; clock < 520; ++clock) {
      m.start_i = clock == 0;
      m.eval();
      for (unsigned c = 0; c < kChannels; ++c) {
        if ((m.start_o >> c & 1U) != 0) starts[c].push_back(clock);
      }
      const unsigned pending = m.pending_o;
      block.clock();
      EXPECT_TRUE(clock != 0 || pending == 0);
    }
    for (unsigned c = 0; c < kChannels; ++c) {
      const bool shifted =
          (m.shift_i >> c & 1U) != 0 && (m.enabled_i >> c & 1U) != 0 && delays[c] != kNoAck;
      const unsigned expected = shifted ? (most - delays[c]) / 2 : 0;
      ASSERT_EQ(starts[c], std::vector<unsigned>{expected})
          << "round " << round << " channel " << c;
    }
  }
}

// A shifted start is to come, and the delays are looked at, when the reset falls.
TEST_F(AxiDelaysBlock, Reset_StartsNothing) {
  set_delay(0, 0);
  set_delay(1, 200);
  m.shift_i = 1;
  done();
  m.start_i = m.done_i = 1;
  block.clock();
  m.start_i = m.done_i = 0;
  m.eval();
  EXPECT_EQ(m.pending_o, 1);
  EXPECT_EQ(m.busy_o, 1);
  m.rst_ni = 0;
  m.eval();
  EXPECT_EQ(m.start_o | m.pending_o | m.busy_o | m.alarm_o, 0);
  m.rst_ni = 1;
  for (int clock = 0; clock < 300; ++clock) {
    block.clock();
    EXPECT_EQ(m.start_o | m.pending_o | m.busy_o | m.alarm_o, 0);
  }
}

// A start that is to come holds the channel in its frame; a soft reset or a disabled channel drops
// it.
TEST_F(AxiDelaysBlock, PendingStart_EndsWithItsStartOrAReset) {
  for (const int how : {0, 1, 2}) {
    m.enabled_i = 0x1F;
    set_delay(0, 0);
    set_delay(1, 200);
    m.shift_i = 1;
    done();
    m.start_i = 1;
    block.clock();
    m.start_i = 0;
    m.eval();
    EXPECT_EQ(m.pending_o, 1);
    m.clear_i = how == 1;
    m.enabled_i = how == 2 ? 0x1E : 0x1F;
    unsigned starts = 0, clocks = 0;
    for (; m.pending_o != 0 && clocks < 300; ++clocks) {
      m.eval();
      starts += m.start_o & 1U;
      block.clock();
    }
    m.clear_i = 0;
    EXPECT_EQ(starts, how == 0 ? 1U : 0U);
    EXPECT_EQ(clocks, how == 0 ? 100U : 1U);
  }
}

}  // namespace
