// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Line code, check sums, equaliser and signal strength of DSL against the golden vectors
// and counts of the published facts (D-10), and the encoder's code against the master's.
#include "sim/lines/dsl/dsl_code.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/masters/dsl_model/frame_plan.hpp"
#include "sim/masters/dsl_model/line_code.hpp"
#include "sim/masters/dsl_model/link.hpp"
#include "sim/masters/dsl_model/motion.hpp"
#include "sim/masters/dsl_model/receiver.hpp"

namespace {

using namespace mb4::sim::dsl_model;
namespace encoder = mb4::sim::dsl;

std::string text(unsigned bits, unsigned count) {
  return std::bitset<16>(bits).to_string().substr(16 - count);
}

std::string sent(unsigned byte, int disparity) {
  return text(encode_parameter(byte, disparity), 10);
}

struct Golden {
  unsigned byte;
  const char* word;
};

TEST(DslCode, GoldenWords_OfTheMaster) {
  constexpr Golden kWords[] = {
      {kReset, "0101001011"},       {kSync, "1001100100"},        {kStart, "0101100100"},
      {kLearn, "0010011011"},       {kCheck, "1100001011"},       {kIdRequest, "0100011011"},
      {0x80 | kInit, "1000011101"}, {0x80 | kIdle, "1001001101"}, {0xC0 | kIdle, "1001000110"}};
  for (const auto& [byte, word] : kWords) {
    for (const int start : {0, 1}) EXPECT_EQ(sent(byte, start), word) << byte << " at " << start;
  }
  // The disparity at the begin decides.
  EXPECT_EQ(sent(0x80 | kIdle, 2), "1001000010");
  EXPECT_EQ(sent(0x80 | kIdle, 5), "1001000010");
  EXPECT_EQ(sent(0x80 | kIdle, -1), "0110110010");
  EXPECT_EQ(sent(0x80 | kIdle, -2), "0110110010");
  EXPECT_EQ(sent(0x80 | kIdle, -3), "0110111101");
}

// The encoder reads what the master sends, whatever the disparity.
TEST(DslCode, EncoderReadsTheMaster_AtEachDisparity) {
  for (unsigned byte = 0; byte < 256; ++byte) {
    for (int start = -5; start <= 5; ++start) {
      int disparity = start;
      EXPECT_EQ(encoder::parameter_of(encode_parameter(byte, disparity)), byte) << start;
    }
  }
}

// 256 bytes from both disparities, by both checks.
TEST(DslCode, EncodersWords_512Of512AreRead) {
  for (const bool positive : {false, true}) {
    for (unsigned byte = 0; byte < 256; ++byte) {
      encoder::Coder coder(positive);
      const unsigned word = coder.data(static_cast<std::uint8_t>(byte));
      for (const CodeCheck check : {CodeCheck::kPublished, CodeCheck::kStrict}) {
        for (const Channel channel : {Channel::kPlain, Channel::kSecond}) {
          const Word read = decode(word, check, channel);
          EXPECT_EQ(read.byte, byte) << text(word, 10);
          EXPECT_FALSE(read.error) << text(word, 10);
          EXPECT_FALSE(read.special) << text(word, 10);
        }
      }
    }
  }
}

// The encoder's running disparity stays inside +-1, and no six equal bits stand in a row.
TEST(DslCode, EncodersWords_AreBalanced) {
  unsigned seed = 1;
  encoder::Coder coder(false);
  int sum = 0;
  unsigned run = 0;
  int last = -1;
  for (unsigned i = 0; i < 20'000; ++i) {
    seed = seed * 1664525U + 1013904223U;
    const unsigned word = coder.data(static_cast<std::uint8_t>(seed >> 24U));
    for (unsigned bit = 10; bit-- > 0;) {
      const int level = static_cast<int>(word >> bit & 1U);
      run = level == last ? run + 1 : 1;
      last = level;
      ASSERT_LE(run, 5U);
      sum += level == 1 ? 1 : -1;
      ASSERT_LE(std::abs(sum - 1), 3);  // it began at -1
    }
    ASSERT_TRUE(sum == 0 || sum == 2) << sum;  // from a negative start
  }
}

// 440 data words, 16 of K28.0 to K28.7, 8 of K23.7, K27.7, K29.7, K30.7.
TEST(DslCode, LegalWords_Are464) {
  std::set<unsigned> data;
  std::set<unsigned> k28;
  std::set<unsigned> others;
  for (const bool positive : {false, true}) {
    for (unsigned byte = 0; byte < 256; ++byte) {
      data.insert(encoder::Coder(positive).data(static_cast<std::uint8_t>(byte)));
    }
    for (unsigned y = 0; y < 8; ++y) {
      const auto byte = static_cast<std::uint8_t>(y << 5U | 28U);
      const unsigned word = encoder::Coder(positive).special(byte);
      k28.insert(word);
      for (const Channel channel : {Channel::kPlain, Channel::kSecond}) {
        const Word read = decode(word, CodeCheck::kStrict, channel);
        EXPECT_TRUE(read.is_k28()) << text(word, 10);
        EXPECT_EQ(read.byte, byte) << text(word, 10);
      }
    }
    for (const unsigned byte : {0xF7, 0xFB, 0xFD, 0xFE}) {
      const unsigned word = encoder::Coder(positive).special(static_cast<std::uint8_t>(byte));
      others.insert(word);
      EXPECT_TRUE(decode(word, CodeCheck::kStrict).is(static_cast<std::uint8_t>(byte)));
      const Word published = decode(word, CodeCheck::kPublished);
      EXPECT_TRUE(published.is(static_cast<std::uint8_t>(byte))) << text(word, 10);
    }
  }
  EXPECT_EQ(data.size(), 440U);
  EXPECT_EQ(k28.size(), 16U);
  EXPECT_EQ(others.size(), 8U);
  unsigned legal = 0;
  for (unsigned word = 0; word < 1024; ++word) {
    const Word read = decode(word, CodeCheck::kStrict);
    const bool in_a_list = data.contains(word) || k28.contains(word) || others.contains(word);
    EXPECT_EQ(!read.error, in_a_list) << text(word, 10);
    if (!read.error) {
      ++legal;
      EXPECT_EQ(read.special, !data.contains(word)) << text(word, 10);
    }
  }
  EXPECT_EQ(legal, 464U);
}

// M_PAR CHECK with first = 0 is K28.0, which the master's own tables read.
TEST(DslCode, Check_IsK28_0) {
  int disparity = 0;
  EXPECT_EQ(encode_parameter(kCheck, disparity), encoder::Coder(true).special(0x1C));
}

// What the published check sees: 184 words; 392 of the illegal ones pass in silence, 376 without
// those of K28.
TEST(DslCode, PublishedCheck_FlagsWhatIsKnown) {
  unsigned flagged = 0;
  unsigned silent = 0;
  unsigned only_strict = 0;
  for (unsigned word = 0; word < 1024; ++word) {
    const bool published = decode(word, CodeCheck::kPublished).error;
    const Word strict = decode(word, CodeCheck::kStrict);
    const bool legal = !strict.error && !strict.is_k28();
    flagged += published ? 1U : 0U;
    silent += !legal && !published ? 1U : 0U;
    only_strict += strict.only_strict ? 1U : 0U;
  }
  EXPECT_EQ(flagged, 184U);
  EXPECT_EQ(silent, 392U);
  EXPECT_EQ(only_strict, 376U);
  EXPECT_EQ(decode(0b1111000000, CodeCheck::kPublished).byte, 0xFF);
}

// The published receiver gives K28.1, K28.2, K28.5, K28.6 their bits back in the second channel
// only.
TEST(DslCode, PublishedCheck_MendsK28OfTheSecondChannel) {
  for (const unsigned y : {1U, 2U, 5U, 6U}) {
    const auto byte = static_cast<std::uint8_t>(y << 5U | 28U);
    const unsigned word = encoder::Coder(true).special(byte);
    EXPECT_EQ(decode(word, CodeCheck::kPublished, Channel::kSecond).byte, byte);
    EXPECT_EQ(decode(word, CodeCheck::kPublished).byte, byte ^ 0xE0U);
  }
}

// R13: the strict check gives them back in each channel but the acceleration, where a wrong bit
// could make one; in the personality of the SDK in the second channel only.
TEST(DslCode, StrictCheck_MendsK28ByThePersonality) {
  for (const unsigned y : {1U, 2U, 5U, 6U}) {
    const auto byte = static_cast<std::uint8_t>(y << 5U | 28U);
    const unsigned word = encoder::Coder(true).special(byte);
    std::uint64_t five = 0;
    for (unsigned i = 0; i < 5; ++i) five = five << 10U | word;
    const std::uint64_t answer = five << 11U | word;
    for (const bool sdk : {false, true}) {
      const auto words = words_of(answer, CodeCheck::kStrict, sdk);
      for (const auto* each : {&words.vertical, &words.parameter, &words.pipeline}) {
        EXPECT_EQ(each->byte, sdk ? byte ^ 0xE0U : byte);
        EXPECT_FALSE(each->error);
      }
      EXPECT_EQ(words.acceleration_high.byte, byte ^ 0xE0U);
      EXPECT_EQ(words.acceleration_low.byte, byte ^ 0xE0U);
      EXPECT_EQ(words.secondary.byte, byte);
    }
  }
}

// Single line errors of data bytes: 93.1 % pass the published check. In the acceleration field CRC5
// lets 192 of 81,920 pass with it, none with the strict check.
TEST(DslCode, SingleErrors_PassAsKnown) {
  unsigned all = 0;
  unsigned pass = 0;
  for (const bool positive : {false, true}) {
    for (unsigned byte = 0; byte < 256; ++byte) {
      const unsigned word = encoder::Coder(positive).data(static_cast<std::uint8_t>(byte));
      for (unsigned bit = 0; bit < 10; ++bit, ++all) {
        pass += decode(word ^ 1U << bit, CodeCheck::kPublished).error ? 0U : 1U;
      }
    }
  }
  EXPECT_NEAR(100.0 * pass / all, 93.1, 0.05);

  unsigned tried = 0;
  unsigned silent[2] = {0, 0};
  for (const bool positive : {false, true}) {
    for (int a = -1024; a < 1024; ++a) {
      const unsigned sent_word = encoder::with_check(a);
      encoder::Coder coder(positive);
      const unsigned high = coder.data(static_cast<std::uint8_t>(sent_word >> 8U));
      const unsigned low = coder.data(static_cast<std::uint8_t>(sent_word));
      for (unsigned bit = 0; bit < 20; ++bit, ++tried) {
        const unsigned line = (high << 10U | low) ^ 1U << bit;
        for (const CodeCheck check : {CodeCheck::kPublished, CodeCheck::kStrict}) {
          // The answer as the master takes it, by its own rule. K28 and D28 are the same byte.
          const std::optional<int> taken =
              acceleration_in(words_of(std::uint64_t{line} << 11U, check), check);
          const bool wrong = taken.has_value() && *taken != a;
          silent[check == CodeCheck::kStrict ? 1 : 0] += wrong ? 1U : 0U;
        }
      }
    }
  }
  EXPECT_EQ(tried, 81'920U);
  EXPECT_EQ(silent[0], 192U);
  EXPECT_EQ(silent[1], 0U);
}

TEST(DslCode, GoldenCheckSums_OfBothSides) {
  constexpr std::array<std::uint8_t, 6> kZero{};
  constexpr std::array<std::uint8_t, 6> kA{0x00, 0x00, 0x01, 0x23, 0x45, 0x67};
  constexpr std::array<std::uint8_t, 6> kB{0x01, 0x12, 0x34, 0x56, 0x78, 0x9A};
  EXPECT_EQ(crc16(kZero), 0x00FF);
  EXPECT_EQ(crc16(kA), 0x4BBE);
  EXPECT_EQ(crc16(kB), 0x029D);
  EXPECT_EQ(encoder::check_safe({0, 0, 0, 0, 0, 0}), 0x00FF);
  EXPECT_EQ(encoder::check_safe({0x00, 0x00, 0x01, 0x23, 0x45, 0x67}), 0x4BBE);
  EXPECT_EQ(encoder::check_safe({0x01, 0x12, 0x34, 0x56, 0x78, 0x9A}), 0x029D);
  struct {
    int acceleration;
    unsigned word;
  } constexpr kWords[] = {{0, 0x001F}, {1, 0x003A}, {-1, 0xFFF5}, {5, 0x00AE}, {-5, 0xFF61}};
  for (const auto& [acceleration, word] : kWords) {
    EXPECT_EQ(acceleration_word(acceleration), word);
    EXPECT_EQ(encoder::with_check(acceleration), word);
  }
  for (int a = -1024; a < 1024; ++a) {
    const std::uint16_t word = encoder::with_check(a);
    EXPECT_TRUE(acceleration_is_good(word));
    EXPECT_EQ(acceleration_of(word), a);
    EXPECT_FALSE(acceleration_is_good(word ^ 1U));
  }
  EXPECT_FALSE(acceleration_is_good(0xFDFD));  // the marker, if it came as data
}

// The frame of a restart on, EQUALISATION and M_PAR, by the whole ones of the sync mode's plan.
std::vector<std::string> start_up(unsigned extra) {
  struct {
    unsigned symbol;
    unsigned frames;
    bool answer;
  } constexpr kStates[] = {{kReset, 2, false},      {kSync, 16, false},     {kStart, 9, true},
                           {kLearn, 9, true},       {kCheck, 16, true},     {kIdRequest, 1, true},
                           {0x80 | kInit, 3, true}, {0x80 | kIdle, 8, true}};
  std::vector<std::string> frames;
  FramePlan plan;
  int disparity = 0;
  for (const auto& [symbol, count, answer] : kStates) {
    for (unsigned i = 0; i < count; ++i) {
      plan.make(symbol, answer, {.extra = extra}, disparity, static_cast<int>(extra));
      frames.push_back(text(plan.parameter_word(), 10) + " " + text(plan.equalisation(), 4));
      EXPECT_LE(std::abs(disparity), 127);
    }
  }
  return frames;
}

// F4: what differs from the vectors of a free run stands here.
TEST(DslCode, StartUp_InFreeRunAndSyncMode) {
  const std::vector<std::string> free{"0101001011 0000", "0101001011 1101", "1001100100 1101",
                                      "1001100100 0000"};
  const std::vector<std::string> four{"0101001011 0000", "0101001011 0010", "1001100100 0010",
                                      "1001100100 0000"};
  const std::vector<std::string> five{"0101001011 0000", "0101001011 0000", "1001100100 0010",
                                      "1001100100 0000"};
  for (const auto& [extra, begin] : {std::pair{0U, free}, {4U, four}, {5U, five}}) {
    const auto frames = start_up(extra);
    for (unsigned i = 0; i < frames.size(); ++i) {
      const char* const later[] = {"1001100100", "0101100100", "0010011011", "1100001011",
                                   "0100011011", "1000011101", "1001001101"};
      constexpr unsigned kUpTo[] = {18, 27, 36, 52, 53, 56, 64};
      unsigned state = 0;
      while (i >= kUpTo[state]) ++state;
      EXPECT_EQ(frames[i], i < begin.size() ? begin[i] : later[state] + std::string(" 0000"))
          << "E " << extra << " frame " << i;
    }
  }
  for (unsigned extra = 6; extra <= 9; ++extra) {
    const auto frames = start_up(extra);
    const char* const words[] = {"0101000100", "1001100100", "0101100100", "0010010100",
                                 "1100000100", "0100010100", "1000010010", "1001000010"};
    constexpr unsigned kUpTo[] = {2, 18, 27, 36, 52, 53, 56, 64};
    for (unsigned i = 0; i < frames.size(); ++i) {
      unsigned state = 0;
      while (i >= kUpTo[state]) ++state;
      EXPECT_EQ(frames[i], words[state] + std::string(" 0000")) << "E " << extra << " frame " << i;
    }
  }
}

// F1: with eighths left over SAMPLE has one more bit, which is high for these eighths; 0 and 110
// follow. The sampling edge is that of this bit. The equaliser counts whole ones alone.
TEST(DslCode, SampleWindow_HasOnesAndEighths) {
  for (unsigned extra = 0; extra <= 9; ++extra) {
    for (unsigned rest = 0; rest < 8; ++rest) {
      FramePlan plan;
      int disparity = 0;
      plan.make(kReset, true, {.extra = extra, .rest = rest}, disparity, 0);
      std::string eighths;
      for (unsigned bit = 0; bit < 8 + extra + (rest != 0 ? 1U : 0U) + 4; ++bit) {
        for (unsigned i = 0; i < 8; ++i) eighths += plan.level(bit, i) ? '1' : '0';
      }
      std::string expected;
      for (const char c : std::string("00101111") + std::string(extra, '1')) {
        expected += std::string(8, c);
      }
      const std::size_t edge = expected.size() + rest;
      if (rest != 0) expected += std::string(rest, '1') + std::string(8 - rest, '0');
      for (const char c : std::string("0110")) expected += std::string(8, c);
      EXPECT_EQ(eighths, expected) << extra << " " << rest;
      EXPECT_EQ(plan.sample_tick(), edge) << extra << " " << rest;
      EXPECT_EQ(plan.bits(), 108 + extra + (rest != 0 ? 1U : 0U)) << extra << " " << rest;
      EXPECT_EQ(plan.switch_bit(), 26 + extra + (rest != 0 ? 1U : 0U)) << extra << " " << rest;
      EXPECT_EQ(plan.equalisation(), 0U);
      EXPECT_EQ(text(plan.parameter_word(), 10), "0101001011");
    }
  }
}

// In sync mode with E = 9 the disparity climbs to 91 in the frames without an answer.
TEST(DslCode, Disparity_ClimbsTo91) {
  FramePlan plan;
  int disparity = 0;
  for (unsigned i = 0; i < 18; ++i) {
    plan.make(i < 2 ? kReset : kSync, false, {.extra = 9}, disparity, 9);
  }
  int after = disparity + 9;
  equalise(after);
  EXPECT_EQ(after, 91);
}

// 209 patterns follow the rule in the table; the other 47, with no gap above 2, hold 12 there.
TEST(DslCode, SignalStrength_Of256Patterns) {
  unsigned follow = 0;
  unsigned differ = 0;
  for (unsigned edges = 0; edges < 256; ++edges) {
    // Independent of the code under test: the longest run without an edge in the pattern, twice.
    unsigned longest = 0;
    unsigned run = 0;
    for (unsigned i = 0; i < 16; ++i) {
      run = (edges >> (i % 8) & 1U) != 0 ? 0 : run + 1;
      longest = std::max(longest, std::min(run, 8U));
    }
    const bool few = std::bitset<8>(edges).count() <= 1;
    const unsigned gap = longest + 1;  // samples from one edge to the next
    const unsigned rule = few ? 12 : gap <= 2 ? 0 : 2 * (gap - 2);
    EXPECT_EQ(rssi_of(static_cast<std::uint8_t>(edges), false), rule) << edges;
    const unsigned table = rssi_of(static_cast<std::uint8_t>(edges), true);
    EXPECT_EQ(table, !few && gap <= 2 ? 12U : rule) << edges;
    (table == rule ? follow : differ) += 1;
  }
  EXPECT_EQ(follow, 209U);
  EXPECT_EQ(differ, 47U);
}

// The last second difference and weighted changes before it: 16, 8, 4, 2, 1 of 32 parts.
TEST(DslCode, Estimate_ByItsFormula) {
  EXPECT_EQ(estimate({0, 0, 0, 0, 0, 0}), 0);
  EXPECT_EQ(estimate({100, 100, 100, 100, 100, 100}), 100);
  EXPECT_EQ(estimate({32, 0, 0, 0, 0, 0}), 32 + 16);
  EXPECT_EQ(estimate({0, 32, 0, 0, 0, 0}), 0 - 16 + 8);
  EXPECT_EQ(estimate({5, 4, 3, 2, 1, 0}), 5 + (31 >> 5));
  EXPECT_EQ(estimate({-1, 0, 0, 0, 0, 0}), -1 + -1);  // the shift rounds down
  EXPECT_EQ(estimate({-1000, 0, 0, 0, 0, 0}), -1024);
  EXPECT_EQ(estimate({1000, 0, 0, 0, 0, 0}), 1023);
  // 16 x 2047 = 32752 fits into 16 bits, 31 x 2047 does not.
  EXPECT_EQ(estimate({1023, -1024, 1023, 1023, 1023, 1023}), 1023);
}

}  // namespace
