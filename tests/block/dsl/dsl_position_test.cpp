// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Position and speed against the model, and against the encoder's own position: the checks of the
// words stand before it, as in the master. A frame ends with a record, which is looked at whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "Vdsl_position.h"
#include "Vdsl_vertical.h"
#include "sim/core/random.hpp"
#include "sim/masters/dsl_model/motion.hpp"
#include "sim/masters/dsl_model/quality.hpp"
#include "sim/masters/dsl_model/safe_channels.hpp"
#include "tests/block/dsl/dsl_frames.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/model_context.hpp"

namespace {

using namespace dsl_frames;

// Clocks from the end of a frame to its record, at line speed, and with words that come faster.
constexpr unsigned kLatestOnLine = 700;
constexpr unsigned kLatest = 900;
constexpr std::uint64_t kNever = 0xFFFF'FFFF;

// Where things stand in the record.
constexpr unsigned kPosition = 0;
constexpr unsigned kSpeed = 8;
constexpr unsigned kCount = 16;
constexpr unsigned kStatus = 20;
constexpr unsigned kTime = 24;
constexpr unsigned kSafe[] = {32, 40};
constexpr unsigned kAge[] = {48, 52};
constexpr unsigned kWide = 56;
constexpr unsigned kSearch = 64;  // clocks in which dsl_record may be busy
// Bytes of each eight that hold something.
constexpr std::array<unsigned, 8> kUsed = {5, 5, 8, 8, 8, 8, 8, 8};

// What the encoder does: a place that moves by a speed, which changes by an acceleration.
struct Encoder {
  std::uint64_t position = 0;
  std::int64_t speed = 0;
  int acceleration = 0;
  std::uint64_t before = 0;  // the position one sample earlier

  void sample(int next) {
    acceleration = next;
    speed += next;
    before = position;
    position += static_cast<std::uint64_t>(speed);
  }
};

struct Injury {
  bool acceleration = false;
  bool safe_code = false;
  bool safe_crc = false;
};

class DslPositionBlock : public testing::Test {
 protected:
  DslPositionBlock() {
    v.limit_i = 31;
    v.width_i = v.signed_i = 0;
    v.answer_i = m.answer_i = 0;
    m.told_i = 0;
    m.time_i = 0;
    m.safe2_bits_i = m.tolerance_i = 0;
    m.record_busy_i = 0;
    v.quirks_i = m.quirks_i = quirks_of({});
    m.status_i = status.bits();
    vertical_block.reset();
    position_block.reset();
    until_told(1500);
  }

  void clock() {
    v.answer_i = m.answer_i = port.bits();
    m.told_i = v.told_o;
    m.time_i = static_cast<std::uint8_t>(time >> 8 * (time_bytes % 8));
    // dsl_record looks for a bank.
    m.record_busy_i = busy != 0 ? 1 : 0;
    if (busy != 0) --busy;
    m.eval();
    if (m.record_write_o != 0) {
      EXPECT_EQ(m.record_busy_i, 0);
      bank[m.record_address_o] = m.record_data_o;
      written |= std::uint64_t{1} << m.record_address_o;
    }
    if (m.time_next_o != 0) ++time_bytes;
    told = m.tell_o != 0;
    if (told) busy = random.below(4) == 0 ? kSearch : random.below(10);
    // POS falls with the record of its frame, not before it.
    EXPECT_TRUE(m.lost_o != 0 || was_certain || told);
    was_certain = m.lost_o == 0;
    ++clocks;
    ++clocks_ever;
    vertical_block.clock();
    position_block.clock();
    if (!line_speed || !told || !pending) return;
    pending = false;
    longest = std::max(longest, clocks_ever - ended);
    take_record();
    compare();
  }
  void until_told(unsigned most) {
    for (told = false; !told; --most) {
      ASSERT_NE(most, 0U);
      clock();
    }
    take_record();
  }
  void take_record() {
    // It is whole.
    for (unsigned i = 0; i < 64; ++i) {
      ASSERT_TRUE(i % 8 >= kUsed[i / 8] || (written >> i & 1U) != 0) << "byte " << i;
    }
    written = 0;
    record = bank;
    // The next record must not use what is left of this one.
    bank.fill(0xA5);
  }
  std::uint64_t value(unsigned at, unsigned size) const {
    std::uint64_t result = 0;
    for (unsigned i = size; i-- > 0;) result = result << 8U | record[at + i];
    return result;
  }

  // A link is over: a record more says so.
  void end_link() {
    const bool was_linked = port.linked;
    port = {};
    clock();
    EXPECT_EQ(m.lost_o, 1);
    if (!was_linked) return;
    const auto before = record;
    until_told(200 + kSearch);
    EXPECT_EQ(value(kAge[0], 4), kNever);
    EXPECT_EQ(value(kAge[1], 4), kNever);
    EXPECT_EQ(record[kStatus] & 0b1'1111, 1) << "no link, no safe position";
    EXPECT_EQ(record[kStatus + 2], status.state);
    for (unsigned i = 0; i < 64; ++i) {
      const bool stays = i < kStatus || (i >= kTime && i < kAge[0]) || i >= kWide;
      if (!stays || i % 8 >= kUsed[i / 8]) continue;
      EXPECT_EQ(record[i], before[i]) << "byte " << i;
    }
  }
  // A link begins with an encoder of this width.
  void begin_link(unsigned bits, bool recover, unsigned stale_limit) {
    width = bits;
    mask = (std::uint64_t{1} << bits) - 1;
    m.quirks_i = quirks_of({.recover = recover, .stale_limit = stale_limit});
    // The acceleration has 8 to 11 bits of them.
    const unsigned acceleration_bits = 8 + std::min(random.below(4), bits - 8);
    status.width = bits;
    status.identity =
        (is_signed ? 1U << 10U : 0U) | (bits - acceleration_bits) << 4U | (acceleration_bits - 8);
    m.status_i = status.bits();
    end_link();
    port.linked = port.begins = true;
    clock();
    port.begins = false;
    until_told(1500);
    EXPECT_EQ(value(kPosition, 5), 0U);
    EXPECT_EQ(value(kAge[0], 4), kNever);
    // The frame with VSYNC.
    dsl_frames::send(
        port, Words{}, [](unsigned) { return 10; }, [this] { clock(); });
    port.running = true;
    motion = Motion({.recover = recover, .stale_limit = stale_limit});
    motion.start(bits);
    safe.start();
    safe.begin();
    ages = {kNever, kNever};
    missing = 0;
  }

  // A frame of the encoder's, with what is wrong in it.
  Words words_of(const Injury& injury) {
    if (port.place == 0) {
      // The position of the sample before, widened to 40 bits.
      std::uint64_t position = encoder.before & mask;
      if (is_signed && (position >> (width - 1)) != 0) position |= ~mask;
      bytes = {safe_bytes(random.below(256), position), safe_bytes(random.below(256), ~position)};
      if (lie != 0) bytes[0] = safe_bytes(0, position + lie);
    }
    Words words{};
    set_acceleration(words, acceleration_word(encoder.acceleration));
    words[kVertical] = byte_word(bytes[0][port.place]);
    words[kSecondary] = byte_word(bytes[1][port.place]);
    if (injury.acceleration) words[kHigh].error = true;
    if (injury.safe_code) words[kVertical].error = true;
    if (injury.safe_crc) words[kVertical].byte ^= 0x10;
    return words;
  }

  // The frame goes through both.
  void run(const Words& words) {
    const AnswerWords answer = answer_of(words);
    if (line_speed) {
      clocks = 0;
    } else {
      for (unsigned rest = 1 + random.below(4); rest != 0; --rest) clock();
    }
    time = noise.next();
    time_bytes = 0;
    const auto gap = [this](unsigned word) {
      if (!line_speed) return 10 + random.below(31);
      return word == kSecondary ? line_end : word == kLow ? 88 : 80;
    };
    dsl_frames::send(port, words, gap, [this] { clock(); });
    status.quality = random.below(16);
    status.place = random.below(16) << 8U;
    status.state = random.below(16);
    status.reason = random.below(8);
    m.status_i = status.bits();
    sampled = time;
    ASSERT_FALSE(pending);
    ended = clocks_ever;
    if (!line_speed) until_told(kLatest);
    ++frames;

    const auto acceleration = acceleration_in(answer, CodeCheck::kStrict);
    motion.frame(acceleration,
                 answer.acceleration_high.is(kMarker1) || answer.acceleration_low.is(kMarker1));
    missing = acceleration ? 0 : missing + 1;
    for (std::uint64_t& age : ages) age += age == kNever ? 0 : 1;
    QualityEvents events;
    if (safe.frame(port.place, words[kVertical], words[kSecondary], events)) {
      motion.vertical_end(safe.safe1().valid ? std::optional(safe.safe1().position) : std::nullopt);
      if (safe.safe1().valid) ages[0] = 0;
      if (safe.safe2().valid) ages[1] = 0;
    }
    if (line_speed) {
      pending = true;
      return;
    }
    port.place = (port.place + 1) % SafeChannels::kFrames;
    compare();
  }
  void run(const Injury& injury) {
    // 864 clocks from one frame to the next one, whether the record has come or not.
    if (line_speed) {
      while (clocks < 864) clock();
      if (began) port.place = (port.place + 1) % SafeChannels::kFrames;
      began = true;
    }
    run(words_of(injury));
  }

  void compare() {
    ASSERT_EQ(m.lost_o, motion.lost());
    ASSERT_EQ(value(kPosition, 5), motion.position());
    const bool negative = is_signed && (motion.position() >> (width - 1)) != 0;
    ASSERT_EQ(value(kWide, 8), motion.position() | (negative ? ~mask : 0));
    ASSERT_EQ(value(kSpeed, 5), static_cast<std::uint64_t>(motion.speed()) & 0xFF'FFFF'FFFF);
    ASSERT_EQ(value(kCount, 4), frames & 0xFFFF'FFFF);
    ASSERT_EQ(value(kTime, 8), sampled);
    ASSERT_TRUE(line_speed || time_bytes == 8);
    const std::array<SafeChannel, 2> channels = {safe.safe1(), safe.safe2()};
    for (unsigned i = 0; i < 2; ++i) {
      SCOPED_TRACE(testing::Message() << "safe channel " << i + 1);
      ASSERT_EQ(value(kSafe[i], 5), channels[i].position);
      ASSERT_EQ(record[kSafe[i] + 5], channels[i].summary);
      ASSERT_EQ(value(kSafe[i] + 6, 2), channels[i].crc);
      ASSERT_EQ(value(kAge[i], 4), ages[i]);
    }
    const auto bit = [](bool level, unsigned place) { return (level ? 1U : 0U) << place; };
    const bool error = channels[0].error || channels[1].error;
    ASSERT_EQ(record[kStatus], bit(motion.lost(), 0) | 0b110U | bit(channels[0].valid, 3) |
                                   bit(channels[1].valid, 4) | bit(error, 5) |
                                   bit(channels[0].error, 6) | bit(channels[1].error, 7));
    ASSERT_EQ(record[kStatus + 1], status.place >> 8U << 4U | status.quality);
    ASSERT_EQ(record[kStatus + 2], 8) << "a running frame";
    ASSERT_EQ(record[kStatus + 3], status.reason);
    ASSERT_EQ(Told(v.told_o).missing, missing);
  }
  bool right() const { return value(kPosition, 5) == (encoder.position & mask); }

  // Frames until the position is certain, without an injury.
  void align() {
    for (unsigned i = 0; i < 32; ++i) {
      ASSERT_EQ(m.lost_o, 1);
      encoder.sample(next_acceleration());
      run(Injury{});
    }
    ASSERT_EQ(m.lost_o, 0);
    ASSERT_TRUE(right());
  }
  // Keeps the speed within what the width allows.
  int next_acceleration() {
    const std::int64_t most = std::min<std::int64_t>(std::int64_t{1} << (width - 5), 1 << 22);
    int next = wild ? static_cast<int>(random.below(2048)) - 1024 : steady;
    if (encoder.speed + next > most) next = std::max(-1024, static_cast<int>(-most / 8));
    if (encoder.speed + next < -most) next = std::min(1023, static_cast<int>(most / 8));
    return next;
  }

  mb4test::Dice random;
  mb4::sim::Random noise{7};
  mb4test::Block<Vdsl_vertical> vertical_block;
  mb4test::Block<Vdsl_position> position_block;
  Vdsl_vertical& v = vertical_block.model;
  Vdsl_position& m = position_block.model;
  AnswerPort port;
  StatusPort status;
  std::uint64_t time = 0;
  unsigned time_bytes = 0;
  std::array<std::uint8_t, 64> bank{};
  std::array<std::uint8_t, 64> record{};
  std::uint64_t written = 0;
  bool told = false;
  bool was_certain = false;  // lost_o was 0
  std::uint64_t clocks = 0;  // since the first word of a frame
  std::uint64_t clocks_ever = 0;
  std::uint64_t ended = 0;    // a frame was
  std::uint64_t sampled = 0;  // its time
  bool pending = false;       // its record is
  bool began = false;         // place is that of a frame before
  bool line_speed = false;    // the words come as fast as a line brings them
  unsigned line_end = 12;     // clocks from the last word to the frame's end
  std::uint64_t longest = 0;  // from there to the record
  unsigned busy = 0;          // clocks of dsl_record

  Encoder encoder;
  unsigned width = 32;
  std::uint64_t mask = 0;
  bool is_signed = false;
  std::uint64_t lie = 0;  // added to safe position 1
  bool wild = true;       // random accelerations; else this one
  int steady = 0;
  std::array<SafeBytes, 2> bytes{};

  Motion motion{{}};
  SafeChannels safe{QualityRules::kSick};
  std::array<std::uint64_t, 2> ages{};
  unsigned missing = 0;
  std::uint64_t frames = 0;
};

TEST_F(DslPositionBlock, AfterReset_RecordIsEmpty) {
  EXPECT_EQ(m.lost_o, 1);
  for (unsigned i = 0; i < 48; ++i) {
    if (i == kStatus || i % 8 >= kUsed[i / 8]) continue;
    EXPECT_EQ(record[i], 0) << "byte " << i;
  }
  EXPECT_EQ(value(kAge[0], 8), ~std::uint64_t{0});
}

// POS is 1 up to the end of running frame 32, for each width, wherever the position is.
TEST_F(DslPositionBlock, EachWidth_AlignsInFourVerticalFrames) {
  for (unsigned bits = 8; bits <= 40; ++bits) {
    SCOPED_TRACE(testing::Message() << "bits " << bits);
    is_signed = random.below(2) != 0;
    encoder = {.position = noise.next(), .before = 0};
    encoder.sample(0);
    begin_link(bits, true, 2);
    align();
  }
}

// One missing word, with R12: 15 frames in the first place, 8 in the last one, and the position is
// exact.
TEST_F(DslPositionBlock, OneWordLost_NextSafePositionMendsIt) {
  for (const unsigned bits : {20U, 32U, 40U}) {
    encoder = {.position = noise.next(), .before = 0};
    encoder.sample(0);
    is_signed = bits == 32;
    begin_link(bits, true, 2);
    align();
    for (unsigned turn = 0; turn < 4; ++turn) {
      for (unsigned place = 0; place < 8; ++place) {
        SCOPED_TRACE(testing::Message() << "bits " << bits << " place " << place);
        while (port.place != place) {
          encoder.sample(next_acceleration());
          run(Injury{});
          ASSERT_TRUE(m.lost_o == 0 && right());
        }
        for (unsigned i = 0; i < 15 - place; ++i) {
          encoder.sample(next_acceleration());
          run(Injury{.acceleration = i == 0});
          ASSERT_EQ(m.lost_o, 1) << i;
        }
        encoder.sample(next_acceleration());
        run(Injury{});
        ASSERT_TRUE(m.lost_o == 0 && right());
      }
    }
  }
}

// The published way: 31 frames in the first place, else the phases pass once in vain.
TEST_F(DslPositionBlock, OneWordLostAsPublished_FourVerticalFramesMendIt) {
  wild = false;
  encoder = {.position = noise.next(), .speed = 1234, .before = 0};
  encoder.sample(0);
  begin_link(32, false, 0);
  align();
  for (unsigned place = 0; place < 8; ++place) {
    SCOPED_TRACE(testing::Message() << "place " << place);
    while (port.place != place) {
      encoder.sample(0);
      run(Injury{});
    }
    unsigned set = 0;
    do {
      encoder.sample(set == 0 ? 37 : 0);
      run(Injury{.acceleration = set == 0});
      ++set;
      ASSERT_LT(set, 100U);
    } while (m.lost_o != 0);
    EXPECT_EQ(set - 1, place == 0 ? 31U : 63 - place);
    ASSERT_TRUE(right());
    // What was guessed stays in the history for six frames.
    for (unsigned i = 0; i < 6; ++i) {
      encoder.sample(0);
      run(Injury{});
    }
  }
}

// Frames follow one another as on a line, and the words of the next one come while a record is
// made, which takes longest when a loss is mended. On the longest line the last word comes latest,
// and the end of the window soon behind it; on a short one the next word comes soonest.
TEST_F(DslPositionBlock, AtLineSpeed_EachFrameHasItsRecord) {
  is_signed = true;
  for (const unsigned end : {12U, 45U, 12U + 80U, 45U + 80U}) {
    SCOPED_TRACE(testing::Message() << "last word " << end << " clocks before the end");
    line_end = end;
    encoder = {.position = noise.next(), .before = 0};
    encoder.sample(0);
    begin_link(40, true, 2);
    line_speed = true;
    began = false;
    unsigned certain = 0;
    for (unsigned i = 0; i < 400; ++i) {
      encoder.sample(next_acceleration());
      const bool loss = i >= 32 && i % 37 == 0;
      const bool second = i >= 200 && i % 64 == 3;
      run(Injury{.acceleration = loss || second, .safe_crc = i % 96 == 95});
      if (HasFatalFailure()) return;
      certain += m.lost_o == 0 ? 1 : 0;
    }
    while (pending) clock();
    EXPECT_GT(certain, 32U);
    EXPECT_LE(longest, kLatestOnLine);
    RecordProperty("clocks_to_record", static_cast<int>(longest));
    line_speed = false;
  }
  EXPECT_GT(longest, kLatestOnLine * 4 / 5);
}

// What is wrong after a loss is a whole number of steps in each frame, at most 2047: else alignment
// begins anew.
TEST_F(DslPositionBlock, SafePositionAfterLoss_HasToBeAWholeNumberOfSteps) {
  for (unsigned place = 0; place < 8; ++place) {
    const int frames_lost = 8 - static_cast<int>(place);
    for (const int each : {0, 1, -1, 37, -1000, 2047, -2047, 2048, -2048, 9000}) {
      for (const int more : {0, 1}) {
        SCOPED_TRACE(testing::Message()
                     << "place " << place << " each " << each << " more " << more);
        lie = 0;
        encoder = {.position = noise.next(), .before = 0};
        encoder.sample(0);
        begin_link(20 + random.below(21), true, 2);
        align();
        for (unsigned i = 0; i < 8; ++i) {
          encoder.sample(next_acceleration());
          run(Injury{.acceleration = i == place});
        }
        lie = value(kPosition, 5) + static_cast<std::uint64_t>(each * frames_lost + more) -
              encoder.position;
        for (unsigned i = 0; i < 8; ++i) {
          ASSERT_EQ(m.lost_o, 1);
          encoder.sample(next_acceleration());
          run(Injury{});
        }
        const bool whole = (each * frames_lost + more) % frames_lost == 0 &&
                           std::abs((each * frames_lost + more) / frames_lost) <= 2047;
        ASSERT_EQ(m.lost_o, whole ? 0 : 1);
      }
    }
  }
  lie = 0;
}

// R1, R19: no safe position is valid, or young, without a link, wherever it ends: between frames,
// within one, in the last one of a vertical frame.
TEST_F(DslPositionBlock, WithoutALink_NoSafePositionIsYoung) {
  for (unsigned turn = 0; turn < 200; ++turn) {
    SCOPED_TRACE(testing::Message() << "turn " << turn);
    encoder = {.position = noise.next(), .before = 0};
    encoder.sample(0);
    begin_link(32, true, 2);
    const unsigned frames_before = 6 + random.below(12);
    for (unsigned i = 0; i < frames_before; ++i) {
      encoder.sample(next_acceleration());
      run(Injury{});
    }
    if (random.below(3) != 0) {
      // The link ends in a frame, or with it.
      encoder.sample(0);
      const Words words = words_of({});
      const unsigned at = random.below(2) != 0 ? random.below(150) : 150;
      unsigned passed = 0;
      dsl_frames::send(
          port, words, [](unsigned) { return 20U; },
          [&] {
            if (passed++ == at) port.linked = false;
            told = false;
            clock();
            if (told) take_record();
          });
      for (unsigned i = 0; i < 3; ++i) {
        clock();
        if (told) take_record();
      }
      port.linked = false;
    } else {
      port.linked = false;
    }
    port.running = false;
    // Whatever the program has begun is shown, and then the end of the link.
    for (unsigned i = 0; i < 1200; ++i) {
      clock();
      if (told) take_record();
    }
    ASSERT_EQ(value(kAge[0], 4), kNever);
    ASSERT_EQ(value(kAge[1], 4), kNever);
    ASSERT_EQ(record[kStatus] & 0b1'1011, 1);
    frames = value(kCount, 4);
    port = {};
  }
}

// R23: an encoder whose second difference does not fit marks it, and may catch up with legal words
// behind it. A position that is certain is right all the same; the four phases find it.
TEST_F(DslPositionBlock, EncoderThatCatchesUp_NeverMakesAWrongPositionCertain) {
  // From standing still to 1500 steps a frame, and the way that was missed, in eight frames.
  constexpr std::array<int, 8> kCatchUp = {1023, 1023, 0, 0, -207, -339, 0, 0};
  for (unsigned place = 0; place < 8; ++place) {
    SCOPED_TRACE(testing::Message() << "place " << place);
    encoder = {.position = 0x1234'5678, .before = 0x1234'5678};
    wild = false;
    begin_link(32, true, 2);
    align();
    unsigned i = 0;
    while (port.place != place) run(Injury{});
    unsigned certain = 0;
    for (i = 0; i < 64; ++i) {
      encoder.before = encoder.position;
      encoder.position += 1500;
      encoder.acceleration = i >= 1 && i <= 8 ? kCatchUp[i - 1] : 0;
      Words words = words_of({});
      if (i == 0) words[kHigh] = words[kLow] = {.byte = kMarker1, .special = true};
      run(words);
      if (HasFatalFailure()) return;
      if (m.lost_o != 0) continue;
      ++certain;
      ASSERT_TRUE(right()) << "frame " << i;
    }
    EXPECT_GT(certain, 0U);
  }
  wild = true;
}

// Random links with everything that can happen, in each state and place.
TEST_F(DslPositionBlock, FramesAtRandom_AreThoseOfTheModel) {
  const std::uint64_t all = mb4test::number("MB4_DSL_FRAMES", 20'000);
  std::uint64_t left = 0;
  unsigned rare = 0;
  std::array<std::array<unsigned, 8>, 4> bad{};  // words missing by phase and place
  unsigned mended = 0;
  unsigned dropped = 0;
  std::uint64_t certain = 0;
  bool open = false;
  bool recover = false;
  for (std::uint64_t i = 0; i < all; ++i) {
    if (left == 0) {
      left = 40 + random.below(400);
      rare = 4U << random.below(7);
      is_signed = random.below(2) != 0;
      wild = random.below(4) != 0;
      steady = static_cast<int>(random.below(2048)) - 1024;
      encoder = {.position = noise.next(), .before = 0};
      encoder.sample(0);
      const unsigned bits = random.below(4) == 0 ? 8 + random.below(33) : 20 + random.below(21);
      recover = random.below(3) != 0;
      open = false;
      begin_link(bits, recover, random.below(4));
    }
    --left;
    const auto dice = [this, rare] { return random.below(rare) == 0; };
    lie = dice() ? noise.next() >> (24 + random.below(40)) : 0;
    // Now and then a motion that no encoder makes.
    const bool jump = random.below(8 * rare) == 0;
    encoder.sample(jump ? (random.below(2) == 0 ? -1024 : 1023) : next_acceleration());
    if (jump) encoder.position += noise.next() >> random.below(64);
    // A lost word among certain positions, another one soon after it.
    const bool loss = motion.lost() ? open && random.below(20) == 0 : random.below(12) == 0;
    Words words = words_of({.acceleration = loss, .safe_crc = dice() && dice()});
    for (unsigned word = 0; word < kWords; ++word) {
      if (random.below(6 * rare) == 0) spoil(words[word], random);
    }
    const bool was_lost = motion.lost();
    const unsigned phase = motion.phase();
    const unsigned place = port.place;
    SCOPED_TRACE(testing::Message() << "frame " << i << " width " << width << " place " << place);
    run(words);
    if (HasFatalFailure()) return;
    if (motion.missing() != 0) ++bad[phase][place];
    if (recover && !was_lost && motion.missing() != 0) open = true;
    if (open && !motion.lost()) ++mended;
    if (open && motion.phase() != 3) ++dropped;
    if (!motion.lost() || motion.phase() != 3) open = false;
    certain += m.lost_o == 0 ? 1 : 0;
  }
  for (unsigned phase = 0; phase < 4; ++phase) {
    for (unsigned place = 0; place < 8; ++place) {
      EXPECT_GT(bad[phase][place], all / 10'000) << "phase " << phase << " place " << place;
    }
  }
  EXPECT_GT(mended, all / 1000);
  EXPECT_GT(dropped, all / 1000);
  EXPECT_GT(certain, all / 10);
}

// The guess is bounded; speed and position wrap in FramesAtRandom, where safe positions lie.
TEST_F(DslPositionBlock, ExtremesOfAcceleration_BoundTheGuess) {
  for (const unsigned bits : {20U, 33U, 40U}) {
    for (const int extreme : {-1024, 1023}) {
      SCOPED_TRACE(testing::Message() << "bits " << bits << " acceleration " << extreme);
      begin_link(bits, true, 2);
      encoder = {.position = noise.next(), .before = 0};
      for (unsigned i = 0; i < 300; ++i) {
        encoder.sample(i % 16 == 0 ? -1 - extreme : extreme);
        run(Injury{.acceleration = i % 16 == 1 || i % 16 == 5});
        if (HasFatalFailure()) return;
      }
    }
  }
}

}  // namespace
