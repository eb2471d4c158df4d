// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/dsl_words.hpp"

#include <array>
#include <bit>

namespace mb4::tool {
namespace {

// 8b/10b: the blocks at a negative disparity, in octal and in hexadecimal digits.
constexpr std::array<unsigned, 32> kSixOf = {047, 035, 055, 061, 065, 051, 031, 070, 071, 045, 025,
                                             064, 015, 054, 034, 027, 033, 043, 023, 062, 013, 052,
                                             032, 072, 063, 046, 026, 066, 016, 056, 036, 053};
constexpr std::array<unsigned, 8> kFourOf = {0xB, 0x9, 0x5, 0xC, 0xD, 0xA, 0x6, 0xE};
constexpr std::array<unsigned, 8> kFourOfComma = {0x4, 0x9, 0x5, 0x3, 0x2, 0xA, 0x6, 0x8};
constexpr unsigned kComma = 28;  // K28.x
constexpr unsigned kSixOfComma = 017;
constexpr unsigned kFourOfSpecial = 0x7;  // of K23.7 and so on, and of D x.7 behind two equal bits

constexpr bool balanced(unsigned block, unsigned bits) {
  return 2U * static_cast<unsigned>(std::popcount(block)) == bits;
}

struct Block {
  unsigned bits;
  bool positive;  // the disparity behind it
};

// `twins`: it has two forms although it is balanced.
constexpr Block at(unsigned block, unsigned bits, bool positive, bool twins) {
  const bool even = balanced(block, bits);
  const unsigned inverted = block ^ ((1U << bits) - 1);
  return {positive && (!even || twins) ? inverted : block, positive != !even};
}

constexpr std::array<DslWord, 1024> make_words() {
  std::array<DslWord, 1024> words{};
  for (const bool start : {false, true}) {
    for (unsigned x = 0; x < 32; ++x) {
      const Block six = at(kSixOf[x], 6, start, x == 7);
      for (unsigned y = 0; y < 8; ++y) {
        const unsigned last = six.bits & 3U;
        const bool other = y == 7 && last == (six.positive ? 0U : 3U);
        const Block four = at(other ? kFourOfSpecial : kFourOf[y], 4, six.positive, y == 3);
        words[six.bits << 4U | four.bits] = {static_cast<std::uint8_t>(y << 5U | x), false, false};
      }
      if (x != 23 && x != 27 && x != 29 && x != 30) continue;
      const Block four = at(kFourOfSpecial, 4, six.positive, false);
      words[six.bits << 4U | four.bits] = {static_cast<std::uint8_t>(7U << 5U | x), false, true};
    }
    for (unsigned y = 0; y < 8; ++y) {
      const unsigned word = kSixOfComma << 4U | kFourOfComma[y];
      words[start ? word ^ 0x3FFU : word] = {static_cast<std::uint8_t>(y << 5U | kComma), false,
                                             true};
    }
  }
  return words;
}

constexpr std::array<DslWord, 1024> kWords = make_words();

// x^5 + x^2 + 1 over 11 bits, inverted.
unsigned check_of(unsigned difference) {
  unsigned rest = difference << 5U;
  for (unsigned bit = 15; bit >= 5; --bit) {
    if ((rest >> bit & 1U) != 0) rest ^= 0b100101U << (bit - 5);
  }
  return rest ^ 0x1FU;
}

}  // namespace

DslWord dsl_word(unsigned word) { return kWords[word & 0x3FFU]; }

std::optional<std::uint8_t> dsl_parameter(unsigned word) {
  const auto is = [](unsigned bits, unsigned block, unsigned count, bool twins) {
    return bits == at(block, count, false, twins).bits ||
           bits == at(block, count, true, twins).bits;
  };
  const unsigned six = word >> 4U & 0x3FU;
  const unsigned four = word & 0xFU;
  for (unsigned x = 0; x < 32; ++x) {
    if (!is(six, kSixOf[x], 6, x == 7) && !(x == kComma && is(six, kSixOfComma, 6, false)))
      continue;
    for (unsigned y = 0; y < 8; ++y) {
      if (is(four, kFourOf[y], 4, y == 3)) return static_cast<std::uint8_t>(y << 5U | x);
    }
  }
  return std::nullopt;
}

// x^16 + x^15 + x^12 + x^7 + x^6 + x^4 + x^3 + 1, the low byte inverted.
std::uint16_t dsl_check(std::span<const std::uint8_t> bytes) {
  unsigned rest = 0;
  for (const std::uint8_t byte : bytes) {
    for (unsigned bit = 8; bit-- > 0;) {
      const bool out = ((rest >> 15U ^ byte >> bit) & 1U) != 0;
      rest = (rest << 1U & 0xFFFFU) ^ (out ? 0x90D9U : 0U);
    }
  }
  return static_cast<std::uint16_t>(rest ^ 0x00FFU);
}

// K28.x stands for a byte; behind the block 110000 its upper bits are those of a data word here, as
// a single wrong bit of D7.x could pass CRC5 otherwise.
std::optional<int> dsl_second_difference(unsigned high, unsigned low) {
  unsigned bytes = 0;
  for (const unsigned word : {high, low}) {
    const DslWord read = dsl_word(word);
    if (read.error || (read.special && (read.byte & 0x1FU) != kComma)) return std::nullopt;
    const unsigned y = read.byte >> 5U;
    const bool turned = read.special && word >> 4U == (kSixOfComma ^ 0x3FU) &&
                        (y == 1 || y == 2 || y == 5 || y == 6);
    bytes = bytes << 8U | (read.byte ^ (turned ? 0xE0U : 0U));
  }
  const unsigned difference = bytes >> 5U;
  if (check_of(difference) != (bytes & 0x1FU)) return std::nullopt;
  return static_cast<int>(difference) - (difference >= 1024 ? 2048 : 0);
}

}  // namespace mb4::tool
