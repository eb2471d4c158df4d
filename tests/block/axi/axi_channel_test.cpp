// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One channel of the BiSS C master on AXI, with an encoder behind a line delay: the manual's
// registers 0x2C, 0x30, 0x34, 0x38, 0x3C, the acceptance tests F-3 to F-8 and the rulings on
// channels that do not answer (docs/axi.md). The test plays the time base.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "Vaxi_channel.h"
#include "places.hpp"
#include "tests/block/biss/frame_bench.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace at = mb4test::places::axi_pkg;

constexpr std::uint32_t kCrc6 = 0x43;
constexpr unsigned kLongestDelay = 1023, kStartLimit = 1024, kTimeoutLimit = 4000;

struct Frame {
  unsigned bits = 26, half = 5;
  bool check = true, single = false;
  std::uint32_t position = 0;
  unsigned flags = 3;  // nE, nW
  unsigned busy = 0, delay = 0;
  int wrong_bit = -1;  // of position, flags and CRC
  // Edges as axi_channel's header has them.
  std::uint32_t port() const {
    using namespace at::frame_t;
    return static_cast<std::uint32_t>(kHalfLast(half - 1) | kDataLast(bits + 1) |
                                      kEdges(4 + bits + 2 + 6) | kCheck(check) | kSingle(single));
  }
  std::string word() const {
    std::string text = mb4test::line_word(std::uint64_t{position} << 2 | flags, bits + 2, kCrc6);
    if (wrong_bit >= 0) text[wrong_bit] = text[wrong_bit] == '0' ? '1' : '0';
    return text;
  }
};

class AxiChannelBlock : public testing::Test {
 protected:
  enum class Line { kEncoder, kHigh, kLow };

  AxiChannelBlock() {
    m.frame_i = Frame{}.port();
    // The CRC does not count here, the timeout is adaptive.
    for (auto& word : m.rule_i.m_storage) word = 0;
    at::rule_t::kTimeoutLast.set(m.rule_i, kTimeoutLimit - 1);
    m.cdm_i = 0;
    m.clear_i = m.enabled_i = m.start_i = m.request_i = m.tick_i = 0;
    m.half_next_i = m.slo_i = 1;
    m.por_ni = 0;
    block.reset();
    m.por_ni = 1;
    m.enabled_i = 1;
    EXPECT_EQ(m.busy_o, 1) << "a reset holds starts back";
    clocks(kTimeoutLimit + 1);
    EXPECT_EQ(m.busy_o, 0);
  }

  void clock() {
    m.tick_i = count == half;
    m.half_next_i = !half_high;
    m.slo_i = line == Line::kHigh || (line == Line::kEncoder && history.back());
    m.eval();
    events.begun += at::event_t::kBegun.of(m.event_o);
    events.ended += at::event_t::kEnded.of(m.event_o);
    events.failed += at::event_t::kFailed.of(m.event_o);
    events.crc_error += at::event_t::kCrcError.of(m.event_o);
    events.late += at::event_t::kLate.of(m.event_o);
    const auto before = results();
    const bool ran = m.frame_o != 0;
    if (m.start_i != 0) {
      count = 1;
      half_high = true;
      half = frame.half;
    } else if (m.tick_i != 0) {
      count = 1;
      half_high = !half_high;
    } else {
      ++count;
    }
    block.clock();
    m.eval();
    ++now;
    const bool level = m.ma_o != 0;
    if (level != ma) (level ? rises : falls).push_back(now);
    if (level != ma) slave.edge(level, now);
    ma = level;
    slave.step(ma, now);
    history.push_front(slave.out);
    if (history.size() > frame.delay + 1) history.resize(frame.delay + 1);
    if (m.start_i == 0 && m.clear_i == 0 && m.enabled_i != 0 && results() != before) {
      EXPECT_TRUE(ran && m.frame_o == 0) << "results change only in the last clock of a frame";
    }
  }
  void clocks(unsigned count_) {
    for (unsigned i = 0; i < count_; ++i) clock();
  }
  // What a frame has told since it was started.
  struct Events {
    std::uint64_t begun = 0, ended = 0, failed = 0, crc_error = 0, late = 0;
    bool operator==(const Events&) const = default;
  };
  // The start of a frame; it stays in the clock after it.
  void start(const Frame& started, bool request = false) {
    frame = started;
    history.assign(frame.delay + 1, true);
    slave = {};
    slave.payload = "0" + frame.word();  // the bit behind the start bit
    slave.busy = frame.busy;
    slave.timeout = timeout;
    rises.clear();
    falls.clear();
    m.frame_i = frame.port();
    events = {};
    m.start_i = 1;
    m.request_i = request;
    clock();
    started_at = now;
    m.start_i = m.request_i = 0;
  }
  // To the end of the frame, then to that of the timeout.
  void run() {
    for (unsigned i = 0; m.frame_o != 0 && i < 100'000; ++i) clock();
    ASSERT_EQ(m.frame_o, 0) << "the frame does not end";
    ended_at = now;
    for (unsigned i = 0; m.busy_o != 0 && i < 100'000; ++i) clock();
    ASSERT_EQ(m.busy_o, 0) << "the timeout does not end";
    EXPECT_TRUE(ma);
  }
  // Every level of MA lasts half a period. `stopped`: the last low one may last two, if the frame
  // was stopped with its end.
  void expect_pulses(bool stopped = false) {
    ASSERT_EQ(rises.size(), falls.size());
    for (std::size_t i = 0; i < rises.size(); ++i) {
      ASSERT_EQ(falls[i] - (i == 0 ? started_at : rises[i - 1]), frame.half) << i;
      const bool last = stopped && i + 1 == rises.size();
      ASSERT_GE(rises[i] - falls[i], frame.half) << i;
      ASSERT_LE(rises[i] - falls[i], frame.half * (last ? 2 : 1)) << i;
    }
  }
  Frame random_frame() {
    Frame made;
    made.bits = 1 + random.below(32);
    made.half = 2 + random.below(random.below(4) == 0 ? 30 : 6);
    made.position = static_cast<std::uint32_t>(
        (std::uint64_t{random.below(0x10000)} << 16 | random.below(0x10000)) &
        ((std::uint64_t{1} << made.bits) - 1));
    made.flags = random.below(4);
    made.busy = random.below(20);
    made.delay = random.below(3) == 0 ? random.below(300) : random.below(20);
    made.single = random.below(2) != 0;
    return made;
  }
  // A good frame with a known word, from which bad ones differ.
  void good_frame() {
    start({.single = true, .position = 0x123456, .flags = 2, .delay = 7});
    run();
    ASSERT_TRUE(good());
  }
  void expect_good_frame_kept() {
    EXPECT_FALSE(good());
    EXPECT_EQ(position(), 0x123456U);
    EXPECT_EQ(flags(), 2U);
    EXPECT_EQ(single_position(), 0x123456U);
    EXPECT_EQ(m.single_valid_o, 1);
  }

  std::vector<std::uint64_t> results() const { return {m.result_o, m.word_o, m.single_valid_o}; }
  std::uint64_t single_position() const { return at::result_t::kSingle.of(m.result_o); }
  std::uint64_t delay() const { return at::result_t::kDelay.of(m.result_o); }
  std::uint64_t received() const { return at::result_t::kReceived.of(m.result_o); }
  std::uint64_t calculated() const { return at::result_t::kCalculated.of(m.result_o); }
  std::uint64_t position() const { return at::word_t::kPosition.of(m.word_o); }
  bool crc_bad() const { return at::word_t::kCrcBad.of(m.word_o) != 0; }
  std::uint64_t flags() const {  // nE, nW
    return at::word_t::kNerr.of(m.word_o) << 1 | at::word_t::kNwarn.of(m.word_o);
  }
  bool good() const { return at::word_t::kGood.of(m.word_o) != 0; }

  mb4test::Dice random;
  mb4test::Block<Vaxi_channel> block;
  Vaxi_channel& m = block.model;
  Frame frame;
  Events events;
  mb4test::Slave slave;
  Line line = Line::kEncoder;
  std::deque<bool> history{true};
  unsigned count = 1, half = 1, timeout = 200;
  bool half_high = true, ma = true;
  std::uint64_t now = 0, started_at = 0, ended_at = 0;
  std::vector<std::uint64_t> rises, falls;
};

// F-3, F-4, F-8.
TEST_F(AxiChannelBlock, RandomWordsAndDelays_ReachTheResults) {
  for (int round = 0; round < 400; ++round) {
    const Frame next = random_frame();
    SCOPED_TRACE(testing::Message() << "round " << round << " bits " << next.bits << " half "
                                    << next.half << " delay " << next.delay);
    timeout = 2 * next.half + next.delay + 50;
    const std::uint64_t before = single_position();
    start(next, true);
    EXPECT_FALSE(good());
    EXPECT_EQ(m.single_valid_o, 0);
    run();
    if (HasFatalFailure()) return;
    ASSERT_TRUE(good());
    ASSERT_FALSE(crc_bad());
    ASSERT_EQ(events, (Events{.begun = 1, .ended = 1}));
    ASSERT_EQ(position(), next.position);
    ASSERT_EQ(flags(), next.flags);
    ASSERT_EQ(delay(), next.delay);
    ASSERT_EQ(received(), std::stoul(next.word().substr(next.bits + 2), nullptr, 2));
    ASSERT_EQ(calculated(), received());
    ASSERT_EQ(m.single_valid_o, next.single);
    ASSERT_EQ(single_position(), next.single ? next.position : before);
    // 5 edges, the processing clocks and all bits. If the start bit comes back later than that, MA
    // stops with it: it is known half a bit and three clocks after it has come.
    expect_pulses();
    if (HasFatalFailure()) return;
    const std::size_t needed = 5 + next.busy + next.bits + 2 + 6;
    ASSERT_GE(rises.size(), needed);
    const std::uint64_t known = rises[2 + next.busy] + next.delay + next.half + 4;
    ASSERT_LE(rises.size() > needed ? rises.back() : 0, known + 2 * next.half);
    // The last CRC bit ends the frame, the encoder's timeout the rest.
    const std::uint64_t last = rises[needed - 2] + next.delay;
    EXPECT_GE(ended_at, last);
    EXPECT_LE(ended_at, last + 2 * next.half + 6);
    EXPECT_GE(now, rises.back() + timeout);
  }
}

// F-5, 3.9: a word with a wrong CRC changes nothing while the CRC is checked, and counts as good if
// it is not. 0x2C and 0x30 differ.
TEST_F(AxiChannelBlock, EveryWrongBit_IsBadOnlyIfChecked) {
  for (const bool check : {true, false}) {
    for (int bit = 0; bit < 26 + 2 + 6; ++bit) {
      good_frame();
      const Frame wrong{.check = check, .single = true, .position = 0x0ABCDE, .wrong_bit = bit};
      start(wrong);
      run();
      EXPECT_TRUE(crc_bad()) << bit;
      EXPECT_EQ(events, (Events{.begun = 1, .ended = 1, .crc_error = 1}));
      EXPECT_EQ(received(), std::stoul(wrong.word().substr(28), nullptr, 2));
      EXPECT_EQ(calculated(), ~mb4test::crc_of(wrong.word().substr(0, 28), kCrc6) & 0x3FU);
      if (check) {
        expect_good_frame_kept();
      } else {
        EXPECT_TRUE(good());
        EXPECT_EQ(position(), std::stoul(wrong.word().substr(0, 26), nullptr, 2));
        EXPECT_EQ(single_position(), position());
      }
    }
  }
}

// VALID_UNTIL_REQUEST, 0x34: only a request and a reset clear it.
TEST_F(AxiChannelBlock, SinglePointValid_StaysUntilARequest) {
  good_frame();
  start({.position = 5});
  run();
  EXPECT_EQ(m.single_valid_o, 1);
  EXPECT_EQ(single_position(), 0x123456U) << "not a frame of single-point mode";
  start({.single = true, .position = 6, .wrong_bit = 3}, true);
  EXPECT_EQ(m.single_valid_o, 0);
  run();
  EXPECT_EQ(m.single_valid_o, 0) << "a bad frame never sets it";
}

// 3.9: SLO = 0 at the start sends no MA, and the word is bad. There was no acknowledge and no CRC.
TEST_F(AxiChannelBlock, LowLineAtTheStart_RestsAtOnce) {
  good_frame();
  line = Line::kLow;
  clocks(5);
  start({.position = 1});
  EXPECT_EQ(m.busy_o, 0);
  clocks(100);
  EXPECT_TRUE(rises.empty() && falls.empty());
  EXPECT_EQ(events, (Events{.late = 1}));
  expect_good_frame_kept();
  EXPECT_EQ(delay(), kLongestDelay);
  EXPECT_EQ(received() | calculated(), 0U);
}

// 3.9: no acknowledge within 1023 clocks of the second rising edge; 0x3C is 1023 then.
TEST_F(AxiChannelBlock, OpenLine_EndsAfter1023Clocks) {
  for (const unsigned length : {2U, 5U, 200U}) {
    good_frame();
    line = Line::kHigh;
    start({.half = length});
    run();
    expect_pulses();
    EXPECT_EQ(events, (Events{.begun = 1, .failed = 1}));
    expect_good_frame_kept();
    EXPECT_EQ(delay(), kLongestDelay);
    EXPECT_EQ(received() | calculated(), 0U);
    ASSERT_GE(rises.size(), 2U);
    EXPECT_GE(ended_at, rises[1] + kLongestDelay);
    EXPECT_LE(ended_at, rises[1] + kLongestDelay + 4);
    EXPECT_LE(now, ended_at + 2 * length + 4) << "SLO is 1: no timeout";
    line = Line::kEncoder;
  }
}

// 3.9: no start bit within START_LIMIT bits; then SLO = 0 counts as timeout for TIMEOUT_LIMIT
// clocks.
TEST_F(AxiChannelBlock, LineThatStaysLow_EndsAfterTheLimits) {
  good_frame();
  start({});
  for (int i = 0; rises.size() < 2 && i < 1000; ++i) clock();
  line = Line::kLow;
  run();
  expect_good_frame_kept();
  EXPECT_EQ(delay(), 0U);
  EXPECT_EQ(received() | calculated(), 0U);
  ASSERT_GE(rises.size(), 2U);
  const unsigned bit = 2 * frame.half;
  EXPECT_NEAR(static_cast<double>(ended_at - rises[1]), kStartLimit * bit, bit + 4);
  EXPECT_NEAR(static_cast<double>(now - ended_at), kTimeoutLimit, 2);
  EXPECT_LE(rises.back(), ended_at + bit) << "MA stops with the frame";
  expect_pulses();
}

// A channel that is disabled, or a soft reset, in any clock of a frame: it ends at once, and MA
// returns to 1 at the end of a half period. A disabled channel's word is 0. The encoder may be in
// the middle of its word, so the channel rests after TIMEOUT_LIMIT clocks, whatever SLO is.
TEST_F(AxiChannelBlock, DisabledOrCleared_EndsAtOnce) {
  for (const bool disable : {true, false}) {
    for (unsigned at = 1; at < 400; at += 7) {
      good_frame();
      start({.single = true, .position = 0x3FFFFFF, .busy = 3});
      clocks(at);
      ASSERT_NE(m.frame_o, 0) << at;
      (disable ? m.enabled_i : m.clear_i) = disable ? 0 : 1;
      clock();
      EXPECT_EQ(m.frame_o, 0) << at;
      EXPECT_EQ(position(), 0U);
      EXPECT_EQ(m.single_valid_o, disable);
      EXPECT_EQ(single_position(), disable ? 0x123456U : 0);
      EXPECT_EQ(flags(), disable ? 2U : 3U);
      EXPECT_EQ(m.result_o == 0, !disable);
      // Without acknowledge the delay is not known: not a count that was under way.
      if (disable && rises.size() < 2) {
        EXPECT_EQ(delay(), kLongestDelay) << at;
      }
      const std::uint64_t stopped = now;
      m.enabled_i = 1;
      m.clear_i = 0;
      run();
      expect_pulses(true);
      EXPECT_FALSE(good());
      // The timeout of the encoder begins with the last edge of MA.
      const std::uint64_t rests = rises.empty() ? stopped : std::max(stopped, rises.back());
      EXPECT_NEAR(static_cast<double>(now - rests), kTimeoutLimit, 2);
      EXPECT_TRUE(rises.empty() || rises.back() <= stopped + frame.half);
    }
  }
}

TEST_F(AxiChannelBlock, DisabledChannel_DoesNotStart) {
  m.enabled_i = 0;
  start({});
  for (unsigned i = 0; i < 100; ++i) {
    EXPECT_EQ(m.busy_o, 0);
    clock();
  }
  EXPECT_TRUE(falls.empty());
}

// Disabled while it waits for the stop bit, with a start for the other channels: the stop bit must
// still come, and the channel rests.
TEST_F(AxiChannelBlock, StartWhileADisabledChannelWaitsForTheStopBit_ItRestsLater) {
  start({});
  for (int i = 0; m.frame_o != 0 && i < 10'000; ++i) clock();
  ASSERT_NE(m.busy_o, 0);
  m.enabled_i = 0;
  m.start_i = 1;
  clock();
  m.start_i = 0;
  clocks(kTimeoutLimit + 100);
  EXPECT_EQ(m.busy_o, 0);
}

}  // namespace
