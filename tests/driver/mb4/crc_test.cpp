// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// CRC calculation and polynomial encoding. Golden values: the CRC/line table of the project's
// protocol facts, which agrees with the BiSS C check word of TI TIDEP0022.

#include "mb4/crc.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "mb4_cyclic.h"

namespace {
namespace crc_test {

struct Golden {
  std::uint32_t polynomial;
  std::uint16_t start0;
  std::uint16_t start1;
  std::uint16_t start_ffff;
  std::uint16_t short_word;
};

constexpr Golden kGolden[] = {
    {0xB, 0x5, 0x4, 0x2, 0x6},
    {0x13, 0x9, 0x4, 0xE, 0xD},
    {0x25, 0x10, 0x06, 0x1E, 0x0C},
    {0x43, 0x18, 0x04, 0x31, 0x27},
    {0x89, 0x21, 0x12, 0x20, 0x1F},
    {0x12F, 0x0C, 0xEC, 0x7E, 0xA4},
    {0x190D9, 0x13F8, 0x2264, 0x07A8, 0x1DD3},
};

TEST(Crc, GoldenWords_GiveGoldenCrc) {
  constexpr std::uint64_t kWord = 0b1010101011110011011110111111;
  for (const Golden& golden : kGolden) {
    EXPECT_EQ(mb4::crc(golden.polynomial, 0, kWord, 28), golden.start0) << golden.polynomial;
    EXPECT_EQ(mb4::crc(golden.polynomial, 1, kWord, 28), golden.start1) << golden.polynomial;
    EXPECT_EQ(mb4::crc(golden.polynomial, 0xFFFF, kWord, 28), golden.start_ffff)
        << golden.polynomial;
    EXPECT_EQ(mb4::crc(golden.polynomial, 0, 0x15A5A5, 21), golden.short_word) << golden.polynomial;
  }
}

TEST(Crc, Word101_GivesTheCheckWordOfTheGuide) {
  EXPECT_EQ(mb4::crc(0x43, 0, 0b101, 3), 0b001111);
  EXPECT_EQ(mb4::crc(0x43, 0, 0b101, 40), 0b001111);  // leading zeros change nothing
}

TEST(Crc, NoPolynomial_IsZero) {
  EXPECT_EQ(mb4::crc(0, 0, 0x1234, 16), 0);
  EXPECT_EQ(mb4::crc(1, 0, 0x1234, 16), 0);
  EXPECT_EQ(mb4::crc(0x20001, 0, 0x1234, 16), 0);  // degree 17
}

TEST(Crc, NoData_IsTheStartValue) { EXPECT_EQ(mb4::crc(0x43, 0x2A, 0, 0), 0x2A); }

// mb4_cyclic.h, with and without a table of four bits a step: golden words, then every length.
TEST(CyclicCrc, Table_GivesTheSameCrc) {
  constexpr std::uint8_t kTable = MB4_WITH_ALL | MB4_WITH_TABLE;
  constexpr std::uint64_t kData = 0xA5C3'0F96'71E8'2D4B;
  for (const Golden& golden : kGolden) {
    mb4_slave_config config{true, 28, MB4_FLAGS_NONE, 0, golden.polynomial, false, false, false};
    std::array<std::uint32_t, 16> table{};
    mb4_word word{};
    mb4_word_set(&word, 1, &config, MB4_SPI_CHECK_CRC);
    EXPECT_EQ(mb4_word_crc(&word, 0xAAF37BF, 0, kTable), golden.start0);  // there is none yet
    mb4_crc_table(&word, table.data());
    EXPECT_EQ(mb4_word_crc(&word, 0xAAF37BF, 0, kTable), golden.start0);
    config.data_bits = 21;
    mb4_word_set(&word, 1, &config, MB4_SPI_CHECK_CRC);
    mb4_crc_table(&word, table.data());
    EXPECT_EQ(mb4_word_crc(&word, 0x15A5A5, 0, kTable), golden.short_word);
    // The CRC takes the top byte, or two, of eight (page 26).
    for (config.data_bits = 1; config.data_bits <= (golden.polynomial > 0x1FF ? 48 : 56);
         ++config.data_bits) {
      const std::uint64_t data = kData & ((std::uint64_t{1} << config.data_bits) - 1);
      mb4_word_set(&word, 1, &config, MB4_SPI_CHECK_CRC);
      mb4_crc_table(&word, table.data());
      EXPECT_EQ(mb4_word_crc(&word, static_cast<std::uint32_t>(data),
                             static_cast<std::uint32_t>(data >> 32), kTable),
                mb4::crc(golden.polynomial, 0, data, config.data_bits))
          << golden.polynomial << ' ' << unsigned{config.data_bits};
    }
  }
}

// Table 14, page 24: predefined polynomials by length.
TEST(EncodeCrc, PredefinedPolynomial_IsSelectedByLength) {
  const struct {
    std::uint32_t polynomial;
    std::uint8_t code;
    std::uint8_t width_bits;
  } table14[] = {{0xB, 0x03, 3},  {0x13, 0x04, 4},  {0x25, 0x05, 5},    {0x43, 0x06, 6},
                 {0x89, 0x07, 7}, {0x12F, 0x08, 8}, {0x190D9, 0x10, 16}};
  for (const auto& row : table14) {
    const mb4::CrcCode code = mb4::encode_crc(row.polynomial);
    EXPECT_TRUE(code.valid);
    EXPECT_FALSE(code.by_polynomial);
    EXPECT_EQ(code.code, row.code);
    EXPECT_EQ(code.width_bits, row.width_bits);
  }
}

TEST(EncodeCrc, Zero_SwitchesVerificationOff) {
  const mb4::CrcCode code = mb4::encode_crc(0);
  EXPECT_TRUE(code.valid);
  EXPECT_FALSE(code.by_polynomial);
  EXPECT_EQ(code.code, 0);
  EXPECT_EQ(code.width_bits, 0);
}

// Table 15, page 25: every odd polynomial up to 8 bits, without its lowest bit.
TEST(EncodeCrc, OddPolynomialUpToDegree7_IsStoredWithoutLowestBit) {
  for (std::uint32_t polynomial = 3; polynomial <= 0xFF; polynomial += 2) {
    const mb4::CrcCode code = mb4::encode_crc(polynomial);
    EXPECT_TRUE(code.valid) << polynomial;
    if (code.by_polynomial) {
      EXPECT_EQ(code.code, polynomial / 2) << polynomial;
    }
  }
  EXPECT_EQ(mb4::encode_crc(0x97).code, 0x4B);
  EXPECT_EQ(mb4::encode_crc(0x97).width_bits, 7);
}

TEST(EncodeCrc, EverythingElse_IsNotValid) {
  for (std::uint32_t polynomial = 0; polynomial <= 0xFF; polynomial += 2) {
    EXPECT_EQ(mb4::encode_crc(polynomial).valid, polynomial == 0) << polynomial;
  }
  for (const std::uint32_t polynomial : {0x1U, 0x101U, 0x11DU, 0x1FFU, 0x18005U, 0xFFFFFFFFU}) {
    EXPECT_FALSE(mb4::encode_crc(polynomial).valid) << polynomial;
  }
}

}  // namespace crc_test
}  // namespace
