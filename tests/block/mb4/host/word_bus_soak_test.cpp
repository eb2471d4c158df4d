// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The tops with a word bus under random traffic, MB4_WORD_ACCESSES accesses in each test: while
// frames run, and while the core's clock is slow, stops and comes back. Expected values: decisions
// 15, 36, 45 and the table of the page (docs/buses.md); the words are those of the slaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "Vmb4_axil.h"
#include "Vmb4_wb.h"
#include "mb4_page_regs.hpp"
#include "tests/block/mb4/word_bus_bench.hpp"
#include "tests/support/bits.hpp"

namespace {

using mb4test::Answer;
using mb4test::Dice;
using mb4test::WordBusBench;
namespace page = mb4::page;

constexpr std::uint32_t kInstrWord = 0xF4;
constexpr std::uint32_t kAgs = 0x01;
constexpr unsigned kAgserrOnHoldbank = 4;  // bit 2 of quirks_i

std::uint64_t accesses() { return mb4test::number_from("MB4_WORD_ACCESSES", 1500); }

constexpr std::uint32_t snapshot(unsigned channel, std::uint32_t offset) {
  return page::kAddrSnapshot + page::kSnapshotStride * (channel - 1) + offset;
}

// Periods of bus and core in picoseconds.
struct Clocks {
  std::uint64_t bus, core;
};

template <typename Model>
class WordBusSoak : public testing::Test {};
using Models = testing::Types<Vmb4_axil, Vmb4_wb>;
TYPED_TEST_SUITE(WordBusSoak, Models);

// AGSMIN on both lines. A second top without traffic tells when its frames run: no read of any
// address and no write of the page may move one of them. Each snapshot is the newest word that has
// ended before its read began, or a newer one, whole, with its number and its time.
TYPED_TEST(WordBusSoak, AnyReadAndAnyWriteOfThePage_DisturbNoFrame) {
  constexpr std::array kClocks{Clocks{100'000, 40'000}, Clocks{100'000, 100'000},
                               Clocks{6'666, 100'000}, Clocks{6'666, 40'000},
                               Clocks{50'000, 50'000}};
  Dice dice;
  for (const Clocks clocks : kClocks) {
    for (const unsigned quirks : {0U, kAgserrOnHoldbank}) {
      const std::uint64_t phase = 1 + dice.below(static_cast<unsigned>(clocks.core));
      SCOPED_TRACE(testing::Message() << "bus " << clocks.bus << " core " << clocks.core
                                      << " phase " << phase << " quirks " << quirks);
      WordBusBench<TypeParam> bus(clocks.bus, clocks.core, phase, quirks);
      WordBusBench<TypeParam> quiet(clocks.bus, clocks.core, phase, quirks);
      for (WordBusBench<TypeParam>* each : {&bus, &quiet}) {
        each->configure();
        each->put(kInstrWord, kAgs, 0x1);
        for (int i = 0; i < 40'000 && each->frames[1].size() < 3; ++i) each->clock();
      }
      std::uint64_t offset = 0;
      unsigned snapshots = 0;
      const std::uint64_t count = std::max<std::uint64_t>(accesses() / 10, 1);
      for (std::uint64_t n = 0; n < count; ++n) {
        const unsigned kind = dice.below(8);
        if (kind == 0) {
          bus.put(0x100 + 4 * dice.below(0x40), dice.below(1U << 31), dice.below(16));
          continue;
        }
        if (kind != 1) {
          const std::uint32_t address = 4 * dice.below(kind < 6 ? 0x80 : 0x400);
          const std::uint32_t data = bus.get(address);
          if (address == 0xF0) {
            EXPECT_EQ(data & 0x78U, 0x78U);
          }
          if (address == 0xF8) {
            EXPECT_EQ(data >> 24 & 1U, 0U);  // SWBANKFAIL
          }
          if (address == kInstrWord) {
            EXPECT_EQ(data, kAgs);
          }
          if (address == page::kAddrIrqStatus) {
            EXPECT_EQ(data & page::ERROR::kMask, 0U);
          }
          continue;
        }
        ++snapshots;
        const unsigned line = dice.below(2);
        const unsigned channel = line == 0 ? 1 : 5;
        const std::size_t ended = bus.frames[line].size() - 1;
        const std::uint32_t low = bus.get(snapshot(channel, 0));
        const std::uint32_t high = bus.get(snapshot(channel, 4));
        const std::uint32_t flags = bus.get(snapshot(channel, 8));
        const std::uint32_t number = bus.get(snapshot(channel, 0xC));
        const std::uint64_t time = bus.get(snapshot(channel, 0x10)) |
                                   std::uint64_t{bus.get(snapshot(channel, 0x14))} << 32;
        ASSERT_GE(number, ended);
        ASSERT_LE(number, bus.frames[line].size());
        const auto& frame = bus.frames[line][number - 1];
        ASSERT_EQ(low, 0x01010101U * frame.value);
        ASSERT_EQ(high, line == 0 ? low : 0U);
        ASSERT_EQ(flags, 1U);
        if (offset == 0) offset = frame.latch_clock - time;
        ASSERT_EQ(time + offset, frame.latch_clock);
      }
      EXPECT_GT(snapshots, count / 20);
      while (quiet.core_edges < bus.core_edges) quiet.clock();
      for (unsigned line = 0; line < 2; ++line) {
        const auto& got = bus.frames[line];
        const auto& expected = quiet.frames[line];
        ASSERT_GE(expected.size(), got.size());
        EXPECT_GT(got.size(), 3U);
        for (std::size_t i = 0; i < got.size(); ++i) {
          ASSERT_EQ(got[i].latch_clock, expected[i].latch_clock) << "frame " << i + 1;
        }
      }
    }
  }
}

// The core's clock is slow, stops and comes back at any moment. Every access is answered: with an
// error only if the clock has stood still meanwhile, and not later than WaitLimit clocks of the bus
// after that. What was written without an error is read back, what was answered with an error is
// not written. A late answer of the core is never taken for another one.
TYPED_TEST(WordBusSoak, CoreClockSlowStoppedAndBack_NothingIsLostWithoutAnError) {
  constexpr std::array kClocks{Clocks{6'666, 50'000}, Clocks{6'666, 600'000},
                               Clocks{100'000, 40'000}, Clocks{20'000, 1'000'000}};
  constexpr unsigned kWaitLimit = 1024;
  constexpr unsigned kRdata = 0x80;
  Dice dice;
  for (const Clocks clocks : kClocks) {
    SCOPED_TRACE(testing::Message() << "bus " << clocks.bus << " core " << clocks.core);
    WordBusBench<TypeParam> bus(clocks.bus, clocks.core, 1 + dice.below(5000));
    // Words of SCDATA, which no frame changes.
    std::array<std::uint64_t, 8> words{};
    for (unsigned x = 1; x <= 8; ++x) {
      words[x - 1] = 0x0101010101010101U * x ^ 0x8070605040302010U;
      bus.put(8 * (x - 1), static_cast<std::uint32_t>(words[x - 1]));
      bus.put(8 * (x - 1) + 4, static_cast<std::uint32_t>(words[x - 1] >> 32));
    }
    std::uint32_t last_time = bus.get(page::kAddrTimeLow);
    std::uint64_t last_edges = bus.core_edges;
    std::map<std::uint32_t, std::uint32_t> expected;
    for (std::uint32_t i = 0; i < 16; ++i) {
      bus.put(kRdata + 4 * i, 0);
      expected[kRdata + 4 * i] = 0;
    }
    bus.get(kRdata);  // the queue is empty
    unsigned until = 1000;
    bool stood = false;
    std::vector<std::uint64_t> history;  // edges of the core at each clock of the bus
    bus.before_bus_edge = [&] {
      stood = stood || !bus.core_runs();
      history.push_back(bus.core_edges);
      if (--until != 0) return;
      if (bus.core_runs()) {
        bus.stop_core();
        until = 1 + dice.below(dice.below(2) == 0 ? 4000 : 200);
      } else {
        bus.start_core();
        until = 1 + dice.below(5000);
      }
    };
    unsigned errors = 0;
    unsigned good = 0;
    for (std::uint64_t n = 0; n < std::max<std::uint64_t>(accesses() / 4, 1); ++n) {
      stood = !bus.core_runs();
      const unsigned kind = dice.below(8);
      Answer answer;
      if (kind < 4) {
        const std::uint32_t address = kRdata + 4 * dice.below(16);
        if (dice.below(2) == 0) {
          const std::uint32_t data = dice.below(1U << 31) * 3U;
          const unsigned enables = dice.below(16);
          answer = bus.write(address, data, enables);
          for (unsigned byte = 0; !answer.error && byte < 4; ++byte) {
            if ((enables >> byte & 1U) == 0) continue;
            const std::uint32_t mask = 0xFFU << (8 * byte);
            expected[address] = (expected[address] & ~mask) | (data & mask);
          }
        } else {
          answer = bus.read(address);
          ASSERT_EQ(answer.data, answer.error ? 0 : expected[address]) << n;
        }
      } else if (kind < 6) {
        const unsigned x = 1 + dice.below(8);
        answer = bus.read(snapshot(x, 0));
        if (!answer.error) {
          ASSERT_EQ(answer.data, static_cast<std::uint32_t>(words[x - 1])) << n;
          ASSERT_EQ(bus.get(snapshot(x, 4)), static_cast<std::uint32_t>(words[x - 1] >> 32)) << n;
        }
      } else if (kind == 6) {
        const std::uint64_t edges = bus.core_edges;
        answer = bus.read(page::kAddrTimeLow);
        if (!answer.error) {
          ASSERT_GE(answer.data - last_time, edges - last_edges) << n;
          last_time = answer.data;
          last_edges = bus.core_edges;
        }
      } else {
        // These need no core, so they never fail.
        const std::uint32_t data = dice.below(1U << 31);
        bus.put(0xC0, data);
        ASSERT_EQ(bus.get(0xC0), data);
        ASSERT_EQ(bus.get(page::kAddrId), page::kResetId);
        continue;
      }
      if (answer.error) {
        ++errors;
        ASSERT_TRUE(stood) << n;
        // The core shows itself every 8 clocks: no more have come within the limit, but for those
        // in the few clocks of the bus that its sign and the answer take.
        const std::size_t window = kWaitLimit - 16;
        ASSERT_GT(history.size(), window);
        ASSERT_LE(bus.core_edges - history[history.size() - window],
                  9 + 8 * clocks.bus / clocks.core)
            << n;
      } else {
        ++good;
      }
      // A wait of a queue of 128 bytes or a snapshot takes at most 600 clocks of the core.
      ASSERT_LE(answer.clocks, 4 * kWaitLimit + 5000 + 600 * (clocks.core / clocks.bus + 1)) << n;
    }
    EXPECT_GT(good, errors);
    bus.before_bus_edge = nullptr;
    bus.start_core();
    for (const auto& [address, data] : expected) EXPECT_EQ(bus.get(address), data);
  }
}

// Misuse: a read that is taken back. It must not touch the words of a channel to which the address
// goes in the same clock.
TYPED_TEST(WordBusSoak, ReadTakenBack_LeavesOtherChannelsAlone) {
  for (const Clocks clocks : {Clocks{20'000, 40'000}, Clocks{50'000, 40'000}}) {
    WordBusBench<TypeParam> bus(clocks.bus, clocks.core, 5);
    bus.put(0x20, 0x11111111);  // SCDATA5
    bus.put(0x24, 0x22222222);
    EXPECT_EQ(bus.get(snapshot(5, 0)), 0x11111111U);
    unsigned in_time = 0;
    for (unsigned clock = 1; clock < 80; ++clock) {
      // A channel that has a copy.
      in_time += bus.withdraw(snapshot(1, 0), clock, snapshot(5, 4));
      ASSERT_EQ(bus.get(snapshot(5, 4)), 0x22222222U) << clock;
      // One that has none.
      in_time += bus.withdraw(snapshot(1, 0), clock, snapshot(3, 4));
      ASSERT_EQ(bus.get(snapshot(3, 4)), 0U) << clock;
      ASSERT_EQ(bus.get(page::kAddrTimeHigh), 0U) << clock;
    }
    EXPECT_GT(in_time, 40U);
  }
}

}  // namespace
