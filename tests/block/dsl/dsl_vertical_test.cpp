// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The checks of an answer's words: golden vectors of the CRCs, and frames with every kind of wrong
// word against the model.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "Vdsl_vertical.h"
#include "sim/masters/dsl_model/quality.hpp"
#include "sim/masters/dsl_model/safe_channels.hpp"
#include "tests/block/dsl/dsl_frames.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/model_context.hpp"

namespace {

using namespace dsl_frames;

class DslVerticalBlock : public testing::Test {
 protected:
  DslVerticalBlock() {
    m.quirks_i = quirks_of({});
    m.limit_i = 31;
    m.width_i = 32;
    m.signed_i = 0;
    m.answer_i = 0;
    block.reset();
  }
  void clock() {
    m.answer_i = port.bits();
    block.clock();
  }
  void begin_link() {
    port = {.linked = true, .begins = true};
    clock();
    port.begins = false;
    // The frame with VSYNC.
    send(Words{});
    port.running = true;
  }
  void send(const Words& words) {
    dsl_frames::send(
        port, words, [this](unsigned) { return 10 + random.below(4); }, [this] { clock(); });
    m.answer_i = port.bits();
    m.eval();
  }
  // A whole vertical frame.
  void send_vertical(const SafeBytes& first, const SafeBytes& second) {
    for (port.place = 0; port.place < SafeChannels::kFrames; ++port.place) {
      Words words{};
      set_acceleration(words, 0x001F);
      words[kVertical] = byte_word(first[port.place]);
      words[kSecondary] = byte_word(second[port.place]);
      send(words);
    }
    port.place = 0;
  }

  mb4test::Dice random;
  mb4test::Block<Vdsl_vertical> block;
  Vdsl_vertical& m = block.model;
  AnswerPort port;
};

// 0, 1, -1, 5, -5: eleven bits and the inverted remainder by x^5 + x^2 + 1.
constexpr std::array<unsigned, 5> kAccelerations = {0x001F, 0x003A, 0xFFF5, 0x00AE, 0xFF61};

TEST_F(DslVerticalBlock, AccelerationsOfKnownCrc_AreGood) {
  begin_link();
  for (const unsigned word : kAccelerations) {
    SCOPED_TRACE(word);
    Words words{};
    set_acceleration(words, word);
    send(words);
    EXPECT_TRUE(Told(m.told_o).acceleration_good);
    EXPECT_EQ(Told(m.told_o).missing, 0U);
    for (unsigned bit = 0; bit < 16; ++bit) {
      set_acceleration(words, word ^ 1U << bit);
      send(words);
      EXPECT_FALSE(Told(m.told_o).acceleration_good) << "bit " << bit;
      EXPECT_EQ(Told(m.told_o).missing, bit + 1);
    }
  }
}

// Six bytes and their remainder by x^16 + x^15 + x^12 + x^7 + x^6 + x^4 + x^3 + 1, its last byte
// inverted.
constexpr std::array<SafeBytes, 3> kSafe = {
    SafeBytes{0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xFF},
    SafeBytes{0x00, 0x00, 0x01, 0x23, 0x45, 0x67, 0x4B, 0xBE},
    SafeBytes{0x01, 0x12, 0x34, 0x56, 0x78, 0x9A, 0x02, 0x9D}};

TEST_F(DslVerticalBlock, SafePositionsOfKnownCrc_AreGood) {
  begin_link();
  for (unsigned i = 0; i < kSafe.size(); ++i) {
    SCOPED_TRACE(i);
    const SafeBytes& other = kSafe[(i + 1) % kSafe.size()];
    send_vertical(kSafe[i], other);
    EXPECT_TRUE(Told(m.told_o).safe1_valid && Told(m.told_o).safe2_valid);
    EXPECT_FALSE(Told(m.told_o).safe1_error || Told(m.told_o).safe2_error);
    EXPECT_TRUE(Verdict(m.verdict_o).safe1_good);
    for (unsigned bit = 0; bit < 64; ++bit) {
      SafeBytes wrong = kSafe[i];
      wrong[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      send_vertical(wrong, other);
      EXPECT_TRUE(Told(m.told_o).safe1_error && !Told(m.told_o).safe1_valid) << "bit " << bit;
      EXPECT_TRUE(Verdict(m.verdict_o).safe1_error && !Verdict(m.verdict_o).safe1_good);
      EXPECT_TRUE(Told(m.told_o).safe2_valid && !Told(m.told_o).safe2_error);
      EXPECT_FALSE(Verdict(m.verdict_o).safe2_error);
      send_vertical(other, wrong);
      EXPECT_TRUE(Told(m.told_o).safe1_valid && !Told(m.told_o).safe1_error) << "bit " << bit;
      EXPECT_TRUE(Told(m.told_o).safe2_error && !Told(m.told_o).safe2_valid);
      EXPECT_TRUE(Verdict(m.verdict_o).safe2_error);
    }
  }
}

// K8: the map of the SDK compares the value of the first byte of a position alone; ours looks for a
// special character in any byte.
TEST_F(DslVerticalBlock, Marker_IsASpecialCharacterAndInTheSdkAValue) {
  for (const bool sdk : {false, true}) {
    m.quirks_i = quirks_of({.sdk_map = sdk});
    for (const std::uint64_t position : {0xFD'1234'5678U, 0x12'3456'789AU}) {
      const SafeBytes bytes = safe_bytes(0, position);
      for (unsigned special = 0; special <= 8; ++special) {  // 8: none
        SCOPED_TRACE(testing::Message() << "sdk " << sdk << " first byte " << unsigned{bytes[1]}
                                        << " special " << special);
        begin_link();
        for (port.place = 0; port.place < SafeChannels::kFrames; ++port.place) {
          Words words{};
          set_acceleration(words, 0x001F);
          words[kVertical] = byte_word(bytes[port.place]);
          words[kVertical].special = port.place == special;
          words[kSecondary] = byte_word(kSafe[0][port.place]);
          send(words);
        }
        port.place = 0;
        const bool k28 = special < 8 && (bytes[special] & 0x1FU) == 28;
        const bool marked = sdk ? bytes[1] == kMarker1 : special < 8 && !k28;
        EXPECT_EQ(Told(m.told_o).safe1_valid, !marked);
        EXPECT_TRUE(Told(m.told_o).safe2_valid);
      }
    }
  }
}

// R23, R38: the marker is a bad word, and told apart from one that a line has made.
TEST_F(DslVerticalBlock, MarkerInTheAcceleration_IsTold) {
  begin_link();
  const Word marker = {.byte = kMarker1, .special = true};
  const Word data = {.byte = kMarker1};
  const Word error = {.byte = kMarker1, .error = true, .special = true};
  for (const Word& high : {marker, data, error}) {
    for (const Word& low : {marker, data, error}) {
      Words words{};
      words[kHigh] = high;
      words[kLow] = low;
      send(words);
      const bool marked = (high.special && !high.error) || (low.special && !low.error);
      EXPECT_EQ(Told(m.told_o).acceleration_marked, marked);
      EXPECT_FALSE(Told(m.told_o).acceleration_good);
    }
  }
  // In another word it says nothing of the acceleration.
  Words words{};
  set_acceleration(words, 0x001F);
  words[kVertical] = marker;
  send(words);
  EXPECT_FALSE(Told(m.told_o).acceleration_marked);
}

// Bits 39 down to the width: 0, with a sign all as the highest bit of the position.
TEST_F(DslVerticalBlock, BitsAboveTheWidth_AreToldAsAMisfit) {
  for (const bool is_signed : {false, true}) {
    for (unsigned bits = 8; bits <= 40; ++bits) {
      m.width_i = static_cast<CData>(bits - 8);
      m.signed_i = is_signed ? 1 : 0;
      for (const bool negative : {false, true}) {
        const std::uint64_t top = std::uint64_t{1} << (bits - 1);
        std::uint64_t position = (top - 1) & 0x5A'A55A'3CC3;
        if (negative) position |= top;
        if (negative && is_signed) position |= ~(2 * top - 1);
        for (unsigned bit = 0; bit <= 40; ++bit) {
          SCOPED_TRACE(testing::Message() << bits << (is_signed ? " bits and sign " : " bits ")
                                          << negative << " wrong " << bit);
          // Without the wrong one, which is bit 40; the sign itself is a bit of the position.
          const std::uint64_t sent = (position ^ std::uint64_t{1} << bit) & 0xFF'FFFF'FFFF;
          begin_link();
          send_vertical(safe_bytes(0, sent), safe_bytes(0, ~sent));
          const bool above = is_signed ? bits < 40 && bit + 1 >= bits : bit >= bits;
          EXPECT_EQ(Verdict(m.verdict_o).misfit, above && bit < 40);
          EXPECT_TRUE(Told(m.told_o).safe1_valid);
          if (!above || bit == 40) continue;
          SafeBytes wrong = safe_bytes(0, sent);
          wrong[7] ^= 1U;
          send_vertical(wrong, wrong);
          EXPECT_FALSE(Verdict(m.verdict_o).misfit) << "not a good one";
        }
      }
    }
  }
  m.width_i = 0;
  m.quirks_i = quirks_of({.strict_id = false});
  begin_link();
  send_vertical(safe_bytes(0, 0x1234567), safe_bytes(0, 0));
  EXPECT_FALSE(Verdict(m.verdict_o).misfit);
}

struct Rules {
  CodeCheck check;
  QualityRules quality;
};

class DslVerticalRules : public DslVerticalBlock, public testing::WithParamInterface<Rules> {};

// Random frames with wrong words now and then; the link begins again now and then, in any place.
TEST_P(DslVerticalRules, FramesAtRandom_AreThoseOfTheModel) {
  const CodeCheck check = GetParam().check;
  m.quirks_i = quirks_of({.check = check, .quality = GetParam().quality});
  const std::uint64_t frames = mb4test::number("MB4_DSL_FRAMES", 20'000);
  SafeChannels model(GetParam().quality);
  unsigned missing = 0;
  unsigned most = 0;
  unsigned valid = 0;
  unsigned wrong = 0;
  unsigned links = 0;
  unsigned bad_words = 60;
  unsigned misfits = 0;
  std::array<SafeBytes, 2> safe{};
  for (std::uint64_t i = 0; i < frames; ++i) {
    if (!port.linked || (missing != 0 && missing >= m.limit_i) || random.below(700) == 0) {
      ++links;
      m.limit_i = static_cast<std::uint8_t>(random.below(32));
      m.width_i = static_cast<std::uint8_t>(random.below(33));
      m.signed_i = static_cast<std::uint8_t>(random.below(2));
      begin_link();
      port.place = 0;
      model.start();
      model.begin();
      missing = 0;
      bad_words = random.below(4) == 0 ? 2 : 5 + random.below(80);
    }
    if (port.place == 0) {
      for (SafeBytes& bytes : safe) {
        std::uint64_t position = std::uint64_t{random.below(1U << 31U)} << 9U;
        // As an encoder of this width has it, or nearly.
        const unsigned above = 64 - 8 - m.width_i;
        const auto wide = static_cast<std::int64_t>(position << above) >> above;
        if (random.below(4) != 0) {
          position = m.signed_i != 0 ? static_cast<std::uint64_t>(wide)
                                     : position & ~std::uint64_t{0} >> above;
        }
        if (random.below(8) == 0) position ^= std::uint64_t{1} << random.below(40);
        bytes = safe_bytes(random.below(256), position);
        if (random.below(6) == 0) bytes[random.below(8)] ^= 1U;
      }
    }
    Words words{};
    for (Word& word : words) word = byte_word(random.below(256));
    words[kVertical] = byte_word(safe[0][port.place]);
    words[kSecondary] = byte_word(safe[1][port.place]);
    set_acceleration(words, acceleration_word(static_cast<int>(random.below(2048)) - 1024));
    for (Word& word : words) {
      if (random.below(bad_words) == 0) spoil(word, random);
    }
    if (random.below(16) == 0) words[kSecondary] = {.byte = 0xDC, .special = true};
    send(words);

    QualityEvents events;
    model.frame(port.place, words[kVertical], words[kSecondary], events);
    const bool good = acceleration_in(answer_of(words), check).has_value();
    missing = good ? 0 : missing + 1;
    const Told told(m.told_o);
    const Verdict verdict(m.verdict_o);
    SCOPED_TRACE(testing::Message() << "frame " << i << " place " << port.place);
    ASSERT_EQ(told.acceleration_good, good);
    ASSERT_EQ(told.missing, missing);
    ASSERT_EQ(told.safe1_valid, model.safe1().valid);
    ASSERT_EQ(told.safe1_error, model.safe1().error);
    ASSERT_EQ(told.safe2_valid, model.safe2().valid);
    ASSERT_EQ(told.safe2_error, model.safe2().error);
    ASSERT_EQ(verdict.safe1_error, events.safe1_error);
    ASSERT_EQ(verdict.safe1_good, events.safe1_good);
    ASSERT_EQ(verdict.safe2_error, events.safe2_error);
    block.clock();
    ASSERT_EQ(Verdict(m.verdict_o).missing, missing != 0 && missing >= m.limit_i);
    const bool judged = port.place + 1 == SafeChannels::kFrames && model.safe1().valid;
    const bool misfit = judged && !fits(model.safe1().position, m.width_i + 8U, m.signed_i != 0);
    ASSERT_EQ(verdict.misfit, misfit);
    misfits += misfit ? 1 : 0;
    most = std::max(most, missing);
    if (port.place + 1 == SafeChannels::kFrames) {
      valid += told.safe1_valid ? 1 : 0;
      wrong += told.safe1_error ? 1 : 0;
    }
    port.place = (port.place + 1) % SafeChannels::kFrames;
  }
  EXPECT_GT(valid, frames / 40);
  EXPECT_GT(wrong, frames / 80);
  EXPECT_GT(links, 10U);
  EXPECT_GT(most, 5U);
  EXPECT_GT(misfits, frames / 200);
}

std::string name_of(const testing::TestParamInfo<Rules>& info) {
  constexpr const char* kRules[] = {"Document", "Sick", "Firmware"};
  return std::string(info.param.check == CodeCheck::kStrict ? "Strict" : "Published") +
         kRules[static_cast<unsigned>(info.param.quality)];
}
INSTANTIATE_TEST_SUITE_P(All, DslVerticalRules,
                         testing::Values(Rules{CodeCheck::kStrict, QualityRules::kSick},
                                         Rules{CodeCheck::kStrict, QualityRules::kFirmware},
                                         Rules{CodeCheck::kPublished, QualityRules::kDocument},
                                         Rules{CodeCheck::kPublished, QualityRules::kFirmware}),
                         name_of);

}  // namespace
