// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Records and readers: each group sees the record that was the newest one when it was held, whole,
// however many come after it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "Vdsl_record.h"
#include "tests/support/model_context.hpp"

namespace {

constexpr unsigned kGroups = 6;
constexpr unsigned kBytes = 64;
constexpr unsigned kSearch = 64;  // clocks behind tell_i without a write, at most
using Record = std::array<std::uint8_t, kBytes>;

class DslRecordBlock : public testing::Test {
 protected:
  DslRecordBlock() {
    m.write_i = m.tell_i = m.read_i = m.hold_i = 0;
    m.write_address_i = m.write_data_i = m.group_i = m.address_i = 0;
    block.reset();
    while (m.busy_o != 0) block.clock();
  }

  // A record as dsl_position writes it, in any order of bytes, with reads in between.
  void write(unsigned reads_each) {
    Record next;
    for (std::uint8_t& byte : next) byte = static_cast<std::uint8_t>(random.below(256));
    const unsigned turn = random.below(kBytes);
    for (unsigned i = 0; i < kBytes; ++i) {
      const unsigned at = (i * 5 + turn) % kBytes;
      m.write_i = 1;
      m.write_address_i = static_cast<std::uint8_t>(at);
      m.write_data_i = next[at];
      read(reads_each);
      m.write_i = 0;
      if (random.below(4) == 0) read(reads_each);
    }
    m.tell_i = 1;
    read(reads_each);
    m.tell_i = 0;
    newest = next;
    search(reads_each);
  }
  void search(unsigned reads_each) {
    unsigned clocks = 0;
    while (m.busy_o != 0) {
      read(reads_each);
      ASSERT_LE(++clocks, kSearch);
    }
    longest = std::max(longest, clocks);
  }
  // A clock, with a read now and then, of the group that was asked for a clock before.
  void read(unsigned reads_each) {
    const bool reads = random.below(reads_each) == 0;
    const unsigned group = random.below(kGroups + 2);  // the last two are the newest record
    const unsigned address = random.below(kBytes);
    const bool hold = group < kGroups && random.below(reads_each) == 0 && random.below(8) == 0;
    m.read_i = reads;
    m.group_i = static_cast<std::uint8_t>(group);
    m.address_i = static_cast<std::uint8_t>(address);
    m.hold_i = hold;
    if (hold) {
      held[group] = newest;
      ++holds;
    }
    const std::uint8_t expected = asked[address];
    asked = group < kGroups ? held[group] : newest;
    block.clock();
    m.read_i = m.hold_i = 0;
    if (!reads) return;
    ASSERT_EQ(m.data_o, expected) << "byte " << address;
  }

  mb4test::Dice random;
  mb4test::Block<Vdsl_record> block;
  Vdsl_record& m = block.model;
  Record newest{};
  std::array<Record, kGroups> held{};
  Record asked{};  // the record of that group
  unsigned holds = 0;
  unsigned longest = 0;  // clocks of a search
};

TEST_F(DslRecordBlock, ReadersAtRandom_SeeTheRecordThatTheyHold) {
  // Nobody reads before the first record, which all groups hold then.
  Record first{};
  for (unsigned i = 0; i < kBytes; ++i) {
    first[i] = static_cast<std::uint8_t>(random.below(256));
    m.write_i = 1;
    m.write_address_i = static_cast<std::uint8_t>(i);
    m.write_data_i = first[i];
    block.clock();
  }
  m.write_i = 0;
  m.tell_i = 1;
  block.clock();
  m.tell_i = 0;
  newest = first;
  held.fill(first);
  asked = first;
  m.group_i = 0;
  search(2);
  for (unsigned i = 0; i < 3000; ++i) {
    write(1U << random.below(11));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(holds, 1000U);
  EXPECT_GT(longest, 20U);
}

}  // namespace
