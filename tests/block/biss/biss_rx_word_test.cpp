// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A received word alone, bit by bit: page 26, Tables 19 to 22; decisions 11, 28, 29.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>

#include "Vbiss_rx_word.h"
#include "places.hpp"
#include "tests/block/biss/frame_bench.hpp"
#include "tests/block/biss/word.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace at = mb4test::places::biss_pkg;

using mb4test::bits_of;
using mb4test::crc_of;
using mb4test::kPolynomials;
using mb4test::Word;

struct Rx {
  explicit Rx(unsigned port)
      : slave(at::rx_t::kSlave.of(port)),
        wr_en(at::rx_t::kWrEn.of(port) != 0),
        wr_byte(at::rx_t::kWrByte.of(port)),
        wr_data(at::rx_t::kWrData.of(port)),
        first(at::rx_t::kFirst.of(port) != 0),
        open(at::rx_t::kOpen.of(port) != 0),
        done(at::rx_t::kDone.of(port) != 0),
        ok(at::rx_t::kOk.of(port) != 0) {}
  std::uint64_t slave;
  bool wr_en;
  std::uint64_t wr_byte, wr_data;
  bool first, open, done, ok;
};

TEST(RxWordBlock, RandomWords_BytesFlagsAndCrcAreThoseOfTheLine) {
  mb4test::Dice random;
  mb4test::Block<Vbiss_rx_word> block;
  auto& m = block.model;
  m.offer_i = 0;
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
    const unsigned slave = random.below(8);
    m.offer_i = at::offer_t::kSlave(slave) | at::offer_t::kWord(word.port());
    m.run_i = m.load_i = 1;
    block.clock();
    m.load_i = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      for (unsigned gap = random.below(3); gap > 0; --gap) {
        m.eval();
        ASSERT_EQ(m.next_o, 0);
        ASSERT_EQ(Rx(m.rx_o).open, i != 0 && !word.actuator);
        ASSERT_FALSE(Rx(m.rx_o).done || Rx(m.rx_o).first || Rx(m.rx_o).wr_en);
        block.clock();
      }
      const bool last = i + 1 == line.size();
      m.bit_valid_i = 1;
      m.bit_i = line[i] == '1';
      m.eval();
      const Rx rx(m.rx_o);
      ASSERT_EQ(m.next_o, last);
      ASSERT_EQ(rx.first, i == 0 && !word.actuator);
      ASSERT_EQ(rx.done, last && !word.actuator);
      ASSERT_EQ(rx.open, !last && !word.actuator);
      if (rx.done) {
        ASSERT_EQ(rx.ok, !spoiled);
      }
      if (rx.wr_en) {
        ASSERT_EQ(rx.slave, slave);
        ASSERT_TRUE(seen.emplace(rx.wr_byte, rx.wr_data).second) << "written twice";
      }
      block.clock();
      m.bit_valid_i = 0;
    }
    ASSERT_EQ(seen, expected);
  }
}

}  // namespace
