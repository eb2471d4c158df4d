// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bytes that the host wrote last, alone: docs/choices.md, 36. The test plays the queue of
// posted bytes (enc_posted) with a core clock that may be slow or stopped. And the registers that
// have no other place to be read from.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "Vmb4_recent.h"
#include "Vmb4_recent_one.h"
#include "tests/block/mb4/host_port.hpp"
#include "tests/support/model_context.hpp"

namespace {

// The address of SCDATA or RDATA; with bit 6 the one of the host's second bank of SCDATA.
struct Written {
  unsigned address, byte;
};

// Addresses in both banks of SCDATA and in RDATA.
unsigned any_address(mb4test::Dice& random, unsigned limit) {
  static constexpr unsigned kAddresses[] = {0x00, 0x40, 0x21, 0x61, 0x80, 0x3F, 0xA0, 0x7F};
  return kAddresses[random.below(limit)];
}

// The module after a reset, with no byte in the queue.
template <class Model>
struct Recent {
  Recent() {
    m.wr_clk_i = m.rd_clk_i = m.bank_i = m.marked_i = 0;
    m.host_i = 0;
    m.empty_i = 1;
    mb4test::pulse_reset(m);
  }
  mb4test::Owned<Model> owner;
  Model& m = *owner;
};

class RecentBlock : public testing::Test, protected Recent<Vmb4_recent> {
 protected:
  bool empty() const { return taken == log.size(); }
  // The core takes the oldest byte that waits.
  void take() {
    if (!empty()) ++taken;
    follow();
  }
  // One edge of the host clock; of rd_clk_i too if writes and reads have one clock.
  void edge(bool one_clock) {
    const bool mark = m.mark_o != 0;
    empty_at_edge = empty();
    before_edge = log.size();
    m.wr_clk_i = 1;
    if (one_clock) m.rd_clk_i = 1;
    m.eval();
    m.wr_clk_i = 0;
    if (one_clock) m.rd_clk_i = 0;
    m.eval();
    if ((m.mark_o != 0) != mark) marked_up_to = before_edge, ++marks;
    if (writing) log.push_back(now);
    writing = false;
    m.host_i = 0;
    follow();
  }
  void write(unsigned address, unsigned byte, bool one_clock) {
    writing = true;
    now = {address, byte};
    m.bank_i = (address & 0x40) != 0;
    m.host_i = mb4test::host_writes(address & ~0x40U, byte);
    edge(one_clock);
  }
  // Reads with an edge and compares with what decision 36 says.
  void read(unsigned address, bool in_memory, bool one_clock) {
    // The newest byte for the address, and how many other addresses have been written since.
    std::size_t found = log.size();
    std::vector<unsigned> newer;
    for (std::size_t i = log.size(); i-- > 0 && found == log.size();) {
      if (log[i].address == address) {
        found = i;
      } else if (std::find(newer.begin(), newer.end(), log[i].address) == newer.end()) {
        newer.push_back(log[i].address);
      }
    }
    const bool kept = in_memory && found < log.size() && newer.size() < 4;
    const bool waits = found < log.size() && found >= taken;
    // The three signs of which each ends the answer.
    const bool ended = empty() || (m.marked_i == m.mark_o && found < marked_up_to) ||
                       (empty_at_edge && found < before_edge);
    m.bank_i = (address & 0x40) != 0;
    m.host_i = mb4test::host_reads(in_memory ? address & ~0x40U : address | 0x40);
    m.eval();
    if (one_clock) {
      edge(true);
    } else {
      m.rd_clk_i = 1;
      m.eval();
      m.rd_clk_i = 0;
      m.eval();
    }
    m.host_i = 0;
    if (!kept || ended) {
      ASSERT_EQ(m.hit_o, 0) << "address " << address << ": the memory answers";
    }
    if (kept && waits) {
      ASSERT_EQ(m.hit_o, 1) << "address " << address << ": the byte is on its way";
      ++hits;
    }
    if (m.hit_o != 0) {
      ASSERT_EQ(m.data_o, log[found].byte);
    }
  }

  std::vector<Written> log;      // all bytes written, the oldest first
  std::size_t taken = 0;         // ... of which the core has taken so many
  std::size_t marked_up_to = 0;  // ... written before the last change of mark_o
  std::size_t before_edge = 0;   // ... before the last edge of the host clock
  bool empty_at_edge = true;
  bool writing = false;
  Written now{};
  unsigned hits = 0, marks = 0;

 private:
  void follow() {
    m.empty_i = empty();
    if (taken >= marked_up_to) m.marked_i = m.mark_o;
    m.eval();
  }
};

TEST_F(RecentBlock, NoCoreClock_LastFourAddressesAnswerWithTheirLastByte) {
  mb4test::Dice random;
  for (int step = 0; step < 5'000; ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step);
    write(any_address(random, 8), random.below(256), false);
    for (int reads = 0; reads < 8; ++reads) {
      read(any_address(random, 8), random.below(8) != 0, false);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(hits, 10'000U);
}

TEST_F(RecentBlock, CoreTakesBytes_MemoryAnswersFromThenOn) {
  mb4test::Dice random;
  for (int step = 0; step < 100'000; ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step);
    // Rows of writes with a fast core, with a slow one, and with none.
    const bool one_clock = step / 1'000 % 2 != 0;
    const unsigned pace = 2 + step / 2'000 % 5 * 2;
    if (random.below(3) == 0) write(any_address(random, 6), random.below(256), one_clock);
    if (random.below(pace) == 0) take();
    if (random.below(40) == 0) edge(one_clock);
    read(any_address(random, 6), random.below(8) != 0, one_clock);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(hits, 1'000U);
  EXPECT_GT(marks, 100U);
}

// Writes all registers, and reads those of `whole` back, until a reset; the others give no answer.
template <class Model>
void expect_read_back(const std::vector<unsigned>& whole) {
  Recent<Model> recent;
  Model& m = recent.m;
  const auto edge = [&m](auto& clock) {
    m.eval();
    clock = 1;
    m.eval();
    clock = 0;
    m.eval();
  };
  mb4test::Dice random;
  const auto count = static_cast<unsigned>(whole.size());
  std::array<int, 256> written{};
  const auto look = [&](unsigned address) {
    m.bank_i = random.below(2) != 0;
    m.host_i = mb4test::host_reads(address);
    edge(m.rd_clk_i);
    ASSERT_EQ(m.hit_o, written[address] >= 0) << std::hex << address;
    if (m.hit_o != 0) {
      ASSERT_EQ(m.data_o, written[address]) << std::hex << address;
    }
  };
  for (int step = 0; step < 20'000; ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step);
    if (step % 500 == 0) {
      written.fill(-1);
      mb4test::pulse_reset(m);
    }
    const unsigned address =
        random.below(2) == 0 ? whole[random.below(count)] : 0xC0 + random.below(64);
    const unsigned byte = random.below(256);
    m.bank_i = random.below(2) != 0;
    m.host_i = mb4test::host_writes(address, byte);
    edge(m.wr_clk_i);
    if (std::count(whole.begin(), whole.end(), address) != 0) {
      written[address] = static_cast<int>(byte);
    }
    look(whole[random.below(count)]);
    look(0xC0 + random.below(64));
    if (testing::Test::HasFatalFailure()) return;
  }
}

// The registers with eight bits that the host can write: pages 27 to 31 and 33.
TEST_F(RecentBlock, WholeRegisters_ReadBackAtAnyTimeUntilAReset) {
  expect_read_back<Vmb4_recent>({0xE2, 0xE6, 0xE8, 0xE9, 0xEF, 0xF5});
}

// With one data channel its configuration too (page 24); ACTnSENS has reserved bits then.
TEST_F(RecentBlock, OneDataChannel_ItsConfigurationReadsBackToo) {
  expect_read_back<Vmb4_recent_one>({0xC0, 0xC1, 0xC2, 0xC3, 0xE2, 0xE6, 0xE8, 0xE9, 0xF5});
}

}  // namespace
