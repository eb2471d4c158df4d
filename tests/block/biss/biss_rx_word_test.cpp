// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A received word alone, bit by bit: page 26, Tables 19 to 22; decisions 11, 28, 29.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <string>

#include "Vbiss_rx_word.h"
#include "tests/block/biss/frame_bench.hpp"
#include "tests/support/model_context.hpp"

namespace {

using mb4test::bits_of;
using mb4test::crc_of;

// The polynomials of Table 14; 0: no CRC.
constexpr std::uint32_t kPolynomials[] = {0, 0xB, 0x13, 0x25, 0x43, 0x89, 0x12F, 0x190D9};

struct Word {
  unsigned data_bits = 0;
  std::uint32_t polynomial = 0;
  std::uint16_t start = 0;
  bool store = false, gray = false, actuator = false, stop = false;

  unsigned crc_bits() const {
    return polynomial == 0 ? 0 : static_cast<unsigned>(std::bit_width(polynomial)) - 1;
  }
  // The fields of biss_pkg::word_t, the highest first.
  std::uint64_t port() const {
    const unsigned crc = crc_bits();
    std::uint64_t value = data_bits - 1;
    const auto add = [&](std::uint64_t field, unsigned bits) { value = value << bits | field; };
    add(crc != 0, 1);
    add(crc == 0 ? 0 : crc - 1, 4);
    add(polynomial & 0xFF, 8);
    add(crc == 0 || crc == 16 ? 0 : 1U << (crc - 1), 8);
    add(start, 16);
    add(store, 1);
    add(gray, 1);
    add(actuator, 1);
    add(stop, 1);
    return value;
  }
};

TEST(RxWordBlock, RandomWords_BytesFlagsAndCrcAreThoseOfTheLine) {
  mb4test::Dice random;
  mb4test::Block<Vbiss_rx_word> block;
  auto& m = block.model;
  m.word_i = 0;
  m.run_i = m.load_i = m.bit_valid_i = m.bit_i = 0;
  block.reset();
  for (int round = 0; round < 4'000; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    Word word;
    word.data_bits = 1 + random.below(64);
    word.polynomial = kPolynomials[random.below(8)];
    word.start = static_cast<std::uint16_t>(random.below(65536));
    // Page 26: the CRC stands in the top byte(s), if the data leave room.
    const unsigned crc_bytes = word.crc_bits() == 16 ? 2 : 1;
    word.store = word.polynomial != 0 && word.data_bits <= 64 - 8 * crc_bytes;
    word.gray = random.below(4) == 0;
    word.actuator = random.below(6) == 0;
    word.stop = word.actuator && random.below(2) != 0;
    const bool spoiled = word.polynomial != 0 && random.below(3) == 0;

    const std::uint64_t mask = ~std::uint64_t{0} >> (64 - word.data_bits);
    std::uint64_t data = 0;
    for (unsigned i = 0; i < 4; ++i) data = data << 16 | random.below(65536);
    data &= mask;
    const std::string sent = bits_of(word.gray ? data ^ data >> 1 : data, word.data_bits);
    std::uint32_t crc = word.polynomial == 0 ? 0 : crc_of(sent, word.polynomial, word.start);
    if (spoiled) crc ^= 1U << random.below(word.crc_bits());
    const std::uint32_t ones = (1U << word.crc_bits()) - 1;
    const std::string line = (word.stop ? "0" : "") + sent + bits_of(~crc & ones, word.crc_bits());

    std::map<unsigned, unsigned> expected, seen;
    if (!word.actuator) {
      for (unsigned i = 0; 8 * i < word.data_bits; ++i) expected[i] = data >> (8 * i) & 0xFF;
      if (word.store) {
        expected[7] = crc_bytes == 2 ? crc >> 8 : crc;
        if (crc_bytes == 2) expected[6] = crc & 0xFF;
      }
    }
    m.word_i = word.port();
    m.run_i = m.load_i = 1;
    block.clock();
    m.load_i = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      for (unsigned gap = random.below(3); gap > 0; --gap) {
        m.eval();
        ASSERT_EQ(m.open_o, i != 0);
        ASSERT_EQ(m.done_o | m.begin_o | m.wr_en_o, 0);
        block.clock();
      }
      const bool last = i + 1 == line.size();
      m.bit_valid_i = 1;
      m.bit_i = line[i] == '1';
      m.eval();
      ASSERT_EQ(m.begin_o, i == 0);
      ASSERT_EQ(m.done_o, last);
      ASSERT_EQ(m.open_o, !last);
      if (last) {
        ASSERT_EQ(m.ok_o, !spoiled || word.actuator);
      }
      if (m.wr_en_o != 0) {
        ASSERT_TRUE(seen.emplace(m.wr_byte_o, m.wr_data_o).second) << "written twice";
      }
      block.clock();
      m.bit_valid_i = 0;
    }
    ASSERT_EQ(seen, expected);
  }
}

}  // namespace
