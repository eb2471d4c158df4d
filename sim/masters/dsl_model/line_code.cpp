// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/line_code.hpp"

#include <array>
#include <bit>
#include <cstddef>

namespace mb4::sim::dsl_model {
namespace {

// The blocks of the code of Widmer and Franaszek with fewer ones, or the one of two balanced forms
// that a positive disparity takes (D.7, D.x.3). a, or f, is the highest bit.
constexpr std::array<std::uint8_t, 32> kSix = {
    0b011000, 0b100010, 0b010010, 0b110001, 0b001010, 0b101001, 0b011001, 0b000111,
    0b000110, 0b100101, 0b010101, 0b110100, 0b001101, 0b101100, 0b011100, 0b101000,
    0b100100, 0b100011, 0b010011, 0b110010, 0b001011, 0b101010, 0b011010, 0b000101,
    0b001100, 0b100110, 0b010110, 0b001001, 0b001110, 0b010001, 0b100001, 0b010100};
constexpr std::array<std::uint8_t, 8> kFour = {0b0100, 0b1001, 0b0101, 0b0011,
                                               0b0010, 0b1010, 0b0110, 0b0001};
constexpr unsigned kK28 = 28;
constexpr std::uint8_t kSixOfK28 = 0b110000;

constexpr int ones(unsigned bits) { return std::popcount(bits); }

constexpr std::uint8_t kNone = 0xFF;

struct Tables {
  std::array<std::uint8_t, 64> six{};
  std::array<std::uint8_t, 16> four{};
  std::array<bool, 1024> data{};     // legal as a data byte
  std::array<bool, 1024> special{};  // legal as a special character
};

// All legal words, from the rules of the code: each block has the disparity that brings the sum
// back, and x.7 has a second form where five equal bits would stand in a row.
constexpr Tables make_tables() {
  Tables t;
  t.six.fill(kNone);
  t.four.fill(kNone);
  for (unsigned x = 0; x < 32; ++x) {
    t.six[kSix[x]] = static_cast<std::uint8_t>(x);
    if (ones(kSix[x]) == 2 || x == 7) t.six[kSix[x] ^ 0x3FU] = static_cast<std::uint8_t>(x);
  }
  t.six[kSixOfK28] = t.six[kSixOfK28 ^ 0x3FU] = kK28;
  for (unsigned y = 0; y < 8; ++y) {
    t.four[kFour[y]] = static_cast<std::uint8_t>(y);
    if (ones(kFour[y]) == 1 || y == 3) t.four[kFour[y] ^ 0xFU] = static_cast<std::uint8_t>(y);
  }
  t.four[0b1000] = t.four[0b0111] = 7;
  for (int start = -1; start <= 1; start += 2) {
    for (unsigned x = 0; x < 32; ++x) {
      unsigned six = kSix[x];
      int after = start;
      if (ones(six) == 2) {
        if (start < 0) six ^= 0x3FU;
        after = -start;
      } else if (x == 7 && start < 0) {
        six ^= 0x3FU;
      }
      for (unsigned y = 0; y < 8; ++y) {
        unsigned four = kFour[y];
        if ((ones(four) == 1 || y == 3) && after < 0) four ^= 0xFU;
        const unsigned last = six & 3U;  // e, i
        const bool second = y == 7 && ((after < 0 && last == 3) || (after > 0 && last == 0));
        if (second) four = after < 0 ? 0b0111 : 0b1000;
        t.data[six << 4U | four] = true;
      }
      // K23.7, K27.7, K29.7, K30.7
      if (x == 23 || x == 27 || x == 29 || x == 30) {
        t.special[six << 4U | (after < 0 ? 0b0111U : 0b1000U)] = true;
      }
    }
    // K28.y: the balanced blocks of four are inverted with their six.
    const unsigned six = start < 0 ? kSixOfK28 ^ 0x3FU : unsigned{kSixOfK28};
    for (const unsigned four : {0b0100, 0b1001, 0b0101, 0b0011, 0b0010, 0b1010, 0b0110, 0b1000}) {
      t.special[six << 4U | (start < 0 ? four : four ^ 0xFU)] = true;
    }
  }
  return t;
}

constexpr Tables kTables = make_tables();

// c = d = e = i, or e and i differ and i = g = h = j.
constexpr bool looks_special(unsigned line) {
  const unsigned cdei = line >> 4U & 0xFU;
  if (cdei == 0 || cdei == 0xF) return true;
  const unsigned ei = line >> 4U & 3U;
  const unsigned ghj = line & 7U;
  return (ei == 1 && ghj == 7) || (ei == 2 && ghj == 0);
}

// a = b = c = d, or e = i = f = g = h.
constexpr bool too_many_equal(unsigned line) {
  const unsigned abcd = line >> 6U;
  const unsigned eifgh = line >> 1U & 0x1FU;
  return abcd == 0 || abcd == 0xF || eifgh == 0 || eifgh == 0x1F;
}

}  // namespace

unsigned encode_parameter(unsigned byte, int& disparity) {
  const unsigned x = byte & 0x1FU;
  unsigned six = x == kK28 ? kSixOfK28 : kSix[x];
  if (const int d = 2 * ones(six) - 6; d != 0) {
    const bool turn = disparity < 0;
    if (turn) six ^= 0x3FU;
    disparity += turn ? -d : d;
  }
  unsigned four = kFour[byte >> 5U & 7U];
  if (ones(four) == 1 && disparity < 0) four ^= 0xFU;
  return six << 4U | four;
}

Word decode(unsigned line, CodeCheck check, Channel channel) {
  line &= 0x3FFU;
  const bool strict = check == CodeCheck::kStrict;
  const bool second = channel == Channel::kSecond;
  Word word;
  const std::uint8_t x = kTables.six[line >> 4U];
  std::uint8_t y = kTables.four[line & 0xFU];
  const bool mend = second || (strict && channel == Channel::kPlain);
  if (mend && line >> 4U == kSixOfK28 && (y == 1 || y == 2 || y == 5 || y == 6)) y ^= 7U;
  word.byte = x == kNone || y == kNone ? 0xFF : static_cast<std::uint8_t>(y << 5U | x);
  const bool published_error = too_many_equal(line);
  if (strict) {
    word.special = kTables.special[line];
    word.error = !word.special && !kTables.data[line];
    word.only_strict = word.error && !published_error;
  } else {
    word.special = looks_special(line) && (!second || kTables.special[line]);
    word.error = published_error;
  }
  return word;
}

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0;
  for (const std::uint8_t byte : bytes) {
    crc ^= unsigned{byte} << 8U;
    for (unsigned i = 0; i < 8; ++i) crc = crc << 1U ^ ((crc & 0x8000U) != 0 ? 0x90D9U : 0U);
    crc &= 0xFFFFU;
  }
  return static_cast<std::uint16_t>(crc ^ 0xFFU);
}

unsigned crc5(unsigned bits) {
  unsigned crc = 0;
  for (unsigned i = 11; i-- > 0;) {
    const bool out = ((crc >> 4U ^ bits >> i) & 1U) != 0;
    crc = (crc << 1U ^ (out ? 0x05U : 0U)) & 0x1FU;
  }
  return crc ^ 0x1FU;
}

std::uint16_t acceleration_word(int acceleration) {
  const unsigned bits = static_cast<unsigned>(acceleration) & 0x7FFU;
  return static_cast<std::uint16_t>(bits << 5U | crc5(bits));
}

bool acceleration_is_good(std::uint16_t word) { return crc5(word >> 5U) == (word & 0x1FU); }

int acceleration_of(std::uint16_t word) {
  const int bits = word >> 5U;
  return bits >= 1024 ? bits - 2048 : bits;
}

}  // namespace mb4::sim::dsl_model
