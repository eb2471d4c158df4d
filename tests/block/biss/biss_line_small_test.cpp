// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A line made small by its parameters: BiSS C only, one word of up to 32 bits, CRC 0x43 or 16 bits,
// no MO, six bits of line delay. Decision 44 says what is left out; docs/theory.md, CRC.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "Vframe_small.h"
#include "tests/block/biss/frame_bench.hpp"

namespace {

using mb4test::bits_of;
using mb4test::crc_of;
using mb4test::line_word;
using mb4test::Slave;

using Bench = mb4test::FrameBenchOf<Vframe_small>;
constexpr unsigned kPeriod = 2;  // clocks, FREQS = 0

Slave slave_with(const std::string& words, unsigned busy = 0) {
  Slave slave;
  slave.payload = "0" + words;
  slave.busy = busy;
  slave.timeout = kPeriod * Bench::kSub * 3 / 2;
  return slave;
}

// One frame of one word; the bytes 0 to 3 of the word are compared with its data.
Bench::Result read(Bench& bench, std::uint64_t data, unsigned bits, std::uint32_t polynomial,
                   unsigned code, unsigned delay_clocks = 0, unsigned busy = 0) {
  bench.configure(0, bits, code);
  Slave slave = slave_with(line_word(data, bits, polynomial), busy);
  const auto result = bench.run(slave, delay_clocks * Bench::kSub);
  EXPECT_TRUE(result.ended);
  EXPECT_TRUE(result.idle);
  EXPECT_EQ(result.words, 1U);
  for (unsigned i = 0; 8 * i < bits; ++i) {
    EXPECT_EQ(result.memory[0][i], data >> (8 * i) & 0xFF) << "byte " << i;
  }
  return result;
}

// Table 14: code 6 is CRC 0x43, code 0x10 is 0x190D9.
TEST(SmallLine, EveryLengthAndBothCrcs_WordArrivesWithAsManyEdgesAsOnTheFullLine) {
  mb4test::Dice random;
  Bench bench;
  for (unsigned bits = 1; bits <= 32; ++bits) {
    const std::uint64_t mask = ~std::uint64_t{0} >> (64 - bits);
    const std::uint64_t data =
        (std::uint64_t{random.below(65536)} << 16 | random.below(65536)) & mask;
    SCOPED_TRACE(testing::Message() << bits << " bits, data " << data);
    const auto six = read(bench, data, bits, 0x43, 0x06, 0, random.below(8));
    EXPECT_EQ(six.good, 1U);
    const auto sixteen = read(bench, data, bits, 0x190D9, 0x10);
    EXPECT_EQ(sixteen.good, 1U);
    EXPECT_EQ(sixteen.rises.size(), bits + 16U + 5U);
    EXPECT_EQ(read(bench, data, bits, 0, 0x00).good, 1U) << "without a CRC";
  }
}

TEST(SmallLine, WrongCrcBit_WordIsBad) {
  Bench bench;
  bench.configure(0, 28, 0x06);
  std::string word = line_word(0xAAF37BF, 28, 0x43);
  word.back() = word.back() == '1' ? '0' : '1';
  Slave slave = slave_with(word);
  const auto result = bench.run(slave, 0);
  EXPECT_EQ(result.words, 1U);
  EXPECT_EQ(result.good, 0U);
}

// Decision 44: a CRC that is left out is taken with its length, and the word is never good.
TEST(SmallLine, CrcThatIsLeftOut_LengthIsRightAndWordIsBad) {
  Bench bench;
  const auto result = read(bench, 0x5A, 8, 0x25, 0x05);
  EXPECT_EQ(result.good, 0U);
  EXPECT_EQ(result.rises.size(), 8U + 5U + 5U);
  EXPECT_EQ(read(bench, 0x5A, 8, 0x43, 0x06).good, 1U) << "the next frame";
}

// Six bits count up to 63 quarters. The frame works over a longer line too (decision 17).
TEST(SmallLine, LineDelay_StopsAtTheLargestNumber) {
  for (const unsigned delay : {0U, 5U, 30U, 60U}) {
    Bench bench;
    EXPECT_EQ(read(bench, 0x1234567, 28, 0x43, 0x06, delay).good, 1U) << delay;
    // Decision 2: sampling points after rising edge 2; two a clock at the shortest MA period.
    EXPECT_EQ(bench.model->quarters_o, std::clamp(2 * delay, 1U, 63U)) << delay;
  }
}

// Decision 44: an absent protocol acts as UNUSED: a line in its timeout does not wait for SL = 1.
TEST(SmallLine, ProtocolBecomesAnAbsentOne_LineDoesNotWaitForSl) {
  for (const unsigned protocol : {1U, 0U, 2U, 3U}) {
    Bench bench;
    // INIT ends with the acknowledge; then the slaves are in their timeout.
    bench.model->init_i = bench.model->start_i = 1;
    bench.clocks(1);
    bench.model->init_i = bench.model->start_i = 0;
    bench.model->sl_i = 0;
    bench.clocks(200);
    ASSERT_EQ(bench.model->timeout_o, 1);
    bench.model->protocol_i = static_cast<std::uint8_t>(protocol);
    bench.clocks(20);
    EXPECT_EQ(bench.model->idle_o, protocol == 1 ? 0 : 1) << protocol;
  }
}

}  // namespace
