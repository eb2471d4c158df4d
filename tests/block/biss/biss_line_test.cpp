// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS C frame on one line: datasheet pages 12, 15, 26, 30; protocol edge table.
#include <gtest/gtest.h>

#include <tuple>

#include "tests/block/biss/frame_bench.hpp"

namespace {

using mb4test::bits_of;
using mb4test::crc_of;
using mb4test::FrameBench;
using mb4test::line_word;
using mb4test::Slave;

constexpr std::uint64_t kSub = FrameBench::kSub;

// Table 35: MA period in clocks. Code 0x10 is not permitted.
unsigned period_clocks(unsigned code) {
  if (code <= 0x0F) return 2 * (code + 1);
  if (code == 0x11) return 40;
  return 20 * (code - 15);
}

Slave slave_with(const std::string& words, unsigned code, unsigned busy = 0, bool cds = false) {
  Slave slave;
  slave.payload = (cds ? "1" : "0") + words;
  slave.busy = busy;
  slave.timeout = period_clocks(code) * kSub * 3 / 2;  // adaptive: 1.5 periods
  return slave;
}

class FrameAtEveryFreqs : public testing::TestWithParam<unsigned> {};

// Item I301..I303: period by FREQS, 50 % duty; N + 5 rising edges; CDM 0 keeps MA high.
TEST_P(FrameAtEveryFreqs, ThirtyFourBits_PeriodDutyEdgesAndWordAreRight) {
  const unsigned code = GetParam();
  const std::uint64_t half = period_clocks(code) / 2 * kSub;
  FrameBench bench;
  bench.model->freqs_i = static_cast<std::uint8_t>(code);
  bench.configure(0, 28, 0x06);
  Slave slave = slave_with(line_word(0xAAF37BF, 28, 0x43), code);
  const auto result = bench.run(slave, 0);
  ASSERT_TRUE(result.ended);
  ASSERT_TRUE(result.idle);
  ASSERT_EQ(result.rises.size(), 34U + 5U);
  ASSERT_EQ(result.falls.size(), 34U + 5U);
  for (std::size_t i = 0; i < result.rises.size(); ++i) {
    EXPECT_EQ(result.rises[i] - result.falls[i], half) << "low phase " << i;
    if (i > 0) {
      EXPECT_EQ(result.falls[i] - result.rises[i - 1], half) << "high phase " << i;
    }
  }
  EXPECT_EQ(result.good, 1U);
  EXPECT_EQ(result.memory[0][0], 0xBF);
  EXPECT_EQ(result.memory[0][1], 0x37);
  EXPECT_EQ(result.memory[0][2], 0xAF);
  EXPECT_EQ(result.memory[0][3], 0x0A);
  EXPECT_FALSE(result.written[0][4]);
  EXPECT_EQ(result.memory[0][7], 0x18);  // docs/theory.md, CRC: this word has 0x18
  EXPECT_EQ(slave.cdm_level, 1);         // CDM is sent inverted
}

// The CDM level stays on MA through the timeout and returns to 1 after it (HOLDCDM = 0).
TEST_P(FrameAtEveryFreqs, CdmOne_MaIsLowUntilTimeoutEnds) {
  const unsigned code = GetParam();
  FrameBench bench;
  bench.model->freqs_i = static_cast<std::uint8_t>(code);
  bench.model->cdm_i = 1;
  bench.configure(0, 8, 0x00);
  Slave slave = slave_with(bits_of(0x5A, 8), code);
  const auto result = bench.run(slave, 0);
  ASSERT_TRUE(result.idle);
  EXPECT_EQ(slave.cdm_level, 0);
  EXPECT_EQ(result.ma_in_timeout, 0);
  // 13 rising edges in the frame and the one by which MA returns to idle.
  ASSERT_EQ(result.rises.size(), 8U + 5U + 1U);
  EXPECT_GE(result.rises.back() - result.falls.back(), slave.timeout);
  EXPECT_EQ(bench.model->ma_o, 1);
}

INSTANTIATE_TEST_SUITE_P(Table35, FrameAtEveryFreqs,
                         testing::Values(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 17,
                                         18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31));

class FrameLength : public testing::TestWithParam<unsigned> {};

// Tables 12, 20: 1..64 bits, LSB at bit 0 of byte 0, unused bits of written bytes zero.
TEST_P(FrameLength, Word_BytesAndEdgesAreRight) {
  const unsigned bits = GetParam();
  const std::uint64_t mask = bits == 64 ? ~0ULL : (1ULL << bits) - 1;
  const std::uint64_t data = 0xD1B54A32D192ED03ULL & mask;
  for (const unsigned code : {0U, 1U, 2U, 5U}) {
    FrameBench bench;
    bench.model->freqs_i = static_cast<std::uint8_t>(code);
    bench.configure(0, bits, 0x06);
    Slave slave = slave_with(line_word(data, bits, 0x43), code);
    const auto result = bench.run(slave, 0);
    ASSERT_TRUE(result.ended && result.idle);
    EXPECT_EQ(result.rises.size(), bits + 6 + 5);
    EXPECT_EQ(result.good, 1U);
    for (unsigned byte = 0; byte < 8; ++byte) {
      const bool data_byte = byte < (bits + 7) / 8;
      const bool crc_byte = byte == 7 && bits <= 56;
      ASSERT_EQ(result.written[0][byte], data_byte || crc_byte) << byte;
      if (crc_byte) {
        EXPECT_EQ(result.memory[0][7], crc_of(bits_of(data, bits), 0x43));
      } else if (data_byte) {
        EXPECT_EQ(result.memory[0][byte], (data >> (8 * byte)) & 0xFF) << byte;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table12, FrameLength, testing::Range(1U, 65U));

struct CrcCase {
  unsigned byte;  // 0xC1: SELCRCS, SCRCLEN or SCRCPOLY
  std::uint32_t polynomial;
};
class FrameCrc : public testing::TestWithParam<CrcCase> {};

// Tables 13..16: predefined and own polynomials, start value; a wrong bit anywhere is found.
TEST_P(FrameCrc, EveryFlippedBit_IsFound) {
  const auto [byte, polynomial] = GetParam();
  for (const std::uint32_t start : {0x0000U, 0x0001U, 0xFFFFU, 0x5A3CU}) {
    const std::string good = line_word(0x15A5A5, 21, polynomial, start);
    for (std::size_t flip = 0; flip <= good.size(); ++flip) {
      std::string word = good;
      if (flip < good.size()) word[flip] = word[flip] == '1' ? '0' : '1';
      FrameBench bench;
      bench.configure(0, 21, byte, start);
      Slave slave = slave_with(word, 0);
      const auto result = bench.run(slave, 0);
      ASSERT_TRUE(result.ended);
      ASSERT_EQ(result.rises.size(), good.size() + 5);
      const bool sound = flip == good.size();
      EXPECT_EQ(result.good, sound ? 1U : 0U) << "flipped " << flip << " start " << start;
      if (sound && polynomial == 0x190D9) {
        // Page 26: a 16-bit CRC fills bytes 6 (low) and 7 (high).
        const std::uint32_t crc = crc_of(good.substr(0, 21), polynomial, start);
        EXPECT_EQ(result.memory[0][6], crc & 0xFF);
        EXPECT_EQ(result.memory[0][7], crc >> 8);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table14And15, FrameCrc,
                         testing::Values(CrcCase{0x03, 0xB}, CrcCase{0x04, 0x13},
                                         CrcCase{0x05, 0x25}, CrcCase{0x06, 0x43},
                                         CrcCase{0x07, 0x89}, CrcCase{0x08, 0x12F},
                                         CrcCase{0x10, 0x190D9}, CrcCase{0x80 | 0x21, 0x43},
                                         CrcCase{0x80 | 0x4B, 0x97}, CrcCase{0x80 | 0x05, 0xB},
                                         CrcCase{0x80 | 0x09, 0x13}));

// Table 14, 15: SCRCLEN = 0 and SCRCPOLY = 0 switch the check off; codes not permitted as well.
TEST(FrameCrcOff, AnyBits_AreTakenAndNothingIsStored) {
  for (const unsigned byte : {0x00U, 0x80U, 0x01U, 0x09U, 0x7FU}) {
    FrameBench bench;
    bench.configure(0, 13, byte);
    Slave slave = slave_with(bits_of(0x0E08, 13), 0);
    const auto result = bench.run(slave, 0);
    ASSERT_TRUE(result.ended);
    EXPECT_EQ(result.rises.size(), 13U + 5U);
    EXPECT_EQ(result.good, 1U);
    EXPECT_EQ(result.memory[0][0], 0x08);
    EXPECT_EQ(result.memory[0][1], 0x0E);
    EXPECT_FALSE(result.written[0][7]);
  }
}

// I304: line delay from 0 upward; the delay is measured anew in every frame. Rising edges stay at
// N + 5 + b while the delay is shorter than the frame.
TEST(FrameDelay, DelayShorterThanFrame_WordAndEdgesAreRight) {
  for (const unsigned code : {0U, 1U, 2U, 3U, 7U}) {
    const std::uint64_t period = period_clocks(code) * kSub;
    FrameBench bench;
    bench.model->freqs_i = static_cast<std::uint8_t>(code);
    bench.configure(0, 28, 0x06);
    for (std::uint64_t delay = 0; delay < 32 * period; delay += period / 7 + 1) {
      Slave slave = slave_with(line_word(0xAAF37BF, 28, 0x43), code);
      slave.timeout += 2 * period;
      const auto result = bench.run(slave, delay);
      ASSERT_TRUE(result.idle);
      EXPECT_EQ(result.good, 1U) << "delay " << delay << " code " << code;
      EXPECT_EQ(result.rises.size(), 34U + 5U) << "delay " << delay << " code " << code;
      EXPECT_EQ(result.memory[0][0], 0xBF);
    }
  }
}

// Decision 17: a longer line gets as many edges as were sent when the start bit came back (one more
// if MA was low then and has to end high), and sampling goes on after MA has stopped.
TEST(FrameDelay, DelayLongerThanFrame_WordIsRightAndMaStops) {
  FrameBench bench;
  bench.configure(0, 28, 0x06);
  for (const unsigned periods : {50U, 100U, 1000U}) {
    for (const unsigned cdm : {0U, 1U}) {
      bench.model->cdm_i = static_cast<std::uint8_t>(cdm);
      Slave slave = slave_with(line_word(0xAAF37BF, 28, 0x43), 0);
      const auto result = bench.run(slave, periods * 2 * kSub);
      ASSERT_TRUE(result.idle) << periods;
      EXPECT_EQ(result.good, 1U) << periods;
      EXPECT_GE(result.rises.size(), periods + 3U);
      EXPECT_LE(result.rises.size(), periods + 3U + 4U);
      EXPECT_EQ(slave.cdm_level, cdm == 0 ? 1 : 0);
    }
  }
}

// Start bit delayed by processing time: b more edges.
TEST(FrameBusy, ProcessingClocks_AddAsManyEdges) {
  FrameBench bench;
  bench.configure(0, 26, 0x06);
  for (const unsigned busy : {0U, 1U, 2U, 3U, 10U, 400U}) {
    for (const std::uint64_t delay : {std::uint64_t{0}, 3 * kSub, 11 * kSub}) {
      Slave slave = slave_with(line_word(0x2ABCDEF, 26, 0x43), 0, busy);
      const auto result = bench.run(slave, delay);
      ASSERT_TRUE(result.idle);
      EXPECT_EQ(result.good, 1U);
      EXPECT_EQ(result.rises.size(), 32U + 5U + busy);
    }
  }
}

// Page 15: the CDS bit follows the start bit.
TEST(FrameCds, SlaveSendsOne_CdsIsOne) {
  FrameBench bench;
  bench.configure(0, 4, 0x00);
  for (const bool cds : {true, false, true}) {
    Slave slave = slave_with("1010", 0, 0, cds);
    EXPECT_EQ(bench.run(slave, 0).cds, cds);
  }
}

// Decision 30: no data channel enabled: acknowledge, start, CDS and nothing more.
TEST(FrameEmpty, NoWord_FiveEdges) {
  FrameBench bench;
  Slave slave = slave_with("", 0, 0, true);
  const auto result = bench.run(slave, 0);
  ASSERT_TRUE(result.ended && result.idle);
  EXPECT_EQ(result.rises.size(), 5U);
  EXPECT_TRUE(result.cds);
  EXPECT_EQ(result.words, 0U);
}

// Page 26, Table 22: three slaves of 19+2, 12+2 and 24 bits with CRC 6, 5 and 16.
TEST(FrameChain, DatasheetExampleOfThreeSlaves_BytesAreWhereTable22ShowsThem) {
  FrameBench bench;
  bench.configure(0, 21, 0x06);
  bench.configure(1, 14, 0x05);
  bench.configure(2, 24, 0x10);
  const std::string bits1 = bits_of(0x15A5A5, 21);
  const std::string bits2 = bits_of(0x2B3C, 14);
  const std::string bits3 = bits_of(0xC0FFEE, 24);
  Slave slave = slave_with(line_word(0x15A5A5, 21, 0x43) + line_word(0x2B3C, 14, 0x25) +
                               line_word(0xC0FFEE, 24, 0x190D9),
                           0);
  const auto result = bench.run(slave, 5 * kSub);
  ASSERT_TRUE(result.idle);
  EXPECT_EQ(result.rises.size(), 27U + 19U + 40U + 5U);
  EXPECT_EQ(result.good, 3U);
  EXPECT_EQ(result.memory[0][0], 0xA5);
  EXPECT_EQ(result.memory[0][1], 0xA5);
  EXPECT_EQ(result.memory[0][2], 0x15);
  EXPECT_FALSE(result.written[0][3] || result.written[0][4] || result.written[0][5] ||
               result.written[0][6]);
  EXPECT_EQ(result.memory[0][7], crc_of(bits1, 0x43));
  EXPECT_EQ(result.memory[1][0], 0x3C);
  EXPECT_EQ(result.memory[1][1], 0x2B);
  EXPECT_FALSE(result.written[1][2] || result.written[1][6]);
  EXPECT_EQ(result.memory[1][7], crc_of(bits2, 0x25));
  EXPECT_EQ(result.memory[2][0], 0xEE);
  EXPECT_EQ(result.memory[2][1], 0xFF);
  EXPECT_EQ(result.memory[2][2], 0xC0);
  EXPECT_FALSE(result.written[2][3] || result.written[2][4] || result.written[2][5]);
  EXPECT_EQ(result.memory[2][6], crc_of(bits3, 0x190D9) & 0xFF);
  EXPECT_EQ(result.memory[2][7], crc_of(bits3, 0x190D9) >> 8);
  EXPECT_FALSE(result.written[3][0]);
}

// Page 26: a 16-bit CRC needs bytes 6 and 7; data that reach into byte 6 keep it out of the memory.
TEST(FrameCrc16, StoredOnlyWhereBothBytesAreFree) {
  for (unsigned bits = 40; bits <= 64; ++bits) {
    const std::uint64_t mask = bits == 64 ? ~0ULL : (1ULL << bits) - 1;
    const std::uint64_t data = 0xA5C396F0E1D2B487ULL & mask;
    FrameBench bench;
    bench.configure(0, bits, 0x10);
    Slave slave = slave_with(line_word(data, bits, 0x190D9), 0);
    const auto result = bench.run(slave, 0);
    ASSERT_EQ(result.good, 1U);
    for (unsigned byte = 0; byte < 8; ++byte) {
      const bool data_byte = byte < (bits + 7) / 8;
      const bool crc_byte = byte >= 6 && bits <= 48;
      ASSERT_EQ(result.written[0][byte], data_byte || crc_byte) << bits << " byte " << byte;
      if (data_byte) {
        EXPECT_EQ(result.memory[0][byte], (data >> (8 * byte)) & 0xFF) << bits << " byte " << byte;
      }
    }
    if (bits <= 48) {
      const std::uint32_t crc = crc_of(bits_of(data, bits), 0x190D9);
      EXPECT_EQ(result.memory[0][6], crc & 0xFF);
      EXPECT_EQ(result.memory[0][7], crc >> 8);
    }
  }
}

// Table 21: NOCRC keeps the CRC out of the memory but still checks it.
TEST(FrameNoCrc, StorageIsOff_CheckIsOn) {
  FrameBench bench;
  bench.model->nocrc_i = 1;
  bench.configure(0, 28, 0x06);
  Slave good = slave_with(line_word(0xAAF37BF, 28, 0x43), 0);
  auto result = bench.run(good, 0);
  EXPECT_EQ(result.good, 1U);
  EXPECT_FALSE(result.written[0][7]);
  std::string wrong = line_word(0xAAF37BF, 28, 0x43);
  wrong[3] = wrong[3] == '1' ? '0' : '1';
  Slave bad = slave_with(wrong, 0);
  EXPECT_EQ(bench.run(bad, 0).good, 0U);
}

// Decision 4: no answer, no limit; BREAK (abort) ends it and MA returns to 1 without a short pulse.
TEST(FrameAbort, SilentSlave_MaReturnsHighAfterAFullHalfPeriod) {
  for (const unsigned code : {0U, 1U, 3U, 31U}) {
    const std::uint64_t half = period_clocks(code) / 2 * kSub;
    for (unsigned phase = 0; phase < 2 * period_clocks(code);
         phase += 1 + period_clocks(code) / 9) {
      FrameBench bench;
      bench.model->freqs_i = static_cast<std::uint8_t>(code);
      bench.configure(0, 8, 0x00);
      Slave silent;
      silent.timeout = ~0ULL;
      silent.busy = 1000000;
      bench.model->start_i = 1;
      bench.clocks(1);
      bench.model->start_i = 0;
      std::uint64_t last = bench.now();
      int level = 1;
      const std::uint64_t stop = 20 * period_clocks(code) + phase;
      for (std::uint64_t i = 0; i < stop + 2 * period_clocks(code); ++i) {
        bench.model->abort_i = i == stop ? 1 : 0;
        bench.clocks(1);
        if (bench.model->ma_o != level) {
          level = bench.model->ma_o;
          EXPECT_GE(bench.now() - last, half);
          last = bench.now();
        }
      }
      EXPECT_EQ(bench.model->ma_o, 1);
      EXPECT_EQ(bench.model->idle_o, 1);
    }
  }
}

// BREAK + INSTR in one byte: the next frame begins while the list of words of the old one is still
// being summed up. It has the edges of its own words only: 5 and their bits (page 14).
TEST(FrameAbort, WithinTheListOfWords_NextFrameHasItsOwnEdges) {
  std::string payload;
  for (unsigned slave = 0; slave < 8; ++slave) payload += line_word(0xA0U + slave, 8, 0x43);
  for (unsigned clocks = 1; clocks <= 16; ++clocks) {
    FrameBench bench;
    for (unsigned slave = 0; slave < 8; ++slave) bench.configure(slave, 8, 0x06);
    bench.model->start_i = 1;
    bench.clocks(1);
    bench.model->start_i = 0;
    bench.clocks(clocks - 1);
    bench.model->abort_i = 1;
    bench.clocks(1);
    bench.model->abort_i = 0;
    while (bench.model->idle_o == 0) bench.clocks(1);
    // The slave takes no notice of the frame that was cut short.
    Slave slave = slave_with(payload, 0);
    const auto result = bench.run(slave, 0);
    EXPECT_EQ(result.rises.size(), 5U + 8U * 14U) << clocks;
    EXPECT_EQ(result.good, 8U) << clocks;
  }
}

}  // namespace
