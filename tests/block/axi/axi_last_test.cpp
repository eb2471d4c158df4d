// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The last words of three channels alone (regmap/axi.rdl: LAST_STATUS, LAST_POSITION,
// LAST_POSITION_HIGH).
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "Vaxi_last.h"
#include "axi_regs.hpp"
#include "tests/block/axi/axi_bus.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace reg = biss_axi::regs;

constexpr unsigned kChannels = 3;
namespace event_t = mb4test::places::axi_pkg::event_t;

struct Last {
  std::uint32_t number = 0;
  bool good = false, nerr = false, nwarn = false, crc = false, late = false;
  std::uint64_t position = 0;
  std::uint32_t status() const {
    return number << 16U | static_cast<unsigned>(late) << 4U | static_cast<unsigned>(crc) << 3U |
           static_cast<unsigned>(good && nwarn) << 2U | static_cast<unsigned>(good && nerr) << 1U |
           static_cast<unsigned>(good);
  }
};

// Reads at random: each channel ends each read once, good, with a wrong CRC, failed or late.
// Between the words of a group anything may happen.
TEST(AxiLastBlock, ReadsAtRandom_AreShownWithTheirNumberAndPosition) {
  mb4test::Dice dice;
  mb4test::Block<Vaxi_last> block;
  Vaxi_last& m = block.model;
  m.clear_i = m.start_i = m.index_i = 0;
  m.check_i = 1;
  m.enabled_i = 7;
  m.bus_i = 0;
  m.events_i = 0;
  for (auto& word : m.words_i.m_storage) word = 0;
  for (auto& word : m.mores_i.m_storage) word = 0;
  block.reset();
  std::array<Last, kChannels> expected{};
  std::array<std::uint64_t, kChannels> held{};  // what the word of the channel holds
  std::uint32_t number = 0;
  unsigned waits = 0;  // channels that have not ended the read
  std::uint64_t copy = 0;
  unsigned bad = 0, goods = 0;
  for (int clock = 0; clock < 400'000; ++clock) {
    m.start_i = waits == 0 && dice.below(4) == 0;
    if (m.start_i != 0) {
      number = (number + 1) & 0xFFFF;
      waits = m.enabled_i;
      m.check_i = dice.below(4) != 0;
    }
    m.events_i = 0;
    std::array<bool, kChannels> ends{};
    std::array<Last, kChannels> next = expected;
    std::array<std::uint64_t, kChannels> position = held;
    for (unsigned c = 0; c < kChannels; ++c) {
      if ((waits >> c & 1U) == 0) continue;
      unsigned events = 0;
      if (m.start_i != 0) {
        if (dice.below(8) != 0) continue;
        events = static_cast<unsigned>(event_t::kLate(1));  // only in the clock of the start
      } else {
        if (dice.below(6) != 0) continue;
        const unsigned kind = dice.below(4);
        events = static_cast<unsigned>(kind == 0   ? event_t::kFailed(1)
                                       : kind == 1 ? event_t::kEnded(1) | event_t::kCrcError(1)
                                                   : event_t::kEnded(1));
      }
      ends[c] = true;
      waits &= ~(1U << c);
      m.events_i = m.events_i | events << c * event_t::kAllBits;
      Last& last = next[c];
      last.number = number;
      last.late = event_t::kLate.of(events) != 0;
      last.crc = event_t::kCrcError.of(events) != 0;
      last.good = event_t::kEnded.of(events) != 0 && !(last.crc && m.check_i != 0);
      if (last.good) {
        position[c] = std::uint64_t{dice.below(1U << 31)} << 33U | dice.below(1U << 31);
        last.nerr = dice.below(2) != 0;
        last.nwarn = dice.below(2) != 0;
      }
      last.position = last.good ? position[c] : 0;
      ++(last.good ? goods : bad);
    }
    // A read of the words in any clock, also in that of an end.
    const unsigned index = dice.below(kChannels);
    const unsigned what = dice.below(4);
    m.index_i = static_cast<std::uint8_t>(index);
    constexpr unsigned kAddresses[] = {reg::kAddrLastStatus, reg::kAddrLastPosition,
                                       reg::kAddrLastPositionHigh, reg::kAddrTimeLow};
    m.bus_i = mb4test::page_read(kAddresses[what]);
    m.eval();
    const std::uint32_t data = m.data_o;
    if (what == 0) {
      ASSERT_EQ(data, expected[index].status()) << clock;
      copy = expected[index].position;
    } else {
      ASSERT_EQ(data, what == 1   ? static_cast<std::uint32_t>(copy)
                      : what == 2 ? static_cast<std::uint32_t>(copy >> 32U)
                                  : 0U)
          << clock;
    }
    block.clock();
    m.bus_i = 0;
    m.start_i = 0;
    // The words of the channels change with the end.
    for (unsigned c = 0; c < kChannels; ++c) {
      if (!ends[c]) continue;
      const Last& last = next[c];
      if (last.good) {
        namespace word_t = mb4test::places::axi_pkg::word_t;
        namespace more_t = mb4test::places::axi_pkg::more_t;
        word_t::kPosition.in(c, word_t::kAllBits).set(m.words_i, position[c]);
        word_t::kNerr.in(c, word_t::kAllBits).set(m.words_i, last.nerr);
        word_t::kNwarn.in(c, word_t::kAllBits).set(m.words_i, last.nwarn);
        more_t::kPositionHigh.in(c, more_t::kAllBits).set(m.mores_i, position[c] >> 32U);
      }
    }
    expected = next;
    held = position;
  }
  EXPECT_GT(goods, 10'000U);
  EXPECT_GT(bad, 10'000U);
}

TEST(AxiLastBlock, DisabledChannelAndSoftReset_HaveNoWord) {
  mb4test::Block<Vaxi_last> block;
  Vaxi_last& m = block.model;
  m.clear_i = m.index_i = 0;
  m.check_i = 1;
  m.enabled_i = 7;
  m.bus_i = 0;
  for (auto& word : m.words_i.m_storage) word = 0xFFFF'FFFF;
  for (auto& word : m.mores_i.m_storage) word = 0xFFFF'FFFF;
  m.events_i = 0;
  m.start_i = 0;
  block.reset();
  EXPECT_EQ(mb4test::read_page(block, reg::kAddrLastStatus), 0U);
  for (unsigned n = 0; n < 5; ++n) {
    m.start_i = 1;
    block.clock();
    m.start_i = 0;
    m.events_i = static_cast<std::uint32_t>(event_t::kEnded(1) |
                                            event_t::kEnded.in(1, event_t::kAllBits)(1));
    block.clock();
    m.events_i = 0;
  }
  EXPECT_EQ(mb4test::read_page(block, reg::kAddrLastStatus), 5U << 16U | 7U);
  EXPECT_EQ(mb4test::read_page(block, reg::kAddrLastPosition), 0xFFFF'FFFFU);
  m.index_i = 2;  // has ended none
  EXPECT_EQ(mb4test::read_page(block, reg::kAddrLastStatus), 4U << 16U);
  EXPECT_EQ(mb4test::read_page(block, reg::kAddrLastPosition), 0U);
  m.index_i = 3;  // is not there
  EXPECT_EQ(mb4test::read_page(block, reg::kAddrLastStatus), 0U);
  m.index_i = 0;
  m.enabled_i = 6;
  block.clock();
  EXPECT_EQ(mb4test::read_page(block, reg::kAddrLastStatus), 5U << 16U);
  EXPECT_EQ(mb4test::read_page(block, reg::kAddrLastPosition), 0U);
  m.clear_i = 1;
  block.clock();
  m.clear_i = 0;
  m.index_i = 1;
  EXPECT_EQ(mb4test::read_page(block, reg::kAddrLastStatus), 0U);
}

}  // namespace
