// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// MO of one line alone: pages 15, 25, 31, Tables 17, 18, 39, 40; docs/choices.md, "MO", 17 and 39.
// The test holds the list of words and the memory of their data.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "Vbiss_mo_tx.h"
#include "places.hpp"
#include "tests/block/biss/frame_bench.hpp"
#include "tests/block/biss/word.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace places = mb4test::places::biss_pkg;

using mb4test::bits_of;
using mb4test::line_word;
using mb4test::Word;

class MoTxBlock : public testing::Test {
 protected:
  struct Slot {
    Word word;
    unsigned channel = 0;
  };

  MoTxBlock() {
    m.begin_i = 0;
    m.line_idle_i = 1;
    m.data_i = 0;
    drive();
    block.reset();
  }
  // A clock; the list and the memory answer one clock later.
  void clock() {
    drive();
    m.eval();
    const bool next = m.next_o != 0;
    const bool read = places::mo_read_t::kRdEn.of(m.read_o) != 0;
    const std::uint64_t address =
        8 * places::mo_read_t::kSlave.of(m.read_o) + places::mo_read_t::kPlace.of(m.read_o);
    block.clock();
    if (next && at + 1 < slots.size()) ++at;
    if (read) m.data_i = memory[address];
    m.begin_i = 0;
    now.rise = now.last = false;
    drive();
    m.eval();
  }
  // A rising edge of MA; returns the level of MO after it.
  char rise(bool last = false) {
    const unsigned rest = 1 + random.below(4);
    for (unsigned i = 0; i < rest; ++i) clock();
    now.rise = true;
    now.last = last;
    clock();
    return m.mo_o != 0 ? '1' : '0';
  }
  void begin(bool biss_c, unsigned busy, bool reduced) {
    at = 0;
    now.enable = true;
    clock();
    now.biss_c = biss_c;
    now.busy = busy;
    now.reduced = reduced;
    now.clocks = true;
    m.line_idle_i = 0;
    m.begin_i = 1;
    clock();
  }
  void random_words() {
    slots.clear();
    for (auto& byte : memory) byte = static_cast<std::uint8_t>(random.below(256));
    const unsigned count = random.below(5);
    for (unsigned i = 0; i < count; ++i) {
      Slot slot;
      slot.channel = random.below(8);
      slot.word.data_bits = 1 + random.below(64);
      slot.word.polynomial = mb4test::kPolynomials[random.below(8)];
      slot.word.start = static_cast<std::uint16_t>(random.below(65536));
      slot.word.actuator = random.below(3) != 0;
      slot.word.stop = slot.word.actuator && random.below(2) != 0;
      slots.push_back(slot);
    }
  }
  // What the slots of all words carry: an actuator's stop bit, data and inverted CRC, or zeros.
  std::string payload() const {
    std::string text;
    for (const Slot& slot : slots) {
      std::uint64_t data = 0;
      for (unsigned i = 8; i-- > 0;) data = data << 8 | memory[8 * slot.channel + i];
      data &= ~std::uint64_t{0} >> (64 - slot.word.data_bits);
      const std::string word =
          line_word(data, slot.word.data_bits, slot.word.polynomial, slot.word.start);
      if (slot.word.stop) text += '0';
      text += slot.word.actuator ? word : std::string(word.size(), '0');
    }
    return text;
  }

  // What MO follows.
  struct Inputs {
    bool enable = false, low = false;
    unsigned busy = 0;
    bool reduced = false, returns = false;
    bool biss_c = false, rise = false, last = false, clocks = false;
  };
  Inputs now;
  std::vector<Slot> slots;
  std::size_t at = 0;
  std::array<std::uint8_t, 64> memory{};
  mb4test::Dice random;
  mb4test::Block<Vbiss_mo_tx> block;
  Vbiss_mo_tx& m = block.model;

 private:
  void drive() {
    m.cmd_i = static_cast<std::uint16_t>(places::line_cmd_t::kMoEn(now.enable) |
                                         places::line_cmd_t::kMoBusy(now.busy) |
                                         places::line_cmd_t::kMoLow(now.low));
    m.go_i = static_cast<std::uint8_t>(places::line_go_t::kReduced(now.reduced) |
                                       places::line_go_t::kMoReturn(now.returns));
    m.rise_i = now.rise;
    m.biss_c_i = now.biss_c;
    m.final_rise_i = now.last;
    m.ma_clocks_i = now.clocks;
    using namespace places::offer_t;
    m.offer_i = kLast(at + 1 >= slots.size());
    if (!slots.empty()) {
      m.offer_i |= kAny(1) | kSlave(slots[at].channel) | kWord(slots[at].word.port());
    }
  }
};

// MO falls with edge 2, shows the start bit with edge 3 + MO_BUSY, then CDS = 0 (BiSS C) and the
// words, and is 1 again with the edge after the last bit. On a longer line MA goes on: MO is 0
// then, and 1 when MA has stopped.
TEST_F(MoTxBlock, RandomFrames_SlotsCarryTheActuatorsWords) {
  for (int round = 0; round < 2'000; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    random_words();
    const bool biss_c = random.below(3) != 0;
    const bool reduced = biss_c && random.below(8) == 0;
    const unsigned busy = random.below(8) == 0 ? random.below(256) : random.below(5);
    const std::string expected =
        "10" + std::string(busy, '0') + "1" + (biss_c ? "0" : "") + (reduced ? "" : payload());
    begin(biss_c, busy, reduced);
    ASSERT_EQ(m.mo_o, 1) << "1 up to the acknowledge";
    std::string seen;
    for (std::size_t i = 0; i < expected.size(); ++i) seen += rise();
    ASSERT_EQ(seen, expected);
    if (random.below(2) != 0) {
      ASSERT_EQ(rise(true), '1') << "the edge after the last bit";
    } else {
      for (unsigned more = 1 + random.below(20); more > 0; --more) ASSERT_EQ(rise(), '0');
      now.clocks = false;
      clock();
      ASSERT_EQ(m.mo_o, 1) << "MA has stopped";
    }
    m.line_idle_i = 1;
    clock();
    ASSERT_EQ(m.mo_o, 1);
  }
}

// docs/choices.md: INIT is a frame that ends before the start bit; a frame may end before its last
// slot, if MO is not wired to the slaves. MO is 1 then, in whatever slot it was.
TEST_F(MoTxBlock, FrameThatEndsEarly_MoReturnsToOne) {
  for (int round = 0; round < 500; ++round) {
    random_words();
    const unsigned busy = random.below(4);
    begin(true, busy, false);
    const std::size_t all = 4 + busy + payload().size();
    for (std::size_t i = 0, count = random.below(static_cast<unsigned>(all)); i < count; ++i)
      rise();
    if (random.below(2) != 0) {
      now.returns = true;
    } else {
      m.line_idle_i = 1;
    }
    clock();
    ASSERT_EQ(m.mo_o, 1) << "round " << round;
    // It stays so while MA goes on.
    now.returns = false;
    m.line_idle_i = 1;
    ASSERT_EQ(rise(), '1') << "round " << round;
    ASSERT_EQ(rise(), '1') << "round " << round;
  }
}

// A frame whose MA stops before MO has sent its last slot: MO is 1 at once. SL follows MO after the
// slaves' timeout, so a 0 here would keep the line low up to BREAK.
TEST_F(MoTxBlock, MaStopsBeforeTheLastSlot_MoReturnsToOne) {
  for (int round = 0; round < 500; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    random_words();
    const unsigned busy = random.below(4);
    const bool biss_c = random.below(2) != 0;
    begin(biss_c, busy, false);
    const std::size_t all = 3 + busy + (biss_c ? 1 : 0) + payload().size();
    const std::size_t count = 2 + random.below(static_cast<unsigned>(all - 2));
    for (std::size_t i = 0; i < count; ++i) rise();
    now.clocks = false;
    clock();
    ASSERT_EQ(m.mo_o, 1);
    for (unsigned rest = random.below(50); rest > 0; --rest) clock();
    ASSERT_EQ(m.mo_o, 1);
    m.line_idle_i = 1;
    clock();
    ASSERT_EQ(m.mo_o, 1);
  }
}

// Table 39, and BiSS B register accesses: MO is 0 with EN_MO = 0, also in a frame, and 0 from
// before such an access to its end.
TEST_F(MoTxBlock, EnMoZeroOrRegisterAccess_MoIsZero) {
  now.low = false;
  now.enable = true;
  clock();
  EXPECT_EQ(m.mo_o, 1);
  now.low = true;
  clock();
  EXPECT_EQ(m.mo_o, 0);
  now.low = false;
  clock();
  EXPECT_EQ(m.mo_o, 1);
  now.enable = false;
  clock();
  EXPECT_EQ(m.mo_o, 0);
  slots = {{{.data_bits = 8, .actuator = true}, 0}};
  memory.fill(0xFF);
  m.line_idle_i = 0;
  now.clocks = true;
  m.begin_i = 1;
  clock();
  for (int i = 0; i < 20; ++i) ASSERT_EQ(rise(), '0');
}

}  // namespace
