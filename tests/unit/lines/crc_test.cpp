// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/crc.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace mb4test {

using namespace mb4::sim;

namespace {

// The word of the table in docs/theory.md, CRC: 26-bit position 0x2ABCDEF, both flags 1.
constexpr std::uint64_t kData28 = 0b1010101011110011011110111111;

struct Golden {
  std::uint32_t polynomial;
  std::uint32_t start;
  std::uint32_t crc;
  std::uint32_t line;
};

// Names the case in the test list.
void PrintTo(const Golden& golden, std::ostream* out) {
  *out << "polynomial " << golden.polynomial << " start " << golden.start;
}

class CrcGolden : public testing::TestWithParam<Golden> {};

TEST_P(CrcGolden, DocumentedData_GivesDocumentedCrcAndLineValue) {
  const Golden& golden = GetParam();
  const Crc crc{golden.polynomial, golden.start};
  EXPECT_EQ(crc.compute(kData28, 28), golden.crc);
  EXPECT_EQ(crc.line_bits(kData28, 28), golden.line);
}

INSTANTIATE_TEST_SUITE_P(Widths, CrcGolden,
                         testing::Values(Golden{0xB, 0, 0x5, 0x2}, Golden{0x13, 0, 0x9, 0x6},
                                         Golden{0x25, 0, 0x10, 0x0F}, Golden{0x43, 0, 0x18, 0x27},
                                         Golden{0x89, 0, 0x21, 0x5E}, Golden{0x12F, 0, 0x0C, 0xF3},
                                         Golden{0x190D9, 0, 0x13F8, 0xEC07},
                                         Golden{0x43, 1, 0x04, 0x3B},
                                         Golden{0x43, 0xFFFF, 0x31, 0x0E},
                                         Golden{0x190D9, 0xFFFF, 0x07A8, 0xF857}),
                         [](const auto& entry) {
                           return "Polynomial" + std::to_string(entry.param.polynomial) + "Start" +
                                  std::to_string(entry.param.start);
                         });

// TI TIDEP0022, section 6-bit CRC verification: data 101, CRC 001111, line 110000.
TEST(Crc, TiExample_GivesPrintedCrc) {
  const Crc crc{0x43, 0};
  EXPECT_EQ(crc.compute(0b101, 13), 0b001111U);
  EXPECT_EQ(crc.line_bits(0b101, 13), 0b110000U);
}

TEST(Crc, NoPolynomial_HasNoBits) {
  const Crc crc;
  EXPECT_EQ(crc.width(), 0U);
  EXPECT_EQ(crc.line_bits(0x1234, 16), 0U);
}

}  // namespace
}  // namespace mb4test
