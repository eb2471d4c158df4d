// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A BiSS B register access alone, master side: pages 13, 16, 30, 34, Figures 9, 14 to 16, Table 36;
// docs/choices.md, 6 and 7. The test plays time base, slave and RDATA.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "Vbiss_b_access.h"
#include "places.hpp"
#include "tests/block/biss/frame_bench.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace at = mb4test::places::biss_pkg;

using mb4test::bits_of;

constexpr std::uint32_t kCrc4 = 0x13;  // page 16
constexpr unsigned kHeaderCells = 17, kByteCells = 14;

// Start bit, fields, inverted CRC, stop bit.
std::string part(const std::string& fields) {
  return "1" +
         mb4test::line_word(std::stoull(fields, nullptr, 2), static_cast<unsigned>(fields.size()),
                            kCrc4) +
         "0";
}

struct Access {
  unsigned freqr = 0, half = 1;  // half: clocks of half an MA period
  bool write = false, mo = false;
  unsigned id = 0, address = 0, count = 1;
  unsigned lines = 1;  // bit 0: line 1
  std::vector<unsigned> bytes;
  std::vector<unsigned> busy;  // read: zeros before each start bit
  unsigned delay = 0;          // clocks from a rising edge of MA to SL
  int wrong_bit = -1;  // bit of the slave that is inverted, from the first byte's start bit on

  unsigned quarter() const { return half << freqr; }  // clocks; Table 36: MA periods 2^(FREQR + 1)
  unsigned cell() const { return 4 * quarter(); }
  std::uint32_t port() const {
    namespace access_t = at::access_t;
    return static_cast<std::uint32_t>(access_t::kWrite(write) | access_t::kAddr(address) |
                                      access_t::kByteLast(count - 1) | access_t::kId(id));
  }
  std::string header() const {
    return part(bits_of(id, 3) + bits_of(address, 7) + (write ? "1" : "0"));
  }
  std::string data() const {
    std::string text;
    for (unsigned i = 0; i < count; ++i) {
      if (!write) text += std::string(busy[i], '0');
      text += part(bits_of(bytes[i], 8));
    }
    return text;
  }
};

class BAccessBlock : public testing::Test {
 protected:
  BAccessBlock() {
    m.cell_shift_i = m.mo_i = 0;
    m.access_i = 0;
    m.start_i = m.start_use_i = m.init_i = m.abort_i = m.tick_i = m.expired_i = 0;
    m.sl_i = 3;
    m.rdata_i = 0;
    block.reset();
  }

  Access random_access(bool write) {
    Access made;
    made.freqr = random.below(4) == 0 ? random.below(8) : random.below(2);
    made.half = 1 + random.below(3);
    made.write = write;
    made.mo = random.below(2) != 0;
    made.id = random.below(8);
    made.address = random.below(128);
    made.count = made.freqr > 3 ? 1 : 1 + random.below(4);
    made.lines = 1 + random.below(3);
    for (unsigned i = 0; i < made.count; ++i) {
      made.bytes.push_back(random.below(256));
      made.busy.push_back(random.below(4));
    }
    made.delay = random.below(made.cell());
    return made;
  }

  void begin(const Access& started, bool is_init = false) {
    access = started;
    init = is_init;
    now = 0;
    ended_at = 0;
    ended = ags_error = reg_error = delay_error = false;
    rises.clear();
    falls.clear();
    written.clear();
    history = {3, 3};
    pending.clear();
    sl = 3;
    m.cell_shift_i = static_cast<std::uint8_t>(access.freqr);
    m.access_i = access.port();
    m.mo_i = access.mo;
    m.start_use_i = static_cast<std::uint8_t>(access.lines);
    m.init_i = init;
    m.expired_i = 0;
    m.start_i = 1;
    clock();
    m.start_i = 0;
  }

  // A clock. MA takes ma_o with a tick. SL comes to the block through two flops.
  void clock() {
    m.tick_i = now % access.half == access.half - 1;
    m.sl_i = static_cast<std::uint8_t>(history[1]);
    m.eval();
    const bool next = m.tick_i != 0 ? at::register_ma_t::kLevel.of(m.ma_o) != 0 : ma;
    const auto index = static_cast<unsigned>(at::access_byte_t::kAddr.of(m.byte_o));
    if (at::access_byte_t::kWrEn.of(m.byte_o) != 0) {
      written.push_back({index, static_cast<unsigned>(at::access_byte_t::kWrData.of(m.byte_o))});
    }
    const bool ends = at::register_ma_t::kEnds.of(m.ma_o) != 0;
    EXPECT_EQ(at::access_end_t::kEnds.of(m.end_o), ends && !init ? 1U : 0U) << "INIT is no access";
    if (ends) {
      EXPECT_FALSE(ended) << "it ends twice";
      ended = true;
      ended_at = now;
      ags_error = m.ags_error_o != 0;
      reg_error = at::access_end_t::kRegError.of(m.end_o) != 0;
      delay_error = at::access_end_t::kDelayError.of(m.end_o) != 0;
    }
    history = {sl, history[0]};
    block.clock();
    ++now;
    m.rdata_i = static_cast<std::uint8_t>(index < access.bytes.size() ? access.bytes[index] : 0xEE);
    if (next != ma) {
      (next ? rises : falls).push_back(now);
      ma = next;
      if (ma) answer();
    }
    if (!pending.empty() && pending.front().time <= now) {
      sl = pending.front().level;
      pending.erase(pending.begin());
    }
    m.eval();
  }
  std::uint64_t good_bytes() const { return at::access_end_t::kGoodBytes.of(m.end_o); }
  // Hand-over: MA falls, and the slaves of the lines in use answer with SL = 0.
  void hand_over(unsigned wait) {
    while (falls.empty() && now < 10'000) clock();
    for (unsigned i = 0; i < wait; ++i) clock();
    sl = static_cast<unsigned>(~access.lines) & 3U;
    low_at = now;
    while (rises.empty() && now < 100'000) clock();
  }
  void run() {
    for (unsigned i = 0; !ended && i < 2 * access.cell() * 200; ++i) clock();
    ASSERT_TRUE(ended) << "it does not end";
    clock();
    ASSERT_EQ(m.active_o, 0);
    ASSERT_TRUE(ma);
  }
  // The bit that MA carried in cell `cell`: high for one quarter (0) or three (1); c: half.
  char cell_bit(std::size_t cell) const {
    const std::uint64_t high = falls.at(cell + 1) - rises.at(cell);
    const bool whole = cell + 1 == rises.size() || rises[cell + 1] - rises[cell] == access.cell();
    if (!whole) return '?';
    return high == access.quarter()       ? '0'
           : high == 3 * access.quarter() ? '1'
           : high == 2 * access.quarter() ? 'c'
                                          : '?';
  }
  std::string cells(std::size_t from, std::size_t count) const {
    std::string text;
    for (std::size_t i = from; i < from + count; ++i) {
      text += i + 1 < falls.size() ? cell_bit(i) : '-';
    }
    return text;
  }
  // MA stays at 1 from the edge on that makes the slave send its last stop bit, and the access ends
  // two register clocks later (I405: by then any cable has brought the stop bit).
  void expect_end(std::size_t edges) {
    ASSERT_EQ(rises.size(), edges);
    ASSERT_EQ(falls.size(), edges) << "the hand-over, and one in each cell but the last one";
    const std::uint64_t after = ended_at + 1 - rises.back();
    ASSERT_GE(after, 2 * access.cell());
    ASSERT_LE(after, 2 * access.cell() + 4);
  }

  struct Level {
    std::uint64_t time;
    unsigned level;
  };
  struct Byte {
    unsigned index, value;
    bool operator==(const Byte&) const = default;
  };
  mb4test::Dice random;
  mb4test::Block<Vbiss_b_access> block;
  Vbiss_b_access& m = block.model;
  Access access;
  std::uint64_t now = 0, low_at = 0, ended_at = 0;
  bool init = false, ma = true, ended = false, ags_error = false, reg_error = false,
       delay_error = false;
  std::vector<std::uint64_t> rises, falls;
  std::vector<Byte> written;
  unsigned sl = 3;
  std::array<unsigned, 2> history{3, 3};
  std::vector<Level> pending;

 private:
  // The slave's answer to the rising edge that has just come. In the address part, and on a line
  // that is not read, it is anything.
  void answer() {
    const std::size_t edge = rises.size() - 1;
    bool bit = random.below(2) != 0;
    if (edge >= kHeaderCells) {
      const std::size_t at = edge - kHeaderCells;
      const std::string data = access.data();
      if (!access.write) {
        bit = at < data.size() && data[at] == '1';
        if (static_cast<int>(at) == access.wrong_bit) bit = !bit;
      } else if (at > 0) {
        // A write: the bit of the cell before.
        bit = cell_bit(edge - 1) == '1';
        if (static_cast<int>(at) - 1 == access.wrong_bit) bit = !bit;
      }
    }
    const unsigned read = (access.lines & 1U) != 0 ? 1U : 2U;
    const unsigned other = random.below(2) != 0 ? 3U - read : 0U;
    pending.push_back({now + access.delay, (bit ? read : 0U) | other});
  }
};

TEST_F(BAccessBlock, RandomWrites_MaCarriesHeaderAndBytes) {
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    begin(random_access(true));
    hand_over(random.below(50));
    run();
    if (HasFatalFailure()) return;
    ASSERT_FALSE(ags_error || reg_error || delay_error);
    ASSERT_EQ(good_bytes(), access.count);
    ASSERT_TRUE(written.empty());
    ASSERT_EQ(cells(0, kHeaderCells), access.header());
    ASSERT_EQ(cells(kHeaderCells, kByteCells * access.count), access.data());
    expect_end(kHeaderCells + kByteCells * access.count + 1);
    if (HasFatalFailure()) return;
  }
}

TEST_F(BAccessBlock, RandomReads_BytesOfTheSlaveReachRdata) {
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    begin(random_access(false));
    hand_over(random.below(50));
    run();
    if (HasFatalFailure()) return;
    ASSERT_FALSE(ags_error || reg_error || delay_error);
    ASSERT_EQ(good_bytes(), access.count);
    std::vector<Byte> expected;
    for (unsigned i = 0; i < access.count; ++i) expected.push_back({i, access.bytes[i]});
    ASSERT_EQ(written, expected);
    ASSERT_EQ(cells(0, kHeaderCells), access.header());
    const std::size_t clocks = access.data().size();
    ASSERT_EQ(cells(kHeaderCells, clocks - 1), std::string(clocks - 1, 'c')) << "duty 50 %";
    expect_end(kHeaderCells + clocks);
    if (HasFatalFailure()) return;
  }
}

// docs/choices.md, "BiSS B write": a start, data or CRC bit that comes back differently ends the
// access with nREGERR = 0, and a stop bit replaces the rest of the byte. Stop bits do not count.
TEST_F(BAccessBlock, OneWrongEcho_EndsWithAnError) {
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    Access wrong = random_access(true);
    wrong.wrong_bit = static_cast<int>(random.below(kByteCells * wrong.count));
    const unsigned bit = static_cast<unsigned>(wrong.wrong_bit) % kByteCells;
    const unsigned byte = static_cast<unsigned>(wrong.wrong_bit) / kByteCells;
    const bool stop = bit == kByteCells - 1;
    begin(wrong);
    hand_over(0);
    run();
    if (HasFatalFailure()) return;
    ASSERT_EQ(reg_error, !stop) << "bit " << bit;
    ASSERT_EQ(good_bytes(), stop ? access.count : byte);
    if (stop) continue;
    // The master knows of it two cells later; the cell after that is the stop bit.
    const std::size_t last = std::min(bit + 3, kByteCells - 1);
    const std::size_t first = kHeaderCells + kByteCells * byte;
    ASSERT_EQ(cells(first + last, 1), "0");
    expect_end(first + last + 2);
    if (HasFatalFailure()) return;
  }
}

// docs/choices.md, "BiSS B read": a wrong CRC ends the access with nREGERR = 0 after its byte, and
// the byte does not reach RDATA.
TEST_F(BAccessBlock, OneWrongBitRead_EndsWithAnErrorAfterItsByte) {
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    Access wrong = random_access(false);
    const unsigned byte = random.below(wrong.count);
    unsigned start = 0;
    for (unsigned i = 0; i < byte; ++i) start += wrong.busy[i] + kByteCells;
    start += wrong.busy[byte];
    wrong.wrong_bit = static_cast<int>(start + 1 + random.below(12));  // data or CRC
    begin(wrong);
    hand_over(0);
    run();
    if (HasFatalFailure()) return;
    ASSERT_TRUE(reg_error);
    ASSERT_EQ(good_bytes(), byte);
    ASSERT_EQ(written.size(), byte);
    expect_end(kHeaderCells + start + kByteCells);
    if (HasFatalFailure()) return;
  }
}

// Page 34, decision 6: no hand-over gives nAGSERR = 0, no start bit gives nDELAYERR = 0. The limit
// is told from outside.
TEST_F(BAccessBlock, SilentSlave_EndsAtTheLimit) {
  for (const bool only_init : {false, true}) {
    Access silent = random_access(false);
    silent.mo = false;
    silent.lines = 3;
    begin(silent, only_init);
    while (falls.empty()) clock();
    sl = 2;  // one of two lines answers
    for (unsigned i = 0; i < 30 * access.cell(); ++i) clock();
    ASSERT_EQ(m.wait_o, 1);
    ASSERT_FALSE(ma);
    m.expired_i = 1;
    run();
    EXPECT_TRUE(ags_error && !reg_error && !delay_error) << only_init;
  }
  Access busy = random_access(false);
  busy.busy.assign(busy.count, 10'000);
  begin(busy);
  hand_over(0);
  for (unsigned i = 0; i < 60 * access.cell(); ++i) clock();
  ASSERT_EQ(m.wait_o, 1);
  ASSERT_FALSE(ended);
  m.expired_i = 1;
  run();
  EXPECT_TRUE(delay_error && !ags_error && !reg_error);
  EXPECT_EQ(good_bytes(), 0);
}

// Figures 9, 14 to 16: without MO the first cell begins with the next quarter after SL = 0. With MO
// it begins half a register clock after MA has fallen, with any SL; MO is 0 from before that edge
// to the end (decision 7).
TEST_F(BAccessBlock, HandOver_WaitsForSlOrHalfAClock) {
  for (int round = 0; round < 100; ++round) {
    begin(random_access(true));
    if (access.mo) {
      while (rises.empty()) {
        ASSERT_EQ(m.mo_low_o, access.lines);
        clock();
      }
      ASSERT_EQ(rises[0] - falls[0], 2 * access.quarter());
    } else {
      hand_over(3 * access.cell() + random.below(20));
      ASSERT_GE(rises[0], low_at + 2);
      ASSERT_LE(rises[0], low_at + 3 + access.quarter());
    }
    while (!ended) {
      ASSERT_EQ(m.mo_low_o, access.lines);
      clock();
      m.abort_i = random.below(500) == 0;  // BREAK, at any time
      if (m.abort_i != 0) break;
    }
    if (m.abort_i != 0) {
      m.eval();
      ASSERT_EQ(at::register_ma_t::kEnds.of(m.ma_o), 0U) << "BREAK is no end";
      clock();
      m.abort_i = 0;
    }
    for (unsigned i = 0; i < access.half; ++i) clock();
    ASSERT_EQ(m.active_o, 0);
    ASSERT_EQ(m.mo_low_o, 0);
    ASSERT_TRUE(ma);
  }
}

// Decision 8: BREAK in the very clock of the end wins; the access does not report its end.
TEST_F(BAccessBlock, BreakInTheClockOfTheEnd_IsNoEnd) {
  for (int round = 0; round < 20; ++round) {
    const Access same = random_access(round % 2 != 0);
    begin(same);
    hand_over(0);
    run();
    if (HasFatalFailure()) return;
    const std::uint64_t end = ended_at;
    begin(same);
    hand_over(0);
    while (now < end) clock();
    m.abort_i = 1;
    clock();
    m.abort_i = 0;
    ASSERT_FALSE(ended) << "round " << round;
    clock();
    ASSERT_EQ(m.active_o, 0);
  }
}

// Page 16, Figure 16: INIT is the hand-over alone; MO falls together with MA.
TEST_F(BAccessBlock, Init_IsTheHandOverAlone) {
  for (int round = 0; round < 50; ++round) {
    begin(random_access(false), true);
    while (falls.empty()) {
      ASSERT_EQ(m.mo_low_o, 0);
      clock();
    }
    ASSERT_EQ(m.mo_low_o, access.lines);
    hand_over(random.below(100));
    ASSERT_TRUE(ended && !ags_error && !reg_error && !delay_error);
    ASSERT_EQ(rises.size(), 1U);
    for (unsigned i = 0; i < 8 * access.cell(); ++i) clock();
    ASSERT_EQ(falls.size(), 1U) << "MA rests";
    ASSERT_EQ(m.mo_low_o, 0);
  }
}

}  // namespace
