// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The tops with a word bus: byte map, page, snapshots under traffic, a core clock that is slow or
// stands still. Expected values: decision 45 and the table of the page (docs/buses.md).
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "Vmb4_axil.h"
#include "Vmb4_wb.h"
#include "Vmb4_wb_pipelined.h"
#include "mb4_page_regs.hpp"
#include "tests/block/mb4/word_bus_bench.hpp"
#include "tests/support/bits.hpp"
// This project does not write Verilator's own header, so its warnings do not count.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include "Vmb4_axil___024root.h"
#pragma GCC diagnostic pop

namespace {

using mb4test::Answer;
using mb4test::Dice;
using mb4test::WordBusBench;
namespace page = mb4::page;

constexpr std::uint32_t kInstrWord = 0xF4;
constexpr std::uint32_t kAgs = 0x01;

template <typename Model>
class WordBus : public testing::Test {};
using Models = testing::Types<Vmb4_axil, Vmb4_wb>;
TYPED_TEST_SUITE(WordBus, Models);

// Periods of bus and core in picoseconds: bus 10 to 150 MHz, core 10 to 25 MHz.
struct Clocks {
  std::uint64_t bus, core;
};
constexpr std::array kClocks{Clocks{100'000, 40'000}, Clocks{100'000, 100'000},
                             Clocks{20'000, 40'000},  Clocks{6'666, 100'000},
                             Clocks{6'666, 40'000},   Clocks{40'000, 40'000}};

constexpr std::uint32_t snapshot(unsigned channel, std::uint32_t offset) {
  return page::kAddrSnapshot + page::kSnapshotStride * (channel - 1) + offset;
}

TYPED_TEST(WordBus, IdentityAndAddressesWithoutWords_ReadAsPrinted) {
  WordBusBench<TypeParam> bus(10'000, 50'000);
  EXPECT_EQ(bus.get(0x100), 0x454E4301U);
  EXPECT_EQ(bus.get(0x108), 0x83FFU);  // two lines of eight data channels, everything
  for (const std::uint32_t address :
       {0x11CU, 0x1E0U, 0x1FCU, 0x200U, 0x400U, 0xFFCU, 0x040U, 0x07CU}) {
    bus.put(address, 0xFFFFFFFFU);
    EXPECT_EQ(bus.get(address), 0U) << std::hex << address;
  }
  // Snapshots and the time's high word before any low word was read.
  for (std::uint32_t address = 0x124; address < 0x1E0; address += 4) {
    if ((address - 0x120) % 0x18 == 0) continue;
    EXPECT_EQ(bus.get(address), 0U) << std::hex << address;
  }
  EXPECT_EQ(bus.get(page::kAddrTimeHigh), 0U);
  // Nothing stands behind the last snapshot, whatever that holds.
  bus.put(0x38, 0x55AA55AAU);  // SCDATA8
  EXPECT_EQ(bus.get(snapshot(8, 0)), 0x55AA55AAU);
  for (std::uint32_t address = 0x1E0; address < 0x200; address += 4) {
    EXPECT_EQ(bus.get(address), 0U) << std::hex << address;
  }
  // REVISION and VERSION stand in bytes 2 and 3 of the word of 0xE8 (decision 33).
  EXPECT_EQ(bus.get(0xE8) >> 16, 0x8420U);
}

// Each byte lies where the byte map has it, and only enabled bytes are written.
TYPED_TEST(WordBus, RandomWords_ReadBackByteByByte) {
  for (const Clocks clocks : kClocks) {
    WordBusBench<TypeParam> bus(clocks.bus, clocks.core, 777);
    Dice dice;
    std::map<std::uint32_t, std::uint32_t> expected;
    for (int i = 0; i < 400; ++i) {
      // SCDATA, RDATA and the configuration of the data channels keep all bits.
      const unsigned pick = dice.below(40);
      const std::uint32_t address = pick < 16 ? pick * 4 : 0x80 + (pick - 16) * 4;
      const auto data = static_cast<std::uint32_t>(dice.below(1U << 30)) * 5U;
      const unsigned enables = dice.below(16);
      bus.put(address, data, enables);
      for (unsigned byte = 0; byte < 4; ++byte) {
        if ((enables >> byte) & 1U) {
          const std::uint32_t mask = 0xFFU << (8 * byte);
          expected[address] = (expected[address] & ~mask) | (data & mask);
        }
      }
      if (dice.below(3) != 0) continue;
      ASSERT_EQ(bus.get(address), expected[address]) << std::hex << address;
    }
    for (const auto& [address, data] : expected) {
      EXPECT_EQ(bus.get(address), data) << std::hex << address << " bus " << clocks.bus;
    }
  }
}

// 200 words as fast as the bus can: none is lost, whatever the clocks.
TYPED_TEST(WordBus, MoreWordsThanTheQueueHolds_WaitAndArrive) {
  for (const Clocks clocks : kClocks) {
    WordBusBench<TypeParam> bus(clocks.bus, clocks.core, 333);
    for (unsigned round = 0; round < 8; ++round) {
      for (std::uint32_t i = 0; i < 16; ++i) bus.put(0x80 + 4 * i, 0x01010101U * (round * 16 + i));
      for (std::uint32_t i = 0; i < 16; ++i) bus.put(4 * i, 0x01010101U * (round * 16 + i + 1));
      if (round % 3 != 2) continue;
      for (std::uint32_t i = 0; i < 16; ++i) {
        ASSERT_EQ(bus.get(0x80 + 4 * i), 0x01010101U * (round * 16 + i)) << clocks.bus;
        ASSERT_EQ(bus.get(4 * i), 0x01010101U * (round * 16 + i + 1)) << clocks.bus;
      }
    }
  }
}

// A core clock that stands still: what needs it is answered with an error within the limit, what
// does not need it works; nothing that was answered well is lost when the clock comes back.
TYPED_TEST(WordBus, StoppedCore_EveryAccessIsAnswered) {
  WordBusBench<TypeParam> bus(6'666, 50'000, 100);
  bus.stop_core();
  std::vector<std::uint32_t> kept;
  unsigned errors = 0;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const std::uint32_t data = 0xA0000000U + i;
    const Answer answer = bus.write(0x80 + 4 * (i % 16), data);
    ASSERT_LT(answer.clocks, 1100U);
    if (answer.error) {
      ++errors;
      EXPECT_GT(answer.clocks, 1000U);
    } else {
      kept.push_back(data);
    }
  }
  EXPECT_GE(kept.size(), 31U);  // 124 of the 128 bytes of the queue
  EXPECT_LE(kept.size(), 32U);
  EXPECT_EQ(errors, 40 - kept.size());
  for (const std::uint32_t address : {0x80U, 0x00U, 0x114U, 0x120U, 0x168U}) {
    const Answer answer = bus.read(address);
    EXPECT_TRUE(answer.error) << std::hex << address;
    EXPECT_EQ(answer.data, 0U);
    EXPECT_LT(answer.clocks, 1100U);
  }
  bus.put(0xC0, 0x12345678U);
  EXPECT_EQ(bus.get(0xC0), 0x12345678U);
  bus.put(page::kAddrIrqEnable, 0x15U);
  EXPECT_EQ(bus.get(page::kAddrIrqEnable), 0x15U);
  EXPECT_EQ(bus.get(0x124), 0U);
  // The clock comes back: every word that was taken has arrived, the latest for each address.
  bus.start_core();
  for (std::size_t i = kept.size() - 16; i < kept.size(); ++i) {
    EXPECT_EQ(bus.get(0x80 + 4 * ((kept[i] & 0xFF) % 16)), kept[i]);
  }
  // The late answer to the request that was given up does not answer the next one.
  const std::uint32_t first = bus.get(page::kAddrTimeLow);
  EXPECT_GT(bus.get(page::kAddrTimeLow), first);
}

// Time that the core answers too late is dropped: each value that is read is newer than the start
// of its access.
TYPED_TEST(WordBus, CoreStopsDuringRequests_NoOldAnswerIsTaken) {
  WordBusBench<TypeParam> bus(20'000, 40'000, 100);
  std::uint32_t last = bus.get(page::kAddrTimeLow);
  std::uint64_t edges = bus.core_edges;
  for (int round = 0; round < 30; ++round) {
    bus.stop_core();
    EXPECT_TRUE(bus.read(page::kAddrTimeLow).error);
    bus.start_core();
    for (int i = 0; i < round * 3; ++i) bus.clock();
    const std::uint64_t before = bus.core_edges;
    const std::uint32_t now = bus.get(page::kAddrTimeLow);
    EXPECT_GE(now - last, before - edges) << round;
    last = now;
    edges = bus.core_edges;
  }
}

// A slow core is no stopped one, from 1 / 100 of the bus clock on.
TYPED_TEST(WordBus, SlowCore_NoAccessEndsWithAnError) {
  WordBusBench<TypeParam> bus(6'666, 666'600, 100);
  for (std::uint32_t i = 0; i < 64; ++i) bus.put(0x80 + 4 * (i % 16), i);
  for (std::uint32_t i = 48; i < 64; ++i) EXPECT_EQ(bus.get(0x80 + 4 * (i % 16)), i);
  bus.get(page::kAddrTimeLow);
  bus.get(0x120);
}

// The longest of each access in clocks of the bus, over the phases of the two clocks.
struct Cost {
  unsigned any = 0, kept = 0, data = 0, behind_write = 0, time = 0, snapshot = 0, full_queue = 0;
};

template <typename Model>
Cost cost_of(std::uint64_t bus_ps, std::uint64_t core_ps) {
  Cost cost;
  const auto worst = [](unsigned& most, const Answer& answer) {
    EXPECT_FALSE(answer.error);
    most = std::max(most, static_cast<unsigned>(answer.clocks));
  };
  for (unsigned phase = 0; phase < 24; ++phase) {
    WordBusBench<Model> bus(bus_ps, core_ps, 1 + phase * core_ps / 24);
    bus.get(page::kAddrTimeLow);  // the reset is over on both sides
    worst(cost.any, bus.read(0xC0));
    worst(cost.any, bus.write(0xC0, 0x5A5A5A5A));
    worst(cost.kept, bus.read(page::kAddrIrqStatus));
    worst(cost.data, bus.read(0x00));
    worst(cost.time, bus.read(page::kAddrTimeLow));
    worst(cost.snapshot, bus.read(snapshot(1, 0)));
    worst(cost.kept, bus.read(snapshot(1, 4)));
    worst(cost.any, bus.write(0x80, 1));
    worst(cost.behind_write, bus.read(0x80));
    for (std::uint32_t i = 0; i < 64; ++i)
      worst(cost.full_queue, bus.write(0x80 + 4 * (i % 16), i));
  }
  return cost;
}

// docs/buses.md, "What a slow core costs": at most, in clocks of the bus, with `ratio` of them to a
// clock of the core.
TYPED_TEST(WordBus, SlowCore_CostsNoMoreThanThePageSays) {
  for (const unsigned ratio : {1U, 4U, 10U, 40U}) {
    SCOPED_TRACE(ratio);
    const Cost cost = cost_of<TypeParam>(10'000, 10'000 * ratio);
    EXPECT_LE(cost.kept, 7U);
    EXPECT_LE(cost.any, 11U);
    EXPECT_LE(cost.data, 11U);
    EXPECT_LE(cost.behind_write, 7 * ratio + 8);
    EXPECT_LE(cost.time, 21 * ratio + 11);
    EXPECT_LE(cost.snapshot, 33 * ratio + 11);
    EXPECT_LE(cost.full_queue, 124 * ratio + 30);
    // A slow core costs what the page says, not less.
    EXPECT_GT(cost.time, 20 * ratio);
    EXPECT_GT(cost.snapshot, 32 * ratio);
  }
}

// AGSMIN with both lines busy, snapshots all the time, random reads and writes of the page between
// them: each snapshot is of one frame, with its number and its time; no frame is left out and no
// flag changes.
TYPED_TEST(WordBus, SnapshotsWhileFramesRun_AreOfOneFrame) {
  for (const Clocks clocks : kClocks) {
    for (std::uint64_t phase = 1; phase < clocks.core; phase += clocks.core / 3) {
      WordBusBench<TypeParam> bus(clocks.bus, clocks.core, phase);
      Dice dice;
      bus.configure();
      bus.put(kInstrWord, kAgs, 0x1);
      for (int i = 0; i < 20000 && bus.frames[1].size() < 3; ++i) bus.clock();
      std::uint64_t offset = 0;
      std::array<std::uint32_t, 2> last{};
      for (int i = 0; i < 150; ++i) {
        const unsigned line = dice.below(2);
        const unsigned channel = line == 0 ? 1 : 5;
        const std::uint32_t low = bus.get(snapshot(channel, 0));
        if (dice.below(2) == 0) bus.get(4 * dice.below(0x48));
        const std::uint32_t high = bus.get(snapshot(channel, 4));
        const std::uint32_t flags = bus.get(snapshot(channel, 8));
        const std::uint32_t number = bus.get(snapshot(channel, 0xC));
        const std::uint64_t time = bus.get(snapshot(channel, 0x10)) |
                                   (std::uint64_t{bus.get(snapshot(channel, 0x14))} << 32);
        if (dice.below(3) == 0) bus.put(0x100 + 4 * dice.below(0x38), 0xFFFFFFFFU, dice.below(16));
        ASSERT_GE(number, std::max<std::uint32_t>(1, last[line]));
        ASSERT_LE(number, bus.frames[line].size());
        const auto& frame = bus.frames[line][number - 1];
        ASSERT_EQ(low, 0x01010101U * frame.value) << "frame " << number;
        ASSERT_EQ(high, line == 0 ? 0x01010101U * frame.value : 0U) << "frame " << number;
        EXPECT_EQ(flags, 1U);
        if (offset == 0) offset = frame.latch_clock - time;
        EXPECT_EQ(time + offset, frame.latch_clock);
        last[line] = number;
      }
      EXPECT_GT(last[0], 10U);
      EXPECT_EQ(bus.get(0xF0) & 0x78U, 0x78U);  // no error flag
      EXPECT_EQ(bus.get(0xF8) >> 24 & 1U, 0U);  // SWBANKFAIL
    }
  }
}

// SSI frames without data on an open line follow each other faster than a snapshot can be copied.
// Its read ends nevertheless, and shows no valid word.
TYPED_TEST(WordBus, SnapshotWhileBanksSwitchAllTheTime_EndsWithoutAWord) {
  for (const Clocks clocks : kClocks) {
    WordBusBench<TypeParam> bus(clocks.bus, clocks.core, 1);
    bus.after_core_edge = [&] {
      bus.model->sl1_i = 1;
      bus.model->eval();
    };
    bus.put(0xE8, 0x0000007C);  // AGSMIN, FREQS = 0
    bus.put(0xEC, 0x00000E10);  // line 1 SSI, line 2 unused
    bus.put(kInstrWord, kAgs, 0x1);
    for (int i = 0; i < 200; ++i) bus.clock();
    for (unsigned channel : {1U, 2U, 5U}) {
      EXPECT_FALSE(bus.read(snapshot(channel, 0)).error);
      EXPECT_EQ(bus.get(snapshot(channel, 8)) & 1U, 0U);
    }
    EXPECT_FALSE(bus.read(page::kAddrTimeLow).error);
  }
}

// One bank: the line writes where the host reads. A snapshot that says valid is whole.
TYPED_TEST(WordBus, SnapshotsWithOneBank_ValidOnesAreWhole) {
  WordBusBench<TypeParam> bus(20'000, 40'000, 3);
  bus.configure();
  bus.put(0xE4, 0x01004000U);  // SINGLEBANK
  Dice dice;
  bus.put(kInstrWord, kAgs, 0x1);
  unsigned valid = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::uint32_t low = bus.get(snapshot(1, 0));
    const std::uint32_t high = bus.get(snapshot(1, 4));
    const std::uint32_t number = bus.get(snapshot(1, 0xC));
    for (unsigned wait = dice.below(40); wait > 0; --wait) bus.clock();
    if ((bus.get(snapshot(1, 8)) & 1U) == 0) continue;
    ++valid;
    ASSERT_TRUE(number >= 1 && number <= bus.frames[0].size());
    ASSERT_EQ(low, 0x01010101U * bus.frames[0][number - 1].value);
    ASSERT_EQ(high, low);
  }
  EXPECT_GT(valid, 100U);
}

// HOLDBANK and SWBANK act on a snapshot that is read right after them.
TYPED_TEST(WordBus, SnapshotBehindHoldbank_KeepsTheWord) {
  for (const Clocks clocks : kClocks) {
    WordBusBench<TypeParam> bus(clocks.bus, clocks.core, 11);
    bus.configure();
    bus.put(kInstrWord, kAgs, 0x1);
    for (int i = 0; i < 20000 && bus.frames[0].size() < 3; ++i) bus.clock();
    for (int i = 0; i < 25; ++i) {
      bus.put(kInstrWord, 0x40 | kAgs, 0x1);  // HOLDBANK
      const std::uint32_t word = bus.get(0x00);
      EXPECT_EQ(bus.get(snapshot(1, 0)), word);
      EXPECT_EQ(bus.get(0x04), word);
      bus.put(kInstrWord, kAgs, 0x1);
      for (int wait = 0; wait < i * 7; ++wait) bus.clock();
    }
  }
}

TYPED_TEST(WordBus, Interrupts_FollowTheirEvents) {
  for (const Clocks clocks : kClocks) {
    WordBusBench<TypeParam> bus(clocks.bus, clocks.core, 17);
    bus.configure();
    bus.put(0xE8, 0x0000007DU);  // AGSINFINITE: a frame for each edge of GETSENS
    bus.put(page::kAddrIrqEnable, 0x01U);
    bus.put(kInstrWord, kAgs, 0x1);
    EXPECT_EQ(bus.get(page::kAddrIrqStatus), 0U);
    const auto sense = [&] {
      bus.model->getsens_i = 1;
      for (int i = 0; i < 60; ++i) bus.clock();
      bus.model->getsens_i = 0;
    };
    sense();
    for (int i = 0; i < 4000 && !bus.model->irq_o; ++i) bus.clock();
    EXPECT_TRUE(bus.model->irq_o);
    EXPECT_EQ(bus.get(page::kAddrIrqStatus), 0x09U);  // a frame ended, GETSENS rose
    bus.put(page::kAddrIrqStatus, 0x01U);
    EXPECT_FALSE(bus.model->irq_o);
    EXPECT_EQ(bus.get(page::kAddrIrqStatus), 0x08U);
    // Two frames without a clear between them, after the slaves' timeout.
    for (int i = 0; i < 1000; ++i) bus.clock();
    for (int frame = 0; frame < 2; ++frame) {
      sense();
      for (int i = 0; i < 4000; ++i) bus.clock();
    }
    EXPECT_EQ(bus.get(page::kAddrIrqStatus), 0x19U);
    bus.put(page::kAddrIrqStatus, 0x1FU);
    EXPECT_EQ(bus.get(page::kAddrIrqStatus), 0U);
    // NER falls; the interrupt is not enabled for it.
    bus.model->ner_i = 0;
    for (int i = 0; i < 200; ++i) bus.clock();
    EXPECT_EQ(bus.get(page::kAddrIrqStatus), 0x02U);
    EXPECT_FALSE(bus.model->irq_o);
    bus.put(page::kAddrIrqEnable, 0x02U);
    EXPECT_TRUE(bus.model->irq_o);
  }
}

// The registers of the interrupt have one address each, and their first byte alone acts.
TYPED_TEST(WordBus, WritesElsewhere_LeaveTheInterruptAlone) {
  WordBusBench<TypeParam> bus(10'000, 50'000);
  constexpr std::uint32_t kEnabled = 0x12, kNer = 0x02;
  bus.put(page::kAddrIrqEnable, kEnabled);
  bus.model->ner_i = 0;
  for (int i = 0; i < 200; ++i) bus.clock();
  const auto expect_untouched = [&](std::uint32_t address) {
    EXPECT_EQ(bus.get(page::kAddrIrqStatus), kNer) << std::hex << address;
    EXPECT_EQ(bus.get(page::kAddrIrqEnable), kEnabled) << std::hex << address;
  };
  expect_untouched(0);
  for (std::uint32_t address = 0; address < 0x1000; address += 4) {
    const bool in_page = address >> 8 == page::kAddrId >> 8;
    const std::uint32_t same = page::kAddrId + (address & 0xFF);  // of the page
    const bool status = same == page::kAddrIrqStatus, enable = same == page::kAddrIrqEnable;
    if (!in_page && !status && !enable) continue;
    // Ones clear the status; the enable takes any bits.
    bus.put(address, enable ? ~kEnabled : ~0U, in_page && (status || enable) ? 0xE : 0xF);
    expect_untouched(address);
  }
}

// Decision 45: the core takes 0xF4 when it has taken the force bits of the same word.
TEST(WordBusOrder, InstructionWithForceBits_ActsAfterThem) {
  const std::uint64_t phases = mb4test::number_from("MB4_WORD_PHASES", 23);
  for (const Clocks clocks : kClocks) {
    for (std::uint64_t phase = 1; phase < clocks.core; phase += clocks.core / phases) {
      WordBusBench<Vmb4_axil> bus(clocks.bus, clocks.core, phase);
      bus.configure();
      const auto* root = bus.model->rootp;
      unsigned taken = 0;
      unsigned wanted = 0;
      bus.after_core_edge = [&] {
        if (!root->mb4_axil__DOT__u_bus__DOT__u_engine__DOT__u_control__DOT__u_sequencer__DOT__written)
          return;
        ++taken;
        // held_q: MAFS, MAVS, MAFO, MAVO, CHSEL.
        EXPECT_EQ(
            root->mb4_axil__DOT__u_bus__DOT__u_engine__DOT__u_control__DOT__u_force__DOT__held_q,
            wanted)
            << "bus " << clocks.bus << " core " << clocks.core << " phase " << phase;
      };
      for (unsigned i = 0; i < 6; ++i) {
        wanted = i % 2 == 0 ? 0x30 : 0x00;  // MAFS and MAVS: MA stays high
        bus.put(kInstrWord, (i % 2 == 0 ? 0x3000U : 0U) | 0x80U, 0x3);  // with BREAK
        EXPECT_EQ(bus.get(kInstrWord) & 0xFF00U, i % 2 == 0 ? 0x3000U : 0U);
        for (int wait = 0; wait < 200; ++wait) bus.clock();
      }
      EXPECT_EQ(taken, 6U);
    }
  }
}

// The bytes of a word that is not that of 0xF4 act in ascending order, with the enables of the bus;
// pipelined cycles of Wishbone give the same.
TEST(WordBusPipelined, RandomWords_ReadBack) {
  WordBusBench<Vmb4_wb_pipelined> bus(10'000, 40'000, 5);
  Dice dice;
  for (int i = 0; i < 200; ++i) {
    const std::uint32_t address = 0x80 + 4 * dice.below(24);
    const std::uint32_t data = dice.below(1U << 30) * 3U;
    bus.put(address, data);
    ASSERT_EQ(bus.get(address), data);
  }
}

}  // namespace
