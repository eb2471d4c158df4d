// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The words of M_PAR against the code of the model, at each disparity.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vdsl_code_tx.h"
#include "sim/masters/dsl_model/line_code.hpp"
#include "tests/support/model_context.hpp"

namespace {

using mb4::sim::dsl_model::encode_parameter;

TEST(DslCodeTxBlock, EachByteAtEachDisparity_IsThatOfTheModel) {
  mb4test::Block<Vdsl_code_tx> block;
  auto& m = block.model;
  for (unsigned byte = 0; byte < 256; ++byte) {
    m.data_i = static_cast<std::uint8_t>(byte);
    block.clock();
    for (int start = -126; start < 126; ++start) {
      int disparity = start;
      const unsigned word = encode_parameter(byte, disparity);
      m.disparity_i = static_cast<std::uint8_t>(start);
      m.eval();
      ASSERT_EQ(m.word_o, word) << byte << " at " << start;
      ASSERT_EQ(m.uneven_o, disparity != start) << byte << " at " << start;
    }
  }
}

// The golden words of a free run, as the facts print them.
TEST(DslCodeTxBlock, GoldenWords_AreThePublishedOnes) {
  constexpr struct {
    unsigned byte;
    unsigned word;
  } kWords[] = {{0x1F, 0b0101001011}, {0x19, 0b1001100100}, {0x1A, 0b0101100100},
                {0x1B, 0b0010011011}, {0x1C, 0b1100001011}, {0x1D, 0b0100011011},
                {0x9E, 0b1000011101}, {0x90, 0b1001001101}, {0xD0, 0b1001000110}};
  mb4test::Block<Vdsl_code_tx> block;
  auto& m = block.model;
  for (const auto& [byte, word] : kWords) {
    m.data_i = static_cast<std::uint8_t>(byte);
    block.clock();
    for (const unsigned disparity : {0U, 1U}) {
      m.disparity_i = static_cast<std::uint8_t>(disparity);
      m.eval();
      EXPECT_EQ(m.word_o, word) << byte;
    }
  }
}

}  // namespace
