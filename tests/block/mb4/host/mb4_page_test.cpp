// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The core half of the page at 0x100 alone: time, frame numbers, snapshots and events, as
// docs/buses.md, regmap/mb4_page.rdl and decision 45 have them. The test plays lines, banks,
// the memory of SCDATA and the bus.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "Vmb4_page.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"
// This project does not write Verilator's own header, so its warnings do not count.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include "Vmb4_page___024root.h"
#pragma GCC diagnostic pop

namespace {

namespace tap = mb4test::places::mb4_pkg::tap_t;
constexpr unsigned kSwbankFail = tap::kSwbankFail.lsb, kRegend = tap::kRegend.lsb,
                   kGood = tap::kGood.lsb, kLost = tap::kLost.lsb, kFrameEnd = tap::kFrameEnd.lsb,
                   kSlave = tap::kSlave.lsb, kDone = tap::kDone.lsb, kWr = tap::kWr.lsb,
                   kMa = tap::kMa.lsb, kStop = tap::kStop.lsb, kStart = tap::kStart.lsb,
                   kSsi = tap::kSsi.lsb, kSlaveloc5 = tap::kSlaveloc5.lsb, kReady = tap::kReady.lsb,
                   kLo = tap::kRegsLo.lsb, kHi = tap::kRegsHi.lsb, kCds = tap::kRegsCds.lsb,
                   kSvalid = tap::kRegsSvalid.lsb, kEng = tap::kRegsBanksEng.lsb,
                   kHost = tap::kRegsBanksHost.lsb;
constexpr unsigned kTimeRows = 6;
constexpr std::array<unsigned, 2> kFirstChannel{0, 4};  // of a line, with SLAVELOC5

struct Snapshot {
  std::uint32_t low, high, flags, number;
  std::uint64_t time;
  bool operator==(const Snapshot&) const = default;
};

class PageBlock : public testing::Test {
 protected:
  PageBlock() {
    for (auto& word : m.tap_i.m_storage) word = 0;
    m.getsens_i = m.page_i = m.shadow_clk_i = m.shadow_en_i = m.shadow_addr_i = 0;
    m.ner_i = 1;
    set(kGood, 4, 15);
    set(kMa, 2, 3);
    set(kReady, 1, 1);
    set(kSlaveloc5, 1, 1);
    set_host(0);
    for (auto& bank : scdata) {
      for (auto& word : bank) word = std::uint64_t{random.below(1U << 31)} * random.below(1U << 31);
    }
    block.reset();
    now = 1;  // reset() ends with a clock without reset
    clocks(4);
  }
  void set(unsigned lsb, unsigned width, unsigned value) {
    for (unsigned i = 0; i < width; ++i) {
      std::uint32_t& word = m.tap_i[(lsb + i) / 32];
      const std::uint32_t mask = 1U << (lsb + i) % 32;
      word = (value >> i & 1U) != 0 ? word | mask : word & ~mask;
    }
  }
  void set_host(unsigned bank) {
    host = bank;
    set(kHost, 1, host);
    set(kEng, 1, single_bank ? host : 1 - host);
  }
  void clock() {
    m.eval();
    events |= m.event_o;
    const bool read = m.rd_en_o != 0;
    const unsigned address = m.rd_addr_o;
    block.clock();
    ++now;
    for (unsigned bank = 0; read && bank < 2; ++bank) {
      const unsigned shift = 8 * (address & 7U);
      set(kLo + 8 * bank, 8, static_cast<unsigned>(scdata[bank][address >> 3] >> shift & 0xFFU));
      set(kHi + 8 * bank, 8,
          static_cast<unsigned>(scdata[bank][4 + (address >> 3)] >> shift & 0xFFU));
    }
    m.eval();
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }
  // A request; nothing for the time, else a channel from 0 on.
  void request(std::optional<unsigned> channel) {
    req = !req;
    m.page_i = static_cast<std::uint8_t>((req ? 16U : 0U) | (channel ? *channel : 8U));
  }
  // Clocks from the edge that takes the request to the answer.
  unsigned wait() {
    unsigned edges = 0;
    while ((m.ack_o != 0) != req && edges < 1000) {
      clock();
      ++edges;
    }
    return edges - 1;
  }
  std::uint32_t shadow(unsigned channel, unsigned row) {
    m.shadow_addr_i = static_cast<std::uint8_t>(channel << 3 | row);
    m.shadow_en_i = 1;
    m.shadow_clk_i = 1;
    m.eval();
    m.shadow_clk_i = m.shadow_en_i = 0;
    m.eval();
    return m.shadow_data_o;
  }
  std::uint64_t stamp() {
    request(std::nullopt);
    EXPECT_LE(wait(), 20U);
    return shadow(0, kTimeRows) | std::uint64_t{shadow(0, kTimeRows + 1)} << 32;
  }
  Snapshot rows(unsigned channel) {
    return {shadow(channel, 0), shadow(channel, 1), shadow(channel, 2), shadow(channel, 3),
            shadow(channel, 4) | std::uint64_t{shadow(channel, 5)} << 32};
  }
  Snapshot snapshot(unsigned channel) {
    request(channel);
    EXPECT_LE(wait(), 33U);
    return rows(channel);
  }
  void pulse(unsigned lsb, unsigned width, unsigned value) {
    set(lsb, width, value);
    clock();
    set(lsb, width, 0);
  }
  void ma(unsigned line, bool level) {
    set(kMa + line, 1, level);
    clocks(1 + random.below(4));
  }
  // The first edges of a frame of a line, and more; returns the time at which its slaves latch.
  std::uint64_t frame(unsigned line, bool ssi) {
    set(kSsi + line, 1, ssi);
    pulse(kStart + line, 1, 1);
    clocks(random.below(5));
    const std::uint64_t falls = now;
    ma(line, false);
    const std::uint64_t rises = now;
    for (int i = 0; i < 5; ++i) {
      ma(line, true);
      ma(line, false);
    }
    ma(line, true);
    return ssi ? falls : rises;
  }
  // Words of the lines in `done` end in the same clock.
  void words(unsigned done) {
    set(kSlave, 6, kFirstChannel[0] | kFirstChannel[1] << 3);
    pulse(kDone, 2, done);
    clocks(2);
  }

  mb4test::Dice random;
  mb4test::Block<Vmb4_page> block;
  Vmb4_page& m = block.model;
  std::array<std::array<std::uint64_t, 8>, 2> scdata{};
  std::uint64_t now = 0;  // core clocks since the reset
  unsigned host = 0, events = 0;
  bool req = false, single_bank = false;
};

TEST_F(PageBlock, Time_IsTheCoreClocksSinceTheReset) {
  std::uint64_t last = 0;
  for (int i = 0; i < 50; ++i) {
    const std::uint64_t before = now;
    const std::uint64_t time = stamp();
    EXPECT_GE(time, before);
    EXPECT_LE(time, now);
    EXPECT_GT(time, last);
    last = time;
    clocks(random.below(500));
  }
}

// After 2^32 clocks both words go on together.
TEST_F(PageBlock, TimeBeyondItsLowWord_GoesOn) {
  now = m.rootp->mb4_page__DOT__u_time__DOT__low_q = 0xFFFF'FF00;
  while (now < 0x1'0000'0200) {
    const std::uint64_t before = now;
    const std::uint64_t time = stamp();
    EXPECT_GE(time, before);
    EXPECT_LE(time, now);
    clocks(random.below(20));
  }
}

// Nothing is asked for at the end of a reset, and nothing is answered.
TEST_F(PageBlock, Reset_AnswersNothing) {
  m.rst_ni = 0;
  m.eval();
  EXPECT_EQ(m.ack_o, 0);
  block.reset();
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(m.ack_o, 0);
    EXPECT_EQ(m.rd_en_o, 0);
    clock();
  }
}

TEST_F(PageBlock, Beat_ChangesEveryEightClocks) {
  unsigned changes = 0;
  for (int i = 0; i < 800; ++i) {
    const auto before = m.beat_o;
    clock();
    changes += before != m.beat_o;
    EXPECT_EQ(before != m.beat_o, now % 8 == 0);
  }
  EXPECT_EQ(changes, 100U);
}

// Words of the host's bank; flags 0 SVALID, 1 CDS of the line, 2 SWBANKFAIL. Without SLAVELOC5 all
// channels are of line 1. No frame has brought these words: number and time are 0.
TEST_F(PageBlock, Snapshots_ShowDataAndFlagsOfTheHostsBank) {
  for (int round = 0; round < 400; ++round) {
    const unsigned channel = random.below(8);
    const unsigned svalid = random.below(0x10000), cds = random.below(16), fail = random.below(2),
                   slaveloc5 = random.below(2);
    set_host(random.below(2));
    set(kSvalid, 16, svalid);
    set(kCds, 4, cds);
    set(kSwbankFail, 1, fail);
    set(kSlaveloc5, 1, slaveloc5);
    const unsigned line = slaveloc5 != 0 && channel >= 4 ? 1 : 0;
    const std::uint64_t data = scdata[host][channel];
    const unsigned flags =
        (svalid >> (8 * host + channel) & 1U) | (cds >> (2 * host + line) & 1U) << 1 | fail << 2;
    EXPECT_EQ(snapshot(channel), (Snapshot{static_cast<std::uint32_t>(data),
                                           static_cast<std::uint32_t>(data >> 32), flags, 0, 0}))
        << "channel " << channel;
  }
}

// The number of the line's frame, and the time at which its slaves latch: the first rising edge of
// MA in BiSS, the first falling one in SSI. A word keeps those of its frame, in its bank.
TEST_F(PageBlock, RandomFrames_AreCountedAndStamped) {
  set(kSvalid, 16, 0xFFFF);
  std::array<unsigned, 2> number{};
  std::array<std::uint64_t, 2> time{};
  std::array<std::array<Snapshot, 2>, 2> kept{};  // line, bank
  for (int round = 0; round < 300; ++round) {
    const unsigned taking = 1 + random.below(3);
    for (unsigned line = 0; line < 2; ++line) {
      if ((taking >> line & 1U) == 0) continue;
      ++number[line];
      time[line] = frame(line, random.below(2) != 0);
      kept[line][1 - host] = {0, 0, 0, number[line], time[line]};
    }
    if (taking != 3 || random.below(2) != 0) {
      words(taking);
    } else {
      words(1);
      words(2);
    }
    if (random.below(4) != 0) set_host(1 - host);
    for (unsigned line = 0; line < 2; ++line) {
      const Snapshot seen = snapshot(kFirstChannel[line]);
      ASSERT_EQ(seen.number, kept[line][host].number) << "line " << line + 1 << " round " << round;
      ASSERT_EQ(seen.time, kept[line][host].time) << "line " << line + 1 << " round " << round;
    }
  }
}

// MA that falls and rises without a start (force bits), or after an abort, is no frame.
TEST_F(PageBlock, EdgesWithoutAFrame_CountNothing) {
  for (const bool ssi : {false, true}) {
    set(kSsi, 2, ssi ? 3 : 0);
    frame(0, ssi);
    for (int i = 0; i < 3; ++i) {
      ma(0, false);
      ma(0, true);
    }
    for (const bool low : {true, false}) {
      pulse(kStart, 1, 1);
      if (low && !ssi) ma(0, false);  // in SSI that is the frame's edge
      pulse(kStop, 1, 1);
      if (!low || ssi) ma(0, false);
      ma(0, true);
    }
    words(1);
    set_host(1 - host);
    EXPECT_EQ(snapshot(0).number, ssi ? 2U : 1U);
    set_host(1 - host);
  }
}

// The core has acted on earlier writes to 0xF4 before the copy begins.
TEST_F(PageBlock, Copy_BeginsSixteenClocksAfterTheRequest) {
  request(3);
  unsigned clocks = 0;
  for (; m.rd_en_o == 0 && clocks < 100; ++clocks) clock();
  EXPECT_GE(clocks, 16U);
  EXPECT_LE(clocks, 20U);
}

// A switch of the banks at any clock of a copy: the words are all of one bank, that of the end.
TEST_F(PageBlock, BanksSwitchDuringACopy_ItBeginsAgain) {
  set(kSvalid, 16, 0x0F00);
  for (unsigned at = 0; at < 40; ++at) {
    request(2);
    for (unsigned i = 0; i < at && (m.ack_o != 0) != req; ++i) clock();
    const bool done = (m.ack_o != 0) == req;
    const unsigned bank = done ? host : 1 - host;
    if (!done) set_host(bank);
    EXPECT_LE(at + wait(), 33U + 15U);
    EXPECT_EQ(rows(2), (Snapshot{static_cast<std::uint32_t>(scdata[bank][2]),
                                 static_cast<std::uint32_t>(scdata[bank][2] >> 32), bank, 0, 0}))
        << at;
  }
}

// One bank: a write to the same word begins the copy again, one to another word does not.
TEST_F(PageBlock, WriteToTheWordDuringACopy_ItBeginsAgain) {
  single_bank = true;
  set_host(0);
  for (unsigned line = 0; line < 2; ++line) {
    for (const bool same : {true, false}) {
      const unsigned channel = kFirstChannel[line] + 1;
      set(kSlave, 6, same ? channel << 3 * line : 0);
      request(channel);
      for (int i = 0; m.rd_en_o == 0 && i < 100; ++i) clock();
      clocks(7);
      scdata[0][channel] = ~scdata[0][channel];
      pulse(kWr + line, 1, 1);
      const unsigned rest = wait();
      EXPECT_EQ(rest > 10, same) << rest;
      if (!same) continue;
      const Snapshot seen = rows(channel);
      EXPECT_EQ(seen.low | std::uint64_t{seen.high} << 32, scdata[0][channel]);
    }
  }
}

// Nothing is held: if each copy is disturbed, by banks that switch or memories that are being
// cleared, the eighth ends, and shows no valid word.
TEST_F(PageBlock, EveryCopyDisturbed_EndsWithoutAWord) {
  set(kSvalid, 16, 0xFFFF);
  frame(0, false);
  words(1);
  set_host(1);
  for (const bool switching : {true, false}) {
    EXPECT_EQ(snapshot(0).number, 1U);
    request(0);
    set(kReady, 1, switching);
    unsigned count = 0;
    for (; (m.ack_o != 0) != req && count < 1000; ++count) {
      if (switching && count % 12 == 0) set_host(1 - host);
      clock();
    }
    EXPECT_LE(count, 33U + 7U * 15U);
    const Snapshot seen = rows(0);
    EXPECT_EQ(seen.flags & 1U, 0U);
    EXPECT_EQ(seen.number, 0U);
    EXPECT_EQ(seen.time, 0U);
    set_host(1);
    set(kReady, 1, 1);
    clocks(2);
  }
  EXPECT_EQ(snapshot(0).flags & 1U, 1U) << "the next one is whole";
}

// What a pin has when the reset ends is no change of it.
TEST_F(PageBlock, PinsAtTheEndOfTheReset_AreNoEvents) {
  m.getsens_i = 1;
  m.ner_i = 0;
  m.rst_ni = 0;
  m.eval();
  block.reset();
  events = 0;
  clocks(20);
  EXPECT_EQ(events, 0U);
  m.getsens_i = 0;
  m.ner_i = 1;
  clocks(5);
  EXPECT_EQ(events, 0U);
  m.getsens_i = 1;
  clocks(5);
  EXPECT_EQ(events, 8U);
  m.ner_i = 0;
  clocks(5);
  EXPECT_EQ(events, 10U);
}

// Events as in enc_irq: 0 frame end, 1 one of the flags or NER went to 0, 2 REGEND rose, 3 GETSENS
// rose, 4 a frame was lost. Each for one clock, and nothing with the other edge.
TEST_F(PageBlock, Events_ComeWithTheirEdgeOnce) {
  const auto count = [&](unsigned event) {
    unsigned seen = 0;
    events = 0;
    for (int i = 0; i < 10; ++i) {
      m.eval();
      seen += m.event_o >> event & 1U;
      clock();
    }
    EXPECT_EQ(events & ~(1U << event), 0U);
    return seen;
  };
  set(kFrameEnd, 1, 1);
  events = 0;
  clock();
  set(kFrameEnd, 1, 0);
  EXPECT_EQ(events, 1U);
  set(kLost, 1, 1);
  events = 0;
  clock();
  set(kLost, 1, 0);
  EXPECT_EQ(events, 16U);
  for (unsigned flag = 0; flag < 4; ++flag) {
    set(kGood + flag, 1, 0);
    EXPECT_EQ(count(1), 1U) << flag;
    set(kGood + flag, 1, 1);
    EXPECT_EQ(count(1), 0U) << flag;
  }
  for (const bool level : {false, true}) {
    m.ner_i = level;
    EXPECT_EQ(count(1), level ? 0U : 1U);
    m.getsens_i = !level;
    EXPECT_EQ(count(3), level ? 0U : 1U);
    set(kRegend, 1, level ? 0 : 1);
    EXPECT_EQ(count(2), level ? 0U : 1U);
  }
}

}  // namespace
