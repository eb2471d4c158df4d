// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Length and inputs of the CRC from a polynomial: pages 24, 25, Tables 14, 15.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "Vmb4_crc_decode.h"
#include "tests/support/model_context.hpp"

namespace {

// Codes without the last 1 of the polynomial: degree 1 to 7 of Table 15, and 8 of Table 14.
TEST(CrcDecodeBlock, EveryPolynomialOfDegree1To8_LengthAndTaps) {
  mb4test::Block<Vmb4_crc_decode> block;
  auto& m = block.model;
  for (unsigned code = 1; code < 0xC0; ++code) {
    const unsigned polynomial = 2 * code + 1;
    const unsigned degree = static_cast<unsigned>(std::bit_width(polynomial)) - 1;
    m.poly_i = static_cast<std::uint8_t>(code);
    m.eval();
    EXPECT_EQ(m.crc_on_o, 1) << code;
    EXPECT_EQ(m.crc_last_o, degree - 1) << code;
    EXPECT_EQ(m.crc_poly_o & ((1U << degree) - 1), polynomial & ((1U << degree) - 1)) << code;
  }
}

TEST(CrcDecodeBlock, Degree16_SixteenBitsOf190D9) {
  mb4test::Block<Vmb4_crc_decode> block;
  block.model.poly_i = 0xEC;
  block.model.eval();
  EXPECT_EQ(block.model.crc_on_o, 1);
  EXPECT_EQ(block.model.crc_last_o, 15);
  EXPECT_EQ(block.model.crc_poly_o, 0xD9);
}

TEST(CrcDecodeBlock, NoPolynomial_CrcIsOff) {
  mb4test::Block<Vmb4_crc_decode> block;
  block.model.poly_i = 0;
  block.model.eval();
  EXPECT_EQ(block.model.crc_on_o, 0);
  EXPECT_EQ(block.model.crc_last_o, 0);
}

}  // namespace
