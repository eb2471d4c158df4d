// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The registers alone: values after the reset, who may write what, side effects, and which byte of
// which record each address shows. The memory of records is one of this test.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>

#include "Vdsl_regs.h"
#include "tests/block/dsl/dsl_frames.hpp"
#include "tests/block/dsl/dsl_registers.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace map = dsl::regs;
namespace page = dsl::page;
using dsl_registers::kGroups;
using dsl_registers::kWords;
using dsl_registers::Record;
using dsl_registers::reset_words;
using dsl_registers::WordOfRecord;

constexpr unsigned kNewest = 7;
constexpr unsigned kSummary = 37;  // in a record

// dsl_pkg::line_status_t, the last field first.
struct Status {
  unsigned place = 0, edges = 0, rssi = 0, low = 0, quality = 0, identity = 0, illegal = 0,
           resets = 0, reason = 0, state = 0;
  template <typename Port>
  void write(Port& port) const {
    unsigned at = 0;
    const auto add = [&port, &at](unsigned value, unsigned width) {
      for (unsigned i = 0; i < width; ++i, ++at) {
        const unsigned bit = 1U << at % 32;
        port[at / 32] = (port[at / 32] & ~bit) | ((value >> i & 1U) != 0 ? bit : 0U);
      }
    };
    add(place, 12);
    add(edges, 8);
    add(rssi, 4);
    add(low, 1);
    add(quality, 4);
    add(0, 6);
    add(identity, 20);
    add(illegal, 16);
    add(resets, 16);
    add(reason, 3);
    add(state, 4);
  }
};

// dsl_pkg::told_t without acceleration_good.
struct ToldPort {
  unsigned missing = 0;
  bool safe1_valid = false, safe1_error = false, safe2_valid = false, safe2_error = false;
  unsigned bits() const {
    return missing << 4U | (safe1_valid ? 8U : 0U) | (safe1_error ? 4U : 0U) |
           (safe2_valid ? 2U : 0U) | (safe2_error ? 1U : 0U);
  }
};

class DslRegsBlock : public testing::TestWithParam<bool> {
 protected:
  DslRegsBlock() { start(); }

  void start() {
    m.rst_ni = 0;
    m.quirks_i = dsl_frames::quirks_of({.sdk_map = sdk()});
    m.word_req_i = m.ended_i = m.tell_i = m.record_write_i = m.time_copied_i = 0;
    m.lost_i = 1;
    m.record_data_i = m.time_data_i = 0;
    apply();
    block.reset();
  }
  bool sdk() const { return GetParam(); }

  void apply() {
    status.write(m.status_i);
    m.answer_i = answer.bits();
    m.told_i = static_cast<SData>(told.bits());
    m.eval();
  }
  void clock() {
    apply();
    std::uint8_t next = static_cast<std::uint8_t>(random.below(256));
    if (m.record_read_o != 0) {
      const unsigned group = m.record_group_o;
      if (m.record_hold_o != 0 && group < kGroups) held[group] = newest;
      next = (group < kGroups ? held[group] : newest)[m.record_address_o];
    }
    const bool copies = m.time_copy_o != 0 && random.below(4) == 0;
    m.time_copied_i = copies ? 1 : 0;
    if (copies) ++copies_of_time;
    block.clock();
    m.time_copied_i = 0;
    m.record_data_i = next;
    m.eval();
  }
  std::uint32_t read(unsigned address) {
    return dsl_registers::access(m, address & ~3U, false, 0, 0xF, [this] { clock(); });
  }
  std::uint8_t read_byte(unsigned address) {
    return static_cast<std::uint8_t>(read(address) >> 8 * (address & 3U));
  }
  void write(unsigned address, std::uint32_t data, unsigned strobes) {
    dsl_registers::access(m, address, true, data, strobes, [this] { clock(); });
  }
  void write_byte(unsigned address, unsigned data) {
    write(address & ~3U, data << 8 * (address & 3U), 1U << (address & 3U));
  }

  void pulse(CData& port) {
    port = 1;
    clock();
    port = 0;
  }
  // A running frame's record, and what comes with it.
  void tell(unsigned place, unsigned summary) {
    answer.running = answer.linked = true;
    answer.place = place;
    answer.ends = true;
    clock();
    answer.ends = false;
    clock();
    for (std::uint8_t& byte : newest) byte = static_cast<std::uint8_t>(random.below(256));
    newest[kSummary] = static_cast<std::uint8_t>(summary);
    m.record_write_i = 1;
    m.record_address_i = kSummary;
    m.record_byte_i = newest[kSummary];
    clock();
    m.record_address_i = kSummary + 1;
    m.record_byte_i = 0x55;
    clock();
    m.record_write_i = 0;
    pulse(m.tell_i);
  }
  void clear_events() {
    write(map::kAddrEventH, 0, 0x3);
    ASSERT_EQ(read(map::kAddrEventH), 0U);
  }

  mb4test::Dice random;
  mb4test::Block<Vdsl_regs> block;
  Vdsl_regs& m = block.model;
  dsl_frames::AnswerPort answer;
  Status status;
  ToldPort told;
  Record newest{};
  std::array<Record, kGroups> held{};
  unsigned copies_of_time = 0;
};

TEST_P(DslRegsBlock, AfterReset_EachAddressHasItsResetValue) {
  const auto expected = reset_words(sdk());
  EXPECT_EQ(expected.at(page::kAddrId & ~3U), 0x454E4305U);
  auto words = expected;
  if (sdk()) words[page::kAddrFeatures] |= 1U << 3U;
  newest.fill(0xA5);
  held.fill(newest);
  for (unsigned address = 0; address < dsl_registers::kBytes; address += 4) {
    const auto word = words.find(address);
    ASSERT_EQ(read(address), word == words.end() ? 0U : word->second) << std::hex << address;
  }
}

// What can be written keeps it; everything else stays as it is. Each lane has its own strobe.
TEST_P(DslRegsBlock, WritesAtRandom_ReachWhatTheMapSays) {
  auto expected = reset_words(sdk());
  if (sdk()) expected[page::kAddrFeatures] |= 1U << 3U;
  std::map<unsigned, std::uint32_t> kept = {{0, 0xFF01}, {page::kAddrIrqEnable, 0x13}};
  if (sdk())
    kept[map::kAddrAccErrCntThresh & ~3U] = 0x1F00;
  else
    kept[0] |= 0x80;
  for (unsigned i = 0; i < 6000; ++i) {
    unsigned address = random.below(3) != 0 ? random.below(0x80) * 4 : random.below(0x400) * 4;
    if (random.below(4) == 0) {
      constexpr unsigned kWritten[] = {0, 0x40, page::kAddrIrqEnable};
      address = kWritten[random.below(3)];
    }
    const std::uint32_t data = random.below(1U << 16U) << 16U | random.below(1U << 16U);
    const unsigned strobes = random.below(16);
    std::uint32_t lanes = 0;
    for (unsigned lane = 0; lane < 4; ++lane) {
      if ((strobes >> lane & 1U) != 0) lanes |= 0xFFU << 8 * lane;
    }
    write(address, data, strobes);
    if (const auto word = kept.find(address); word != kept.end()) {
      const std::uint32_t reached = lanes & word->second;
      expected[address] = (expected[address] & ~reached) | (data & reached);
    }
    const unsigned other = random.below(4) == 0 ? random.below(0x400) * 4 : address;
    const auto word = expected.find(other);
    ASSERT_EQ(read(other), word == expected.end() ? 0U : word->second)
        << std::hex << other << " after " << address;
    ASSERT_EQ(m.driver_off_o, expected[0] & 1U);
  }
}

// ---- Side effects -------------------------------------------------------------------------------

TEST_P(DslRegsBlock, Prst_IsALevel_OrAPulseInTheSdk) {
  EXPECT_EQ(m.hold_o, 0);
  unsigned ones = 0;
  const auto counted = [&] {
    clock();
    ones += m.hold_o;
  };
  dsl_registers::access(m, 0, true, map::PRST::kMask, 1, counted);
  for (unsigned i = 0; i < 20; ++i) counted();
  EXPECT_EQ(m.hold_o, sdk() ? 0 : 1);
  if (sdk()) {
    EXPECT_EQ(ones, 1U);
  }
  EXPECT_EQ(read(0) & 0xFFU, sdk() ? 0U : 0x80U);
  write(0, 0, 1);
  EXPECT_EQ(m.hold_o, 0);
  // SAFE_CTRL.
  ones = 0;
  dsl_registers::access(m, map::kAddrSafeCtrl & ~3U, true, 0x8000, 2, counted);
  for (unsigned i = 0; i < 20; ++i) counted();
  EXPECT_EQ(ones, sdk() ? 1U : 0U);
}

TEST_P(DslRegsBlock, LimitOfMissing_IsWrittenAtTheAddressOfThePersonality) {
  EXPECT_EQ(m.limit_o, 31);
  told.missing = 11;
  write_byte(map::kAddrAccErrCnt, 0xE5);
  EXPECT_EQ(m.limit_o, sdk() ? 31 : 5);
  write_byte(map::kAddrAccErrCntThresh, 0xE9);
  EXPECT_EQ(m.limit_o, sdk() ? 9 : 5);
  EXPECT_EQ(read_byte(map::kAddrAccErrCnt), 11);
  EXPECT_EQ(read_byte(map::kAddrAccErrCntThresh), sdk() ? 9 : 0);
}

TEST_P(DslRegsBlock, Status_IsOfNow) {
  for (unsigned i = 0; i < 300; ++i) {
    status = {.place = random.below(4096),
              .edges = random.below(256),
              .rssi = random.below(13),
              .quality = random.below(16),
              .identity = random.below(1U << 20U),
              .illegal = random.below(65536),
              .resets = random.below(65536),
              .reason = random.below(8),
              .state = random.below(9)};
    told = {.missing = random.below(32),
            .safe1_valid = random.below(2) != 0,
            .safe1_error = random.below(2) != 0,
            .safe2_valid = random.below(2) != 0,
            .safe2_error = random.below(2) != 0};
    answer.linked = random.below(2) != 0;
    answer.running = random.below(2) != 0;
    m.lost_i = static_cast<CData>(random.below(2));
    pulse(m.ended_i);
    const unsigned place = status.place;
    const unsigned rssi = status.rssi;
    status.place = random.below(4096);  // they move, what is shown stays
    status.rssi = random.below(16);
    const unsigned delay = place >> 8U;
    const unsigned error = told.safe1_error || told.safe2_error ? 1 : 0;
    EXPECT_EQ(read(page::kAddrStatus),
              status.reason << 24U | status.state << 16U | delay << 12U | status.quality << 8U |
                  error << 5U | (told.safe2_valid && answer.linked ? 16U : 0U) |
                  (told.safe1_valid && answer.linked ? 8U : 0U) | (answer.running ? 4U : 0U) |
                  (answer.linked ? 2U : 0U) | m.lost_i);
    EXPECT_EQ(read_byte(map::kAddrMasterQm), (answer.linked ? 0x80U : 0U) | status.quality);
    EXPECT_EQ(read_byte(map::kAddrEdges), status.edges);
    EXPECT_EQ(read_byte(map::kAddrDelay), rssi << 4U | delay);
    EXPECT_EQ(read_byte(map::kAddrEncId2), status.identity >> 16U);
    EXPECT_EQ(read_byte(map::kAddrEncId1), status.identity >> 8U & 0xFFU);
    EXPECT_EQ(read_byte(map::kAddrEncId0), status.identity & 0xFFU);
    EXPECT_EQ(read(page::kAddrRestarts), status.illegal << 16U | status.resets);
    EXPECT_EQ(read(page::kAddrSamplePlace), place);
  }
}

// Two bytes of a number are never of two of its values.
TEST_P(DslRegsBlock, NumbersThatChange_AreReadWhole) {
  for (unsigned i = 0; i < 2000; ++i) {
    status.resets = status.illegal = 0x01FF;
    const unsigned when = random.below(12);
    const bool illegal = random.below(2) != 0;
    unsigned at = 0;
    const std::uint32_t word = dsl_registers::access(m, page::kAddrRestarts, false, 0, 0xF, [&] {
      // ended_i is there with the new number of restarts, a word before that of illegal ones.
      answer.valid = illegal && at + 1 == when;
      m.ended_i = !illegal && at == when ? 1 : 0;
      if (at == when) (illegal ? status.illegal : status.resets) = 0x0200;
      ++at;
      clock();
    });
    m.ended_i = 0;
    answer.valid = false;
    const unsigned value = illegal ? word >> 16U : word & 0xFFFFU;
    ASSERT_TRUE(value == 0x01FF || value == 0x0200) << value << " at " << when;
  }
}

// ---- Events -------------------------------------------------------------------------------------

TEST_P(DslRegsBlock, EachEvent_SetsItsBit) {
  const auto events = [this] { return read(map::kAddrEventH) & 0xFFFFU; };
  const unsigned low = map::QMLW::kMask << 8U;
  // The first start: from the gap to RESET.
  EXPECT_EQ(events(), 0U);
  status.state = 1;
  clock();
  clock();
  EXPECT_EQ(events(), map::EVENT_PRST::kMask);
  clear_events();
  // A link begins: no position yet.
  answer.linked = true;
  pulse(m.tell_i);
  EXPECT_EQ(events(), map::POS::kMask);
  m.lost_i = 0;
  clear_events();
  told.safe1_valid = true;
  tell(0, 0);
  tell(7, 0);
  EXPECT_EQ(events(), 0U);
  tell(6, 0x10);
  EXPECT_EQ(events(), 0U);
  tell(7, 0x10);
  EXPECT_EQ(events(), map::SUM::kMask);
  clear_events();
  told = {.safe1_error = true};
  tell(3, 0x10);
  EXPECT_EQ(events(), 0U);
  tell(7, 0x10);
  EXPECT_EQ(events(), map::SCE::kMask);
  clear_events();
  told = {.safe1_valid = true, .safe2_error = true};
  tell(7, 0);
  EXPECT_EQ(events(), map::SCE::kMask);
  clear_events();
  told = {};
  tell(7, 0);
  EXPECT_EQ(events(), map::VPOS::kMask);
  clear_events();
  // POS with its rise, and with each record while it lasts.
  m.lost_i = 1;
  clock();
  clock();
  EXPECT_EQ(events(), map::POS::kMask);
  clear_events();
  tell(2, 0);
  EXPECT_EQ(events(), map::POS::kMask);
  m.lost_i = 0;
  clear_events();
  status.low = 1;
  pulse(m.ended_i);
  EXPECT_EQ(events(), low);
  status.low = 0;
  // A restart.
  clear_events();
  answer.linked = answer.running = false;
  status.state = 0;
  clock();
  EXPECT_EQ(events(), 0U);
  status.low = 1;
  pulse(m.ended_i);
  status.state = 1;
  clock();
  clock();
  EXPECT_EQ(events(), map::EVENT_PRST::kMask);
}

TEST_P(DslRegsBlock, WritingAnEvent_ZeroClearsOneKeeps_AndASetWins) {
  unsigned wins = 0;
  for (unsigned i = 0; i < 3000; ++i) {
    // PRST and POS are set, and then written with anything.
    status.state = 0;
    m.lost_i = 0;
    clock();
    clock();
    status.state = 1;
    m.lost_i = 1;
    clock();
    clock();
    const unsigned both = map::EVENT_PRST::kMask | map::POS::kMask;
    ASSERT_EQ(read(map::kAddrEventH) & 0xFFFFU, both);
    m.lost_i = 0;
    const unsigned data = random.below(256);
    const unsigned when = random.below(14);
    unsigned at = 0;
    bool set_before = true;
    dsl_registers::access(m, map::kAddrEventH, true, data, 0x1, [&] {
      if (at++ == when) m.lost_i = 1;
      clock();
    });
    set_before = at > when;
    // The write is done in the second clock of the access: a set in it or later stays.
    unsigned expected = both & data;
    if (set_before && when >= 1) expected |= map::POS::kMask;
    if (set_before && when == 1 && (data & map::POS::kMask) == 0) ++wins;
    ASSERT_EQ(read(map::kAddrEventH) & 0xFFFFU, expected) << "data " << data << " at " << when;
    write(map::kAddrEventH, 0, 1);
  }
  EXPECT_GT(wins, 20U);
}

TEST_P(DslRegsBlock, Interrupts_OfFramesAndLosses) {
  m.lost_i = 0;
  for (unsigned i = 0; i < 10; ++i) clock();
  write(page::kAddrIrqStatus, 0x1F, 1);
  ASSERT_EQ(read(page::kAddrIrqStatus), 0U);
  const auto settle = [this] {
    for (unsigned i = 0; i < 12; ++i) clock();
  };
  answer.linked = true;
  pulse(m.tell_i);  // of a link that begins: no frame
  settle();
  EXPECT_EQ(read(page::kAddrIrqStatus), 0U);
  tell(0, 0);
  settle();
  EXPECT_EQ(read(page::kAddrIrqStatus), page::FRAME_ENDED::kMask);
  EXPECT_EQ(m.irq_o, 0);
  write(page::kAddrIrqEnable, page::FRAME_ENDED_ENABLE::kMask, 1);
  EXPECT_EQ(m.irq_o, 1);
  tell(1, 0);
  settle();
  EXPECT_EQ(read(page::kAddrIrqStatus), page::FRAME_ENDED::kMask | page::FRAME_LOST::kMask);
  write(page::kAddrIrqStatus, 0x1F, 1);
  EXPECT_EQ(m.irq_o, 0);
  m.lost_i = 1;
  settle();
  EXPECT_EQ(read(page::kAddrIrqStatus), page::LINK_LOST::kMask);
  write(page::kAddrIrqStatus, 0x1F, 1);
  answer.linked = false;
  settle();
  EXPECT_EQ(read(page::kAddrIrqStatus), page::LINK_LOST::kMask);
}

// ---- Records ------------------------------------------------------------------------------------

TEST_P(DslRegsBlock, ReadersOfRecords_SeeTheCopyOfTheirGroup) {
  std::array<Record, kGroups> copies{};
  tell(0, 0);
  for (const WordOfRecord& word : kWords) {
    if (dsl_registers::is_first(word)) {
      read(word.address);
      copies[word.group] = newest;
    }
  }
  for (unsigned i = 0; i < 5000; ++i) {
    if (random.below(3) == 0) tell(random.below(8), random.below(256));
    if (random.below(10) == 0) {
      ASSERT_EQ(read_byte(map::kAddrSafeSum), sdk() ? newest[kSummary] : 0);
    }
    const WordOfRecord& word = kWords[random.below(std::size(kWords))];
    const bool copying = dsl_registers::is_first(word);
    if (copying) copies[word.group] = newest;
    // A new record while the word is read, behind its first byte, changes nothing of it.
    const unsigned when = 2 + random.below(12);
    unsigned at = 0;
    const std::uint32_t value =
        dsl_registers::access(m, word.address, false, 0, 0xF, [this, when, &at] {
          if (at++ == when) {
            for (std::uint8_t& byte : newest) byte = static_cast<std::uint8_t>(random.below(256));
          }
          clock();
        });
    const std::uint32_t expected = dsl_registers::word_of(word, copies[word.group]);
    ASSERT_EQ(value, expected) << std::hex << word.address << std::dec << " turn " << i;
    if (random.below(4) == 0) write(word.address, ~expected, 0xF);
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, DslRegsBlock, testing::Values(false, true),
                         [](const auto& sdk) { return sdk.param ? "Sdk" : "Ours"; });

}  // namespace
