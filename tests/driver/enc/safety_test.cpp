// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The check of the two words of BiSS Safety. Words and CRCs are made here bit by bit, by division
// of the whole bit row; the chip is in rtl_safety_test.cpp.

#include "enc/safety.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using enc::bp3_safety;
using enc::Safety;
using enc::SafetyCheck;
using enc::SafetyConfig;
using enc::SafetyField;
using enc::SafetySample;
using enc::SafetyVerdict;
using enc::SafetyWordRead;

constexpr unsigned kChecks = static_cast<unsigned>(SafetyCheck::kSafetyError) + 1;

// Remainder of data * x^width plus the start value in the highest places, divided by the
// polynomial.
std::uint16_t divide(std::uint32_t polynomial, unsigned width, std::uint16_t start,
                     std::uint64_t data, unsigned bits) {
  std::vector<bool> row;
  for (unsigned i = bits; i-- > 0;) row.push_back((data >> i & 1U) != 0);
  row.resize(bits + width);
  for (unsigned i = 0; i < width; ++i) row[i] = row[i] != ((start >> (width - 1 - i) & 1U) != 0);
  for (unsigned i = 0; i < bits; ++i) {
    if (!row[i]) continue;
    for (unsigned k = 0; k <= width; ++k) {
      row[i + k] = row[i + k] != ((polynomial >> (width - k) & 1U) != 0);
    }
  }
  unsigned crc = 0;
  for (unsigned i = 0; i < width; ++i) crc = crc << 1U | (row[bits + i] ? 1U : 0U);
  return static_cast<std::uint16_t>(crc);
}

constexpr std::uint16_t kControlStart = 0x2A;
constexpr std::uint16_t kSafetyStart = 0x1234;

// An encoder of BP3: both positions, nE and nW of both words, and the sign of life.
struct Encoder {
  unsigned control_bits = 26;
  unsigned safety_bits = 26;
  std::uint64_t position = 0;
  std::uint64_t safety_position = 0;
  unsigned life = 0;
  unsigned control_flags = 3;
  unsigned safety_flags = 3;

  SafetySample sample() const {
    SafetySample out;
    out.control.data = position << 2U | control_flags;
    out.control.crc = divide(0x43, 6, kControlStart, out.control.data, control_bits + 2);
    out.control.state = SafetyWordRead::State::kHere;
    out.safety.data = safety_position << 8U | safety_flags << 6U | life;
    out.safety.crc = divide(0x190D9, 16, kSafetyStart, out.safety.data, safety_bits + 8);
    out.safety.state = SafetyWordRead::State::kHere;
    return out;
  }
  void step(unsigned values = 64, unsigned first = 0) {
    position = (position + 1) & ((std::uint64_t{1} << control_bits) - 1);
    safety_position = position;
    life = life + 1 == first + values ? first : life + 1;
  }
};

SafetyConfig config26() { return bp3_safety(26, 26, kControlStart, kSafetyStart); }

std::string failures(const SafetyVerdict& verdict) {
  std::string text;
  for (unsigned i = 0; i < kChecks; ++i) {
    const auto check = static_cast<SafetyCheck>(i);
    if (verdict.failed(check)) text += (text.empty() ? "" : ", ") + std::string(to_string(check));
  }
  return text;
}

// A Safety that has seen the first word of `encoder`.
Safety started(const SafetyConfig& config, const Encoder& encoder) {
  Safety safety;
  EXPECT_EQ(safety.configure(config), SafetyField::kNone);
  EXPECT_EQ(failures(safety.check(encoder.sample())), "life counter not comparable");
  return safety;
}

// The words of BP3, written out: position, nE, nW; position, nE, nW, sign of life.
TEST(Safety, Bp3Words_AreTakenApart) {
  Safety safety;
  ASSERT_EQ(safety.configure(bp3_safety(4, 4)), SafetyField::kNone);
  SafetySample sample;
  sample.control = {0b1010'1'0, divide(0x43, 6, 0, 0b1010'1'0, 6), SafetyWordRead::State::kHere};
  const std::uint64_t word = 0b1010'1'1'100001;
  sample.safety = {word, divide(0x190D9, 16, 0, word, 12), SafetyWordRead::State::kHere};
  const SafetyVerdict verdict = safety.check(sample);
  EXPECT_EQ(failures(verdict), "life counter not comparable");
  EXPECT_EQ(verdict.position, 0b1010U);
  EXPECT_EQ(verdict.safety_position, 0b1010U);
  EXPECT_EQ(verdict.life, 0b100001U);
  EXPECT_TRUE(verdict.warning);
}

TEST(Safety, GoodEncoder_All64LifeValuesAreRight) {
  Encoder encoder;
  Safety safety = started(config26(), encoder);
  std::uint64_t seen = 1;
  for (unsigned frame = 1; frame < 200; ++frame) {
    encoder.step();
    const SafetyVerdict verdict = safety.check(encoder.sample());
    ASSERT_TRUE(verdict.ok()) << frame << ": " << failures(verdict);
    EXPECT_EQ(verdict.life, frame % 64);
    EXPECT_EQ(verdict.position, frame);
    EXPECT_EQ(verdict.safety_position, frame);
    EXPECT_FALSE(verdict.warning);
    seen |= std::uint64_t{1} << verdict.life;
  }
  EXPECT_EQ(seen, ~std::uint64_t{0});
}

TEST(Safety, StuckCounter_IsFoundInOneFrameAtEachValue) {
  for (unsigned life = 0; life < 64; ++life) {
    Encoder encoder;
    encoder.life = life;
    Safety safety = started(config26(), encoder);
    for (unsigned frame = 0; frame < 3; ++frame) {
      encoder.step();
      encoder.life = life;
      EXPECT_EQ(failures(safety.check(encoder.sample())), "life counter stuck") << life;
    }
    encoder.step();
    EXPECT_TRUE(safety.check(encoder.sample()).ok()) << life;
  }
}

// From each value to each other one: only the next one is right.
TEST(Safety, EachStepOfTheCounter_HasItsName) {
  for (const unsigned first : {0U, 1U}) {
    SafetyConfig config = config26();
    config.life_first = static_cast<std::uint8_t>(first);
    const unsigned values = 64 - first;
    for (unsigned from = first; from < 64; ++from) {
      for (unsigned steps = 0; steps < values; ++steps) {
        Encoder encoder;
        encoder.life = from;
        Safety safety = started(config, encoder);
        for (unsigned i = 0; i < steps; ++i) encoder.step(values, first);
        const std::string found = failures(safety.check(encoder.sample()));
        const std::string expected = steps == 0                ? "life counter stuck"
                                     : steps == 1              ? ""
                                     : steps - 1 <= values / 2 ? "safety word left out"
                                                               : "old safety word";
        ASSERT_EQ(found, expected) << from << " + " << steps;
        // Told once: the next word is right again.
        encoder.step(values, first);
        ASSERT_TRUE(safety.check(encoder.sample()).ok()) << from << " + " << steps;
      }
    }
  }
}

TEST(Safety, ValueThatTheCounterDoesNotHave_IsNamed) {
  SafetyConfig config = config26();
  config.life_first = 1;
  Encoder encoder;
  encoder.life = 63;
  Safety safety = started(config, encoder);
  encoder.step();
  EXPECT_EQ(encoder.life, 0U);
  EXPECT_EQ(failures(safety.check(encoder.sample())), "impossible life counter");
  encoder.life = 2;
  EXPECT_TRUE(safety.check(encoder.sample()).ok()) << "two frames after 63";
}

// Frames without a good safety word count: the next good one must be as many steps on.
TEST(Safety, BadFrames_CountUntilTheNextGoodWord) {
  for (unsigned lost = 1; lost < 70; ++lost) {
    for (const bool at_once : {false, true}) {
      Encoder encoder;
      Safety safety = started(config26(), encoder);
      for (unsigned i = 0; i < lost; ++i) {
        encoder.step();
        SafetySample sample = encoder.sample();
        if (i % 2 == 0) sample.safety.crc ^= 1U;
        if (i % 2 == 1) sample.safety.state = SafetyWordRead::State::kMissing;
        if (!at_once) {
          ASSERT_FALSE(safety.check(sample).ok());
        }
      }
      encoder.step();
      const SafetyVerdict verdict = safety.check(encoder.sample(), at_once ? lost + 1 : 1);
      EXPECT_EQ(failures(verdict), lost < 63 ? "" : "life counter not comparable") << lost;
      encoder.step();
      EXPECT_TRUE(safety.check(encoder.sample()).ok()) << lost;
    }
  }
}

TEST(Safety, FramesThatTheSensorHasNotSent_AreFound) {
  Encoder encoder;
  Safety safety = started(config26(), encoder);
  encoder.step();
  EXPECT_EQ(failures(safety.check(encoder.sample(), 2)), "old safety word");
  EXPECT_EQ(failures(safety.check(encoder.sample(), 0)), "life counter stuck") << "0 counts as 1";
  encoder.step();
  EXPECT_TRUE(safety.check(encoder.sample(), 0).ok()) << "0 counts as 1";
  EXPECT_FALSE(safety.check({}).ok()) << "a frame without words";
  EXPECT_EQ(failures(safety.check(encoder.sample(), 0xFFFF'FFFF)), "life counter not comparable");
  encoder.step();
  EXPECT_TRUE(safety.check(encoder.sample()).ok());
  safety.restart();
  encoder.step();
  EXPECT_EQ(failures(safety.check(encoder.sample())), "life counter not comparable");
}

// Each fault alone is named, and nothing else.
TEST(Safety, EachFault_IsNamedExactly) {
  struct Fault {
    const char* name;
    std::function<void(SafetySample&)> make;
  };
  const auto control = [](SafetySample& sample, std::uint64_t change) {
    sample.control.data ^= change;
    sample.control.crc = divide(0x43, 6, kControlStart, sample.control.data, 28);
  };
  const auto safety_word = [](SafetySample& sample, std::uint64_t change) {
    sample.safety.data ^= change;
    sample.safety.crc = divide(0x190D9, 16, kSafetyStart, sample.safety.data, 34);
  };
  using State = SafetyWordRead::State;
  const Fault faults[] = {
      {"", [](SafetySample& /*sample*/) {}},
      {"no control word", [](SafetySample& sample) { sample.control.state = State::kMissing; }},
      {"no safety word", [](SafetySample& sample) { sample.safety.state = State::kMissing; }},
      {"words of two frames", [](SafetySample& sample) { sample.one_frame = false; }},
      {"CRC error of the control word",
       [](SafetySample& sample) { sample.control.state = State::kBadCrc; }},
      {"CRC error of the safety word",
       [](SafetySample& sample) { sample.safety.state = State::kBadCrc; }},
      {"CRC error of the control word", [](SafetySample& sample) { sample.control.crc ^= 0x20; }},
      {"CRC error of the safety word", [](SafetySample& sample) { sample.safety.crc ^= 0x8000; }},
      {"CRC error of the control word",
       [](SafetySample& sample) { sample.control.data ^= std::uint64_t{1} << 28U; }},
      {"CRC error of the safety word",
       [](SafetySample& sample) { sample.safety.data ^= std::uint64_t{1} << 34U; }},
      {"CRC error of the control word",
       [](SafetySample& sample) {
         sample.control.crc = divide(0x43, 6, kControlStart ^ 1U, sample.control.data, 28);
       }},
      {"CRC error of the safety word",
       [](SafetySample& sample) {
         sample.safety.crc = divide(0x190D9, 16, 0, sample.safety.data, 34);
       }},
      {"positions differ", [&](SafetySample& sample) { control(sample, 1U << 2U); }},
      {"positions differ", [&](SafetySample& sample) { safety_word(sample, 1U << 8U); }},
      {"error flag of the control word", [&](SafetySample& sample) { control(sample, 2); }},
      {"error flag of the safety word", [&](SafetySample& sample) { safety_word(sample, 0x80); }},
      {"life counter stuck", [&](SafetySample& sample) { safety_word(sample, 1); }},
      {"safety word left out", [&](SafetySample& sample) { safety_word(sample, 2); }},
      {"old safety word, positions differ, error flag of the control word",
       [&](SafetySample& sample) {
         safety_word(sample, 0x3E | 1U << 8U);
         control(sample, 2);
       }},
      // The two words in exchanged places.
      {"CRC error of the control word, CRC error of the safety word",
       [](SafetySample& sample) { std::swap(sample.control, sample.safety); }},
  };
  for (const Fault& fault : faults) {
    Encoder encoder;
    encoder.position = encoder.safety_position = 0x155'5554;
    Safety safety = started(config26(), encoder);
    encoder.step();
    SafetySample sample = encoder.sample();
    fault.make(sample);
    const SafetyVerdict verdict = safety.check(sample);
    EXPECT_EQ(failures(verdict), fault.name);
    EXPECT_EQ(verdict.ok(), *fault.name == '\0');
    const bool control_good =
        !verdict.failed(SafetyCheck::kControlWord) && !verdict.failed(SafetyCheck::kControlCrc);
    EXPECT_EQ(verdict.position, control_good ? sample.control.data >> 2U : 0) << fault.name;
    const bool safety_good =
        !verdict.failed(SafetyCheck::kSafetyWord) && !verdict.failed(SafetyCheck::kSafetyCrc);
    EXPECT_EQ(verdict.safety_position, safety_good ? sample.safety.data >> 8U : 0) << fault.name;
  }
}

TEST(Safety, WarningOfEitherWord_IsToldAndNoFailure) {
  for (const bool in_control : {true, false}) {
    Encoder encoder;
    Safety safety = started(config26(), encoder);
    encoder.step();
    (in_control ? encoder.control_flags : encoder.safety_flags) = 2;
    const SafetyVerdict verdict = safety.check(encoder.sample());
    EXPECT_TRUE(verdict.ok());
    EXPECT_TRUE(verdict.warning);
  }
}

TEST(Safety, FlagsAndPositionElsewhere_AreWhereTheConfigurationSays) {
  SafetyConfig config = config26();
  // nW, 3 unused bits, position of 8 bits, nE; safety: life, nE, position, no nW.
  config.control = {13, 8, 1, 0, 12, 0x43, kControlStart};
  config.safety = {15, 8, 0, 8, enc::kNoBit, 0x190D9, kSafetyStart};
  config.life_place = 9;
  Safety safety;
  ASSERT_EQ(safety.configure(config), SafetyField::kNone);
  const auto sample = [](std::uint64_t control, std::uint64_t word) {
    return SafetySample{
        {control, divide(0x43, 6, kControlStart, control, 13), SafetyWordRead::State::kHere},
        {word, divide(0x190D9, 16, kSafetyStart, word, 15), SafetyWordRead::State::kHere},
        true};
  };
  SafetyVerdict verdict = safety.check(sample(0b1'000'10100101'1, 0b000111'1'10100101));
  EXPECT_EQ(failures(verdict), "life counter not comparable");
  EXPECT_EQ(verdict.position, 0xA5U);
  EXPECT_EQ(verdict.life, 7U);
  EXPECT_FALSE(verdict.warning);
  verdict = safety.check(sample(0b0'111'10100101'0, 0b001000'0'10100101));
  EXPECT_EQ(failures(verdict), "error flag of the control word, error flag of the safety word");
  EXPECT_TRUE(verdict.warning);
}

// All pairs of positions of few bits, against arithmetic in integers.
TEST(Safety, Relation_IsThatOfTheConfiguration) {
  struct Relation {
    unsigned control_bits, safety_bits, control_shift, safety_shift, compare_bits;
    bool inverted;
    unsigned offset, tolerance;
  };
  const Relation relations[] = {
      {5, 5, 0, 0, 0, false, 0, 0}, {5, 5, 0, 0, 0, false, 0, 3}, {5, 5, 0, 0, 0, true, 0, 1},
      {5, 5, 0, 0, 0, false, 9, 2}, {6, 4, 2, 0, 0, false, 0, 1}, {4, 6, 0, 2, 0, false, 0, 0},
      {6, 4, 0, 0, 4, false, 0, 1}, {5, 5, 1, 1, 3, true, 5, 1},  {5, 5, 0, 0, 0, false, 0, 15},
  };
  for (const Relation& relation : relations) {
    SafetyConfig config =
        bp3_safety(static_cast<std::uint8_t>(relation.control_bits),
                   static_cast<std::uint8_t>(relation.safety_bits), kControlStart, kSafetyStart);
    config.control_shift = static_cast<std::uint8_t>(relation.control_shift);
    config.safety_shift = static_cast<std::uint8_t>(relation.safety_shift);
    config.compare_bits = static_cast<std::uint8_t>(relation.compare_bits);
    config.safety_inverted = relation.inverted;
    config.safety_offset = relation.offset;
    config.tolerance = relation.tolerance;
    Safety safety;
    ASSERT_EQ(safety.configure(config), SafetyField::kNone);
    const unsigned bits = relation.compare_bits != 0
                              ? relation.compare_bits
                              : std::min(relation.control_bits - relation.control_shift,
                                         relation.safety_bits - relation.safety_shift);
    const int range = 1 << bits;
    for (int control = 0; control < 1 << relation.control_bits; ++control) {
      for (int other = 0; other < 1 << relation.safety_bits; ++other) {
        Encoder encoder;
        encoder.control_bits = relation.control_bits;
        encoder.safety_bits = relation.safety_bits;
        encoder.position = static_cast<std::uint64_t>(control);
        encoder.safety_position = static_cast<std::uint64_t>(other);
        const int a = control / (1 << relation.control_shift);
        int b = other / (1 << relation.safety_shift);
        if (relation.inverted) b = -1 - b;
        b += static_cast<int>(relation.offset);
        const int distance = ((a - b) % range + range) % range;
        const bool good =
            std::min(distance, range - distance) <= static_cast<int>(relation.tolerance);
        EXPECT_EQ(safety.check(encoder.sample()).failed(SafetyCheck::kPositions), !good)
            << control << ", " << other;
      }
    }
  }
}

TEST(Safety, WordsOf64BitsAndOtherCrcs_AreTaken) {
  SafetyConfig config;
  config.control = {64, 62, 2, 1, 0, 0x12F, 0xFF};
  config.safety = {64, 56, 8, 7, 6, 0xB, 5};
  config.control_shift = 6;
  Safety safety;
  ASSERT_EQ(safety.configure(config), SafetyField::kNone);
  for (unsigned frame = 0; frame < 3; ++frame) {
    const std::uint64_t control = ~std::uint64_t{0} << 30U | 3U;
    const std::uint64_t word = ~std::uint64_t{0} << 30U | 0xC0U | frame;
    const SafetySample sample{
        {control, divide(0x12F, 8, 0xFF, control, 64), SafetyWordRead::State::kHere},
        {word, divide(0xB, 3, 5, word, 64), SafetyWordRead::State::kHere},
        true};
    EXPECT_EQ(failures(safety.check(sample)), frame == 0 ? "life counter not comparable" : "");
  }
}

TEST(Safety, ImpossibleMember_IsNamedAndNothingChanges) {
  struct Bad {
    SafetyField field;
    std::function<void(SafetyConfig&)> change;
  };
  const Bad bad[] = {
      {SafetyField::kControlDataBits, [](SafetyConfig& c) { c.control.data_bits = 0; }},
      {SafetyField::kControlDataBits, [](SafetyConfig& c) { c.control.data_bits = 65; }},
      {SafetyField::kControlPosition, [](SafetyConfig& c) { c.control.position_bits = 0; }},
      {SafetyField::kControlPosition, [](SafetyConfig& c) { c.control.position_bits = 29; }},
      {SafetyField::kControlPosition, [](SafetyConfig& c) { c.control.position_place = 3; }},
      {SafetyField::kControlPosition, [](SafetyConfig& c) { c.control.position_place = 200; }},
      {SafetyField::kControlFlags, [](SafetyConfig& c) { c.control.error_place = 28; }},
      {SafetyField::kControlFlags, [](SafetyConfig& c) { c.control.error_place = 2; }},
      {SafetyField::kControlFlags, [](SafetyConfig& c) { c.control.warning_place = 1; }},
      {SafetyField::kControlCrc, [](SafetyConfig& c) { c.control.crc_polynomial = 0; }},
      {SafetyField::kControlCrc, [](SafetyConfig& c) { c.control.crc_polynomial = 0x42; }},
      {SafetyField::kControlCrc, [](SafetyConfig& c) { c.control.crc_polynomial = 0x20001; }},
      {SafetyField::kSafetyDataBits, [](SafetyConfig& c) { c.safety.data_bits = 65; }},
      {SafetyField::kSafetyPosition, [](SafetyConfig& c) { c.safety.position_bits = 27; }},
      {SafetyField::kSafetyFlags, [](SafetyConfig& c) { c.safety.warning_place = 8; }},
      {SafetyField::kSafetyCrc, [](SafetyConfig& c) { c.safety.crc_polynomial = 1; }},
      {SafetyField::kLife, [](SafetyConfig& c) { c.life_bits = 1; }},
      {SafetyField::kLife, [](SafetyConfig& c) { c.life_bits = 9; }},
      {SafetyField::kLife, [](SafetyConfig& c) { c.life_place = 1; }},
      {SafetyField::kLife, [](SafetyConfig& c) { c.life_first = 2; }},
      {SafetyField::kShift, [](SafetyConfig& c) { c.control_shift = 26; }},
      {SafetyField::kShift, [](SafetyConfig& c) { c.safety_shift = 26; }},
      {SafetyField::kCompareBits, [](SafetyConfig& c) { c.compare_bits = 27; }},
      {SafetyField::kOffset, [](SafetyConfig& c) { c.safety_offset = 1U << 26U; }},
      {SafetyField::kTolerance, [](SafetyConfig& c) { c.tolerance = 1U << 25U; }},
  };
  Encoder encoder;
  Safety safety = started(config26(), encoder);
  for (const Bad& one : bad) {
    SafetyConfig config = config26();
    one.change(config);
    EXPECT_EQ(safety.configure(config), one.field);
    encoder.step();
    EXPECT_TRUE(safety.check(encoder.sample()).ok());
  }
  Safety never;
  EXPECT_EQ(failures(never.check(encoder.sample())), "not configured");
  static_assert(validate(bp3_safety(26, 26)) == SafetyField::kNone);
  static_assert(validate(bp3_safety(26, 12)) == SafetyField::kNone);
  static_assert(bp3_safety(26, 12).control_shift == 14);
  static_assert(bp3_safety(12, 26).safety_shift == 14);
}

// What the CRCs guarantee (docs/safety.md): in the control word one or two wrong bits and any
// burst of 6 bits, up to 63 bits with the CRC; in the safety word up to five wrong bits, any odd
// number of them and any burst of 16. Each guarantee, worked out from the remainders alone.
TEST(SafetyCrc, Guarantees_AreWhatTheManualSays) {
  const auto remainders = [](std::uint32_t polynomial, unsigned width, unsigned bits) {
    std::vector<unsigned> list;
    for (unsigned i = 0; i < bits; ++i) {
      const std::uint64_t one = i < width ? 0 : std::uint64_t{1} << (i - width);
      list.push_back(i < width ? 1U << i : divide(polynomial, width, 0, one, bits - width));
    }
    return list;
  };
  const std::vector<unsigned> six = remainders(0x43, 6, 63);
  std::vector<bool> known(64);
  for (const unsigned one : six) {
    EXPECT_NE(one, 0U);
    EXPECT_FALSE(known[one]) << "two wrong bits";
    known[one] = true;
  }
  EXPECT_EQ(divide(0x43, 6, 0, 1, 1), divide(0x43, 6, 0, std::uint64_t{1} << 63U, 64))
      << "not beyond 63 bits";
  const std::vector<unsigned> sixteen = remainders(0x190D9, 16, 64);
  // Number of ways to give each remainder by exactly k of the bits, up to the fifth.
  std::vector<std::vector<bool>> by(7, std::vector<bool>(1U << 16U));
  by[0][0] = true;
  for (const unsigned one : sixteen) {
    EXPECT_EQ(__builtin_popcount(one) % 2, 1) << "an odd number of wrong bits is never 0";
    for (unsigned k = 6; k-- > 0;) {
      for (unsigned remainder = 0; remainder < 1U << 16U; ++remainder) {
        if (by[k][remainder]) by[k + 1][remainder ^ one] = true;
      }
    }
  }
  for (unsigned k = 1; k <= 5; ++k) EXPECT_FALSE(by[k][0]) << k << " wrong bits";
  EXPECT_TRUE(by[6][0]) << "six may stay unseen";
}

// Faults that must be found: errors on the line within the guarantees of the CRCs, and words that
// are right by themselves but not where or when they should be.
class Injector {
 public:
  explicit Injector(unsigned seed) : random_(seed) {}

  unsigned up_to(unsigned most) {
    return std::uniform_int_distribution<unsigned>(0, most)(random_);
  }
  std::uint64_t bits(unsigned count) { return random_() & ((std::uint64_t{1} << count) - 1); }

  // Inverts `count` different bits of data and CRC.
  void flip(SafetyWordRead& word, unsigned data_bits, unsigned crc_bits, unsigned count) {
    std::uint64_t done = 0;
    while (count > 0) {
      const unsigned bit = up_to(data_bits + crc_bits - 1);
      if ((done >> bit & 1U) != 0) continue;
      done |= std::uint64_t{1} << bit;
      invert(word, crc_bits, bit);
      --count;
    }
  }
  // A burst: first and last bit are inverted, those between at random.
  void burst(SafetyWordRead& word, unsigned data_bits, unsigned crc_bits, unsigned length) {
    const unsigned first = up_to(data_bits + crc_bits - length);
    for (unsigned i = 0; i < length; ++i) {
      if (i == 0 || i + 1 == length || up_to(1) == 1) invert(word, crc_bits, first + i);
    }
  }

 private:
  static void invert(SafetyWordRead& word, unsigned crc_bits, unsigned bit) {
    if (bit < crc_bits) {
      word.crc = static_cast<std::uint16_t>(word.crc ^ 1U << bit);
    } else {
      word.data ^= std::uint64_t{1} << (bit - crc_bits);
    }
  }

  std::mt19937_64 random_;
};

// 10^5 faults, or 10^6 in the night (MB4_ALL_FAULTS).
TEST(SafetyFaults, EachKind_NoneIsUndetected) {
  const unsigned kFaults = std::getenv("MB4_ALL_FAULTS") != nullptr ? 1'000'000 : 100'000;
  constexpr unsigned kSeed = 1;
  constexpr unsigned kKinds = 10;
  Injector inject(kSeed);
  unsigned undetected = 0;
  std::vector<unsigned> counts(kKinds);
  for (unsigned done = 0; done < kFaults; ++done) {
    Encoder encoder;
    encoder.control_bits = 12 + inject.up_to(26);
    encoder.safety_bits = 12 + inject.up_to(28);
    const auto both = std::min(encoder.control_bits, encoder.safety_bits);
    encoder.safety_position = inject.bits(both);
    encoder.position = encoder.safety_position;
    encoder.life = inject.up_to(63);
    SafetyConfig config =
        bp3_safety(static_cast<std::uint8_t>(encoder.control_bits),
                   static_cast<std::uint8_t>(encoder.safety_bits), kControlStart, kSafetyStart);
    config.control_shift = config.safety_shift = 0;
    Safety safety;
    ASSERT_EQ(safety.configure(config), SafetyField::kNone);
    const SafetySample before = encoder.sample();
    ASSERT_FALSE(safety.check(before).ok());
    encoder.life = (encoder.life + 1) % 64;
    const SafetySample sent = encoder.sample();
    SafetySample sample = sent;
    const unsigned kind = done % kKinds;
    const unsigned control = encoder.control_bits + 2;
    const unsigned word = encoder.safety_bits + 8;
    switch (kind) {
      case 0:
        inject.flip(sample.control, control, 6, 1 + inject.up_to(1));
        break;
      case 1:
        inject.burst(sample.control, control, 6, 1 + inject.up_to(5));
        break;
      case 2:
        inject.flip(sample.safety, word, 16, 1 + inject.up_to(4));
        break;
      case 3:
        inject.flip(sample.safety, word, 16, 1 + 2 * inject.up_to(9));
        break;
      case 4:
        inject.burst(sample.safety, word, 16, 1 + inject.up_to(15));
        break;
      case 5:  // both words at once
        inject.flip(sample.control, control, 6, 1 + inject.up_to(1));
        inject.flip(sample.safety, word, 16, 1 + inject.up_to(4));
        break;
      case 6:  // the last safety word again
        sample.safety = before.safety;
        break;
      case 7:  // a counter that is 0 or 2 to 63 steps on
        encoder.life = (encoder.life + 1 + inject.up_to(62)) % 64;
        sample = encoder.sample();
        break;
      case 8:  // the start value of the other word
        sample.safety.crc = divide(0x190D9, 16, kControlStart, sample.safety.data, word);
        break;
      default:  // a right control word of another position
        encoder.position ^= std::uint64_t{1} << inject.up_to(both - 1);
        sample.control = encoder.sample().control;
        break;
    }
    const SafetyVerdict verdict = safety.check(sample);
    ++counts[kind];
    if (verdict.ok()) {
      ++undetected;
      ADD_FAILURE() << "seed " << kSeed << ", fault " << done << " of kind " << kind;
      if (undetected == 10) return;
    }
    // Without the fault the same frame is good.
    Safety twin;
    ASSERT_EQ(twin.configure(config), SafetyField::kNone);
    static_cast<void>(twin.check(before));
    ASSERT_TRUE(twin.check(sent).ok());
  }
  std::cout << "faults injected " << kFaults << ", undetected " << undetected << "\n";
  for (const unsigned count : counts) EXPECT_EQ(count, kFaults / kKinds);
}

}  // namespace
