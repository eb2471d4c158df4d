// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_os_sampler: bytes, ones, sample point, bits. Expected places are those of
// TIDEP0022, 3.2.4.2.5 (N ones, X = 7 - N), computed from the text.
#include <gtest/gtest.h>

#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "Vbiss_os_sampler.h"
#include "tests/support/model_context.hpp"

namespace {

// Number of the sample from the byte's first one on: in the byte itself, or in the next one.
unsigned place_of(unsigned byte) {
  const int ones = static_cast<int>(std::bitset<8>(byte).count());
  const int x = 7 - ones;
  // X > 4: bit X - 4 of this byte; X < 4: bit 8 - (4 - X) of the next; X = 4: bit 0 of this one.
  if (x >= 4) return static_cast<unsigned>(7 - (x - 4));
  return static_cast<unsigned>(8 + 7 - (8 - (4 - x)));
}

class OsSampler : public testing::TestWithParam<unsigned> {
 protected:
  OsSampler() {
    m.clk_i = m.rst_ni = m.sample_i = m.last_i = m.clear_i = m.search_i = m.first_low_i = 0;
    m.point_i = 0;
    m.sl_i = 1;
    m.eval();
    clock();
    m.rst_ni = 1;
    clock();
  }
  void clock() {
    m.eval();
    if (follow) m.point_i = m.place_o;
    m.eval();
    if (m.bit_valid_o != 0) bits += m.bit_o != 0 ? '1' : '0';
    if (m.byte_o != 0) ++bytes;
    m.clk_i = 1;
    m.eval();
    m.clk_i = 0;
    m.eval();
  }
  // A sample of this level, `gap` clocks behind the one before.
  void sample(bool level) {
    for (unsigned i = 1; i < GetParam(); ++i) {
      m.sample_i = 0;
      m.sl_i = dice.below(2) != 0;  // between samples the line is anything
      clock();
    }
    m.sample_i = 1;
    m.last_i = number % 8 == 7;
    m.sl_i = level;
    clock();
    m.sample_i = 0;
    ++number;
  }
  void byte(unsigned value) {
    for (int bit = 7; bit >= 0; --bit) sample((value >> bit & 1U) != 0);
  }
  void begin() {
    for (int i = 0; i < 6; ++i) clock();
    m.search_i = 0;
    m.clear_i = 1;
    clock();
    m.clear_i = 0;
    number = 0;
    bits.clear();
    bytes = 0;
    byte(0xFF);  // before the search
    m.search_i = 1;
  }

  mb4test::Dice dice;
  mb4test::Owned<Vbiss_os_sampler> owner;
  Vbiss_os_sampler& m = *owner;
  unsigned number = 0;
  std::string bits;
  unsigned bytes = 0;
  bool follow = true;
};

// After each of the 255 bytes with a low sample each bit is right in one sample only.
TEST_P(OsSampler, EachTransitionByte_SelectsTheSampleOfTheText) {
  for (unsigned value = 0; value < 255; ++value) {
    begin();
    const unsigned before = dice.below(3);
    for (unsigned i = 0; i < before; ++i) byte(0xFF);
    byte(value);
    const unsigned place = place_of(value);
    const std::string sent = "10110100101";
    for (unsigned i = 0; i < (sent.size() + 1) * 8; ++i) {
      const int since = static_cast<int>(8 + i) - static_cast<int>(place);
      const unsigned bit = since > 0 ? static_cast<unsigned>(since - 1) / 8 : 0;
      const bool right = since > 0 && since % 8 == 0;
      // The bit that the next right sample has, and its inverse everywhere else.
      const bool level = bit < sent.size() && sent[bit] == '1';
      sample(right == level);
    }
    for (int i = 0; i < 5; ++i) clock();
    ASSERT_EQ(m.found_o, 1) << value;
    EXPECT_EQ(m.raw_o, value);
    EXPECT_EQ(m.place_o, place) << value;
    EXPECT_EQ(bytes, before + 1);
    EXPECT_EQ(bits.substr(0, sent.size()), sent) << value;
  }
}

// The example of the text: 0xF5 has six ones, bit 5 of the byte after it.
TEST_P(OsSampler, ByteF5_IsBit5OfTheByteAfter) {
  begin();
  byte(0xF5);
  for (int i = 0; i < 5; ++i) clock();
  EXPECT_EQ(m.place_o, 8U + 7U - 5U);
}

// FIRST_LOW: the fourth sample behind the first low one, whatever follows it.
TEST_P(OsSampler, FirstLow_CountsFromTheFirstLowSample) {
  m.first_low_i = 1;
  for (unsigned value = 0; value < 255; ++value) {
    begin();
    byte(value);
    for (int i = 0; i < 5; ++i) clock();
    unsigned first = 0;
    while ((value >> (7 - first) & 1U) != 0) ++first;
    EXPECT_EQ(m.place_o, first + 4) << value;
    EXPECT_EQ(m.raw_o, value);
  }
}

// Whatever the user makes of the place, bit k is sample point + 8 k. A point below 4 needs two
// clocks between samples.
TEST_P(OsSampler, AnyPoint_TakesItsSamples) {
  follow = false;
  for (unsigned point = GetParam() == 1 ? 4 : 0; point < 16; ++point) {
    begin();
    m.point_i = static_cast<std::uint8_t>(point);
    byte(0xF0);
    std::string expected;
    for (unsigned i = 8; i < 80; ++i) {
      const bool level = dice.below(2) != 0;
      sample(level);
      if (i >= point + 8 && (i - point) % 8 == 0) expected += level ? '1' : '0';
    }
    for (int i = 0; i < 5; ++i) clock();
    EXPECT_EQ(bits, expected) << point;
  }
}

INSTANTIATE_TEST_SUITE_P(Gap, OsSampler, testing::Values(1, 2, 5),
                         [](const auto& test) { return "Clocks" + std::to_string(test.param); });

}  // namespace
