// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The host's half of the master: values after the reset, who may write what, side effects, and
// which byte of which record each address shows. The memory of records is one of this test.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>

#include "Vdsl_host_top.h"
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
constexpr unsigned kStatus2 = 45;
namespace at = mb4test::places::dsl_pkg;
constexpr unsigned kMarked1 = at::safe_checks_t::kMarked1(1);
constexpr unsigned kMarked2 = at::safe_checks_t::kMarked2(1);

// dsl_pkg::told_t without what is told of the acceleration.
struct ToldPort {
  unsigned checks = 0;  // bits of dsl_pkg::safe_checks_t
  unsigned missing = 0;
  bool safe1_valid = false, safe1_error = false, safe2_valid = false, safe2_error = false;
  unsigned bits() const {
    using namespace at::told_t;
    return static_cast<unsigned>(kChecks(checks) | kMissing(missing) | kSafe1Valid(safe1_valid) |
                                 kSafe1Error(safe1_error) | kSafe2Valid(safe2_valid) |
                                 kSafe2Error(safe2_error));
  }
};

class DslRegsBlock : public testing::TestWithParam<bool> {
 protected:
  DslRegsBlock() { start(); }

  void start() {
    m.rst_ni = 0;
    m.quirks_i = dsl_frames::quirks_of({.sdk_map = sdk()});
    m.word_req_i = m.ended_i = m.tell_i = m.begin_i = m.edge_i = m.stale_i = m.mismatch_i =
        m.counts_i = m.record_write_i = m.time_copied_i = 0;
    m.lost_i = 1;
    m.record_data_i = m.time_data_i = 0;
    apply();
    block.reset();
  }
  bool sdk() const { return GetParam(); }

  void apply() {
    m.status_i = status.bits();
    m.answer_i = answer.bits();
    m.told_i = told.bits();
    m.eval();
  }
  void clock() {
    apply();
    std::uint8_t next = static_cast<std::uint8_t>(random.below(256));
    if (m.record_read_o != 0) next = asked[m.record_address_o];
    const unsigned group = m.record_group_o;
    if (m.record_hold_o != 0) {
      EXPECT_LT(group, kGroups);
      held[group % kGroups] = newest;
    }
    asked = group < kGroups ? held[group] : newest;
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
  void record_byte(unsigned place, unsigned byte) {
    newest[place] = static_cast<std::uint8_t>(byte);
    m.record_write_i = 1;
    m.record_address_i = static_cast<CData>(place);
    m.record_byte_i = newest[place];
    clock();
    m.record_write_i = 0;
  }
  void clear_events() {
    write(map::kAddrEventH, 0, 0x3);
    ASSERT_EQ(read(map::kAddrEventH), 0U);
  }

  mb4test::Dice random;
  mb4test::Block<Vdsl_host_top> block;
  Vdsl_host_top& m = block.model;
  dsl_frames::AnswerPort answer;
  dsl_frames::StatusPort status;
  ToldPort told;
  Record newest{};
  std::array<Record, kGroups> held{};
  Record asked{};  // the group that was asked for in the clock before
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

// What can be written keeps it; everything else stays as it is. Each lane has its own strobe. What
// starts a message, or resets them, is not written here.
TEST_P(DslRegsBlock, WritesAtRandom_ReachWhatTheMapSays) {
  auto expected = reset_words(sdk());
  if (sdk()) expected[page::kAddrFeatures] |= 1U << 3U;
  std::map<unsigned, std::uint32_t> kept = {{page::kAddrIrqEnable, 0x7F},
                                            {page::kAddrSafeCheck, 0xFFFF}};
  const auto keeps = [&kept](unsigned address, unsigned mask) {
    kept[address & ~3U] |= mask << 8 * (address & 3U);
  };
  keeps(map::kAddrSysCtrl, sdk() ? 0x01 : 0x81);
  keeps(map::kAddrSyncCtrl, 0xFF);
  keeps(map::kAddrMaskH, 0x6D);
  keeps(map::kAddrMaskL, 0x37);
  keeps(map::kAddrMaskSum, 0xFF);
  keeps(map::kAddrMaskS, 0x7F);
  for (unsigned i = 0; i < 8; ++i) keeps(map::kAddrPcBuffer0 + i, 0xFF);
  keeps(map::kAddrPcAddH, 0x7F);
  keeps(map::kAddrPcAddL, 0xFF);
  keeps(map::kAddrPcOffH, 0x7F);
  keeps(map::kAddrPcOffL, 0xFF);
  keeps(map::kAddrPcData, 0xFF);
  keeps(map::kAddrSPcData, 0xFF);
  if (sdk()) {
    keeps(map::kAddrAccErrCntThresh, 0x1F);
  } else {
    keeps(map::kAddrMaxacc, 0xFF);
  }
  const auto byte_of = [](std::uint32_t& word, unsigned address, unsigned value) {
    const unsigned shift = 8 * (address & 3U);
    word = (word & ~(0xFFU << shift)) | value << shift;
  };
  for (unsigned i = 0; i < 8000; ++i) {
    unsigned address = random.below(3) != 0 ? random.below(0x80) * 4 : random.below(0x400) * 4;
    if (random.below(2) == 0) {
      auto word = kept.begin();
      std::advance(word, random.below(static_cast<unsigned>(kept.size())));
      address = word->first;
    }
    std::uint32_t data = random.below(1U << 16U) << 16U | random.below(1U << 16U);
    if (address == (map::kAddrPcCtrl & ~3U)) data &= ~1U;
    if (address == map::kAddrSysCtrl) data &= ~map::MRST::kMask;
    if (address == (map::kAddrSafeCtrl & ~3U)) {
      byte_of(data, map::kAddrSSlaveRegCtrl, 0x3F);
      byte_of(data, map::kAddrSafeCtrl, 0);
    }
    if (address == map::kAddrSlaveRegCtrl) byte_of(data, map::kAddrSlaveRegCtrl, 0x3F);
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
    // The SDK has one byte of data for short messages.
    const bool own = address == (map::kAddrPcData & ~3U);
    if (sdk() && (strobes & 8U) != 0 && (own || address == (map::kAddrSPcData & ~3U))) {
      byte_of(expected[map::kAddrPcData & ~3U], map::kAddrPcData, data >> 24U);
      byte_of(expected[map::kAddrSPcData & ~3U], map::kAddrSPcData, data >> 24U);
    }
    const unsigned other = random.below(4) == 0 ? random.below(0x400) * 4 : address;
    const auto word = expected.find(other);
    ASSERT_EQ(read(other), word == expected.end() ? 0U : word->second)
        << std::hex << other << " after " << address;
    ASSERT_EQ(m.driver_off_o, expected[0] & 1U);
    ASSERT_EQ(m.safe2_bits_o, expected[page::kAddrSafeCheck] & 0xFFU);
    ASSERT_EQ(m.tolerance_o, expected[page::kAddrSafeCheck] >> 8U & 0xFFU);
  }
}

// An access that comes with the end of the reset waits for the first values of the memory.
TEST_P(DslRegsBlock, AccessInTheClocksBehindTheReset_WaitsForTheFirstValues) {
  for (unsigned clocks = 0; clocks < 60; ++clocks) {
    start();
    for (unsigned i = 0; i < clocks; ++i) clock();
    write_byte(map::kAddrMaskL, map::MQMLW::kMask);
    EXPECT_EQ(read_byte(map::kAddrMaskL), map::MQMLW::kMask) << clocks;
    EXPECT_EQ(read_byte(map::kAddrPcOffH), map::OFF_LID::kMask) << clocks;
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
    status = {.state = random.below(9),
              .reason = random.below(8),
              .identity = random.below(1U << 20U),
              .quality = random.below(16),
              .rssi = random.below(13),
              .edges = random.below(256),
              .place = random.below(4096)};
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
    EXPECT_EQ(read(page::kAddrSamplePlace), place);
  }
}

// Restarts and illegal words are counted, and two bytes of a number are never of two of its values.
TEST_P(DslRegsBlock, NumbersThatChange_AreReadWhole) {
  unsigned restarts = 0;
  unsigned illegal = 0;
  const auto count = [&](bool restart) {
    m.counts_i = restart ? 2 : 1;
    ++(restart ? restarts : illegal);
    clock();
    m.counts_i = 0;
  };
  const auto settle = [this] {
    for (unsigned i = 0; i < 10; ++i) clock();
  };
  for (unsigned i = 0; i < 60; ++i) clock();
  for (unsigned i = 0; i < 3000; ++i) {
    // Mostly near a carry.
    for (unsigned j = random.below(3) == 0 ? 250 : random.below(4); j != 0; --j) {
      count(random.below(2) != 0);
      settle();
    }
    const unsigned when = random.below(12);
    const bool restart = random.below(2) != 0;
    const std::uint32_t before = illegal << 16U | (restarts & 0xFFFFU);
    unsigned at = 0;
    const std::uint32_t word = dsl_registers::access(m, page::kAddrRestarts, false, 0, 0xF, [&] {
      if (at++ == when) {
        count(restart);
      } else {
        clock();
      }
    });
    const std::uint32_t behind = illegal << 16U | (restarts & 0xFFFFU);
    ASSERT_TRUE(word == before || word == behind) << std::hex << word << " at " << when;
    settle();
    ASSERT_EQ(read(page::kAddrRestarts), behind);
  }
}

// ---- Events -------------------------------------------------------------------------------------

TEST_P(DslRegsBlock, EachEvent_SetsItsBits) {
  const auto events = [this] { return read(map::kAddrEventH) & 0xFFFFU; };
  const auto safe_events = [this] { return read_byte(map::kAddrEventS); };
  const unsigned low = map::QMLW::kMask << 8U;
  const unsigned free = (map::FREL::kMask | map::FRES::kMask) << 8U;
  const auto clear = [&] {
    clear_events();
    write_byte(map::kAddrEventS, 0);
    ASSERT_EQ(safe_events(), 0U);
  };
  write_byte(map::kAddrMaskSum, 0x30);
  // The first start: from the gap to RESET.
  EXPECT_EQ(events(), 0U);
  status.state = 1;
  clock();
  clock();
  EXPECT_EQ(events(), map::EVENT_PRST::kMask);
  EXPECT_EQ(safe_events(), map::S_PRST::kMask);
  clear();
  // A link begins: no position yet.
  answer.linked = true;
  pulse(m.tell_i);
  EXPECT_EQ(events(), map::POS::kMask);
  EXPECT_EQ(safe_events(), 0U);
  m.lost_i = 0;
  clear();
  // Its first running frame.
  told.safe1_valid = true;
  tell(0, 0);
  EXPECT_EQ(events(), free);
  EXPECT_EQ(safe_events(), map::S_FRES::kMask);
  clear();
  tell(7, 0);
  EXPECT_EQ(events(), 0U);
  tell(6, 0x10);
  EXPECT_EQ(events(), 0U);
  EXPECT_EQ(safe_events(), 0U);
  tell(7, 0x10);
  EXPECT_EQ(events(), map::SUM::kMask);
  EXPECT_EQ(safe_events(), map::SSUM::kMask);
  clear();
  // A bit that MASK_SUM leaves out.
  tell(7, 0x40);
  EXPECT_EQ(events(), 0U);
  EXPECT_EQ(safe_events(), map::SSUM::kMask);
  clear();
  told = {.safe1_error = true};
  tell(3, 0x10);
  EXPECT_EQ(events(), 0U);
  tell(7, 0x10);
  EXPECT_EQ(events(), map::SCE::kMask);
  EXPECT_EQ(safe_events(), map::S_SCE::kMask);
  clear();
  told = {.safe1_valid = true, .safe2_error = true};
  tell(7, 0);
  EXPECT_EQ(events(), map::SCE::kMask);
  EXPECT_EQ(safe_events(), 0U);
  clear();
  told = {.checks = kMarked1};
  tell(7, 0);
  EXPECT_EQ(events(), map::VPOS::kMask);
  EXPECT_EQ(safe_events(), map::S_VPOS::kMask);
  clear();
  // POS with its rise, and with each record while it lasts.
  told = {};
  m.lost_i = 1;
  clock();
  clock();
  EXPECT_EQ(events(), map::POS::kMask);
  clear();
  tell(2, 0);
  EXPECT_EQ(events(), map::POS::kMask);
  EXPECT_EQ(safe_events(), 0U);
  m.lost_i = 0;
  clear();
  status.low = 1;
  pulse(m.ended_i);
  EXPECT_EQ(events(), low);
  EXPECT_EQ(safe_events(), map::S_QMLW::kMask);
  status.low = 0;
  // A restart.
  clear();
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

// An event register, and what sets some of its bits.
struct Cause {
  unsigned address;
  unsigned mask_address;
  unsigned mask;
  unsigned high;  // INT or SINT, of its byte
};
constexpr Cause kCauses[] = {
    {map::kAddrEventH, map::kAddrMaskH, map::POS::kMask | map::EVENT_PRST::kMask, 1},
    {map::kAddrEventL, map::kAddrMaskL, map::QMLW::kMask, 0},
    {map::kAddrEventS, map::kAddrMaskS, map::S_QMLW::kMask | map::S_PRST::kMask, 2},
};

// INT and SINT are events and masks as they are now: they are no bits of their own.
TEST_P(DslRegsBlock, IntFollowsEventsAndMasks_AndItsRiseIsAnInterrupt) {
  answer.linked = true;
  m.lost_i = 0;
  status.state = 1;
  clock();
  clock();
  write(page::kAddrIrqEnable, 0x7F, 1);
  unsigned rises = 0;
  for (unsigned i = 0; i < 3000; ++i) {
    write(map::kAddrEventH, 0, 3);
    write_byte(map::kAddrEventS, 0);
    write(page::kAddrIrqStatus, 0x7F, 1);
    const unsigned masks = random.below(1U << 16U);
    const unsigned safe_mask = random.below(256);
    write(map::kAddrMaskH & ~3U, masks << 16U, 0xC);
    write_byte(map::kAddrMaskS, safe_mask);
    // Some of POS, QMLW, PRST.
    const bool pos = random.below(2) != 0, low = random.below(2) != 0, prst = random.below(2) != 0;
    std::array<unsigned, 2> pulses{};
    const auto counted = [&] {
      clock();
      pulses[0] += at::causes_t::kMainEvent.of(m.interrupts_o) != 0 ? 1 : 0;
      pulses[1] += at::causes_t::kSafeEvent.of(m.interrupts_o) != 0 ? 1 : 0;
    };
    status.state = prst ? 0 : 1;
    counted();
    counted();
    status.state = 1;
    status.low = low ? 1 : 0;
    m.ended_i = low ? 1 : 0;
    m.lost_i = pos ? 1 : 0;
    counted();
    m.ended_i = m.lost_i = 0;
    for (unsigned j = 0; j < 4; ++j) counted();
    const unsigned h = (pos ? map::POS::kMask : 0U) | (prst ? map::EVENT_PRST::kMask : 0U);
    const unsigned l = low ? map::QMLW::kMask : 0U;
    const unsigned s = (low ? map::S_QMLW::kMask : 0U) | (prst ? map::S_PRST::kMask : 0U);
    const bool interrupt = (h & masks) != 0 || (l & masks >> 8U) != 0;
    const bool safe_interrupt = (s & safe_mask) != 0;
    rises += interrupt ? 1 : 0;
    ASSERT_EQ(read(map::kAddrEventH) & 0xFFFFU, h | (interrupt ? 0x80U : 0U) | l << 8U);
    ASSERT_EQ(read_byte(map::kAddrEventS), s | (safe_interrupt ? 0x80U : 0U));
    ASSERT_EQ(pulses[0], interrupt ? 1U : 0U);
    ASSERT_EQ(pulses[1], safe_interrupt ? 1U : 0U);
    const unsigned irq = (interrupt ? page::EVENT::kMask : 0U) |
                         (safe_interrupt ? page::SAFE_EVENT::kMask : 0U) |
                         (pos ? page::LINK_LOST::kMask : 0U);
    ASSERT_EQ(read(page::kAddrIrqStatus), irq);
    ASSERT_EQ(m.irq_o, irq != 0 ? 1 : 0);
    // A mask alone lowers it, and raises it again.
    write(map::kAddrMaskH & ~3U, 0, 0xC);
    ASSERT_EQ(read_byte(map::kAddrEventH), h);
    write(map::kAddrMaskH & ~3U, masks << 16U, 0xC);
    ASSERT_EQ(read_byte(map::kAddrEventH), h | (interrupt ? 0x80U : 0U));
  }
  EXPECT_GT(rises, 500U);
}

// R18. Each bit is set and cleared at random: none that is set is lost, and none stays that was
// cleared after it.
TEST_P(DslRegsBlock, RacesOfSetAndClear_LoseNoEvent) {
  constexpr unsigned kTurns = 100'000;
  struct Bit {
    unsigned address;
    unsigned mask;
  };
  // What one clock of each cause sets.
  const auto lost = std::array{Bit{map::kAddrEventH, map::POS::kMask}};
  const auto low = std::array{Bit{map::kAddrEventL, map::QMLW::kMask},
                              Bit{map::kAddrEventS, map::S_QMLW::kMask}};
  const auto starts = std::array{Bit{map::kAddrEventH, map::EVENT_PRST::kMask},
                                 Bit{map::kAddrEventS, map::S_PRST::kMask}};
  std::map<unsigned, unsigned> bits;  // by address, as they must be
  answer.linked = true;
  m.lost_i = 0;
  status.state = 1;
  clock();
  clock();
  write(map::kAddrEventH, 0, 3);
  write_byte(map::kAddrEventS, 0);
  const auto set = [&bits](const auto& some) {
    for (const Bit& bit : some) bits[bit.address] |= bit.mask;
  };
  unsigned races = 0;
  for (unsigned i = 0; i < kTurns; ++i) {
    const unsigned kind = random.below(3);
    const unsigned address = kCauses[random.below(3)].address;
    const unsigned data = random.below(256);
    // A byte is written in clock 2 and its lane; a set comes with clock `when`.
    const unsigned lane = address & 3U;
    const unsigned writes = 2 + lane;
    const unsigned when = 1 + random.below(4);
    if (kind == 2) {
      status.state = 0;
      clock();
      clock();
    }
    unsigned at = 0;
    const auto step = [&] {
      // The write takes effect with this clock, and a set with it wins.
      if (at == writes) bits[address] &= data;
      if (at == when) {
        if (kind == 0) m.lost_i = 1;
        if (kind == 1) status.low = 1, m.ended_i = 1;
        if (kind == 2) status.state = 1;
        if (kind == 0) set(lost);
        if (kind == 1) set(low);
        if (kind == 2) set(starts);
        races += at == writes ? 1 : 0;
      }
      clock();
      m.ended_i = 0;
      status.low = 0;
      ++at;
    };
    dsl_registers::access(m, address & ~3U, true, data << 8 * lane, 1U << lane, step);
    m.lost_i = 0;
    status.state = 1;
    clock();
    ASSERT_EQ(read(map::kAddrEventH) & 0xFFFFU,
              bits[map::kAddrEventH] | bits[map::kAddrEventL] << 8U)
        << "turn " << i << " kind " << kind << " when " << when;
    ASSERT_EQ(read_byte(map::kAddrEventS), bits[map::kAddrEventS]) << "turn " << i;
  }
  EXPECT_GT(races, kTurns / 10);
}

// Registers without a memory: the state of each host now.
TEST_P(DslRegsBlock, OnlineStatus_IsOfNow) {
  write_byte(map::kAddrMaskSum, 0x0F);
  answer.linked = true;
  tell(0, 0);
  for (unsigned i = 0; i < 2000; ++i) {
    write(map::kAddrEventH, 0, 3);
    write_byte(map::kAddrEventS, 0);
    answer.linked = answer.running = random.below(5) != 0;
    const unsigned checks = random.below(4) * kMarked1;
    told = {
        .checks = checks, .safe1_error = random.below(2) != 0, .safe2_error = random.below(2) != 0};
    const unsigned summary = random.below(3) == 0 ? 0 : random.below(256);
    const unsigned status2 = random.below(256);
    record_byte(kSummary, summary);
    record_byte(kStatus2, status2);
    status.low = random.below(2);
    m.lost_i = static_cast<CData>(random.below(2));
    clock();
    clock();
    const bool linked = answer.linked;
    const auto bit = [](bool level, unsigned mask) { return level ? mask : 0U; };
    const unsigned low = bit(linked && status.low != 0, 0x04);
    const unsigned prst = bit(!linked, 0x01);
    const unsigned vpos = bit(linked && (checks & kMarked1) != 0, 0x04);
    const unsigned vpos2 = bit(linked && (checks & kMarked2) != 0, 0x04);
    ASSERT_EQ(read(map::kAddrOnlineDH),
              (0x10U | bit(linked && (summary & 0x0FU) != 0, 0x40) |
               bit(linked && (told.safe1_error || told.safe2_error), 0x20) |
               bit(m.lost_i != 0, 0x08) | vpos | prst) |
                  (low | bit(linked, 0x03)) << 8U |
                  (0x10U | bit(linked && summary != 0, 0x40) |
                   bit(linked && told.safe1_error, 0x20) | vpos | prst)
                      << 16U |
                  (low | bit(linked, 0x01)) << 24U);
    ASSERT_EQ(read(map::kAddrOnline2H), (0x10U | bit(linked && (status2 & 0x60U) != 0, 0x40) |
                                         bit(linked && told.safe2_error, 0x20) | vpos2 | prst) |
                                            ((status2 & 0xE0U) | low) << 8U);
  }
}

TEST_P(DslRegsBlock, Postx_TellsWhatHasCome) {
  EXPECT_EQ(read_byte(map::kAddrPostx), 0U);
  for (unsigned i = 0; i < 200; ++i) {
    told = {.safe1_valid = random.below(2) != 0, .safe2_valid = random.below(2) != 0};
    const unsigned place = random.below(2) != 0 ? 7 : random.below(7);
    tell(place, 0);
    unsigned expected = 2;
    if (place == 7 && told.safe1_valid) expected = sdk() ? 3 : 1;
    if (place == 7 && told.safe2_valid && !sdk()) expected = 3;
    ASSERT_EQ(read_byte(map::kAddrPostx), expected);
    const unsigned ready = m.interrupts_o;
    EXPECT_EQ(ready, 0U);
    pulse(m.edge_i);
    ASSERT_EQ(read_byte(map::kAddrPostx), 0U);
  }
}

TEST_P(DslRegsBlock, Checks_AreShownBitByBit) {
  for (unsigned i = 0; i < 500; ++i) {
    told = {.checks = random.below(1U << 13U)};
    m.stale_i = static_cast<CData>(random.below(2));
    m.mismatch_i = static_cast<CData>(random.below(2));
    clock();
    // VSYNC late stands above STALE.
    const unsigned expected = (told.checks & 0xFFFU) << 1U | m.mismatch_i |
                              (m.stale_i != 0 ? page::STALE::kMask : 0U) |
                              ((told.checks >> 12U) != 0 ? page::VSYNC_LATE::kMask : 0U);
    ASSERT_EQ(read(page::kAddrSafeStatus), expected);
  }
}

// The byte of the sensors.
TEST_P(DslRegsBlock, Pipeline_LastGoodByteAndItsState) {
  answer.linked = answer.running = true;
  unsigned last = 0;
  for (unsigned i = 0; i < 300; ++i) {
    answer.number = random.below(6);
    answer.word = {.byte = static_cast<std::uint8_t>(random.below(256)),
                   .error = random.below(4) == 0,
                   .special = random.below(4) == 0};
    const bool pipeline = answer.number == 2;
    if (pipeline && !answer.word.error) last = answer.word.byte;
    answer.valid = true;
    clock();
    answer.valid = false;
    EXPECT_EQ(read_byte(map::kAddrPipeD), last);
    if (!pipeline) continue;
    const unsigned state =
        (answer.word.error ? map::PERR::kMask : 0U) | (answer.word.special ? map::PSCI::kMask : 0U);
    EXPECT_EQ(read_byte(map::kAddrPipeS), sdk() ? 0U : state);
  }
  answer.linked = answer.running = false;
  clock();
  EXPECT_EQ(read_byte(map::kAddrPipeS), sdk() ? 0U : map::PEMP::kMask);
  EXPECT_EQ(read_byte(map::kAddrPipeD), last);
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
    // The write is done in the third clock of the access: a set in it or later stays.
    unsigned expected = both & data;
    if (set_before && when >= 2) expected |= map::POS::kMask;
    if (set_before && when == 2 && (data & map::POS::kMask) == 0) ++wins;
    ASSERT_EQ(read(map::kAddrEventH) & 0xFFFFU, expected) << "data " << data << " at " << when;
    write(map::kAddrEventH, 0, 1);
  }
  EXPECT_GT(wins, 20U);
}

TEST_P(DslRegsBlock, Interrupts_OfFramesAndLosses) {
  m.lost_i = 0;
  for (unsigned i = 0; i < 10; ++i) clock();
  write(page::kAddrIrqStatus, 0x7F, 1);
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
  // Safe positions.
  for (unsigned i = 0; i < 200; ++i) {
    write(page::kAddrIrqStatus, 0x7F, 1);
    told = {.safe1_valid = random.below(2) != 0, .safe2_valid = random.below(2) != 0};
    const unsigned place = random.below(2) != 0 ? 7 : random.below(7);
    tell(place, 0);
    const bool whole = place == 7;
    EXPECT_EQ(read(page::kAddrIrqStatus),
              page::FRAME_ENDED::kMask |
                  (whole && told.safe1_valid ? page::SAFE1_READY::kMask : 0U) |
                  (whole && told.safe2_valid ? page::SAFE2_READY::kMask : 0U));
  }
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
    ASSERT_EQ(value & dsl_registers::bits_of_group(word), expected)
        << std::hex << word.address << std::dec << " turn " << i;
    if (random.below(4) == 0) write(word.address, ~expected, 0xF);
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, DslRegsBlock, testing::Values(false, true),
                         [](const auto& sdk) { return sdk.param ? "Sdk" : "Ours"; });

}  // namespace
