// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The serial CRC alone: page 25, Table 15.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>

#include "Venc_crc.h"
#include "tests/support/model_context.hpp"

namespace {

using mb4test::Block;

// The table of docs/theory.md, CRC: 28 bits of 0x2ABCDEF with nE = nW = 1.
TEST(CrcBlock, GoldenVectors_OfAllWidthsAndStarts) {
  struct Row {
    unsigned width;
    std::uint32_t polynomial;
    std::uint16_t start0, start1, start_ffff;
  };
  const Row rows[] = {{3, 0xB, 0x5, 0x4, 0x2},
                      {4, 0x13, 0x9, 0x4, 0xE},
                      {5, 0x25, 0x10, 0x06, 0x1E},
                      {6, 0x43, 0x18, 0x04, 0x31},
                      {7, 0x89, 0x21, 0x12, 0x20},
                      {8, 0x12F, 0x0C, 0xEC, 0x7E},
                      {16, 0x190D9, 0x13F8, 0x2264, 0x07A8}};
  Block<Venc_crc> crc;
  crc.model.load_i = 0;
  crc.model.shift_i = 0;
  crc.reset();
  const std::string data = "1010101011110011011110111111";
  for (const Row& row : rows) {
    for (const auto& [start, expected] : {std::pair<std::uint16_t, std::uint16_t>{0, row.start0},
                                          {1, row.start1},
                                          {0xFFFF, row.start_ffff}}) {
      crc.model.crc16_i = row.width == 16;
      crc.model.poly_i = static_cast<std::uint8_t>(row.polynomial);  // degree 16: its lower half
      crc.model.last_i = (row.width - 1) & 7U;
      crc.model.start_i = start;
      crc.model.load_i = 1;
      crc.clock();
      crc.model.load_i = 0;
      crc.model.shift_i = 1;
      crc.model.feed_i = 1;
      for (const char bit : data) {
        crc.model.bit_i = bit == '1' ? 1 : 0;
        crc.clock();
      }
      crc.model.feed_i = 0;
      unsigned value = 0;
      for (unsigned i = 0; i < row.width; ++i) {
        crc.model.bit_i = i & 1U;  // must not matter
        crc.model.eval();
        value = (value << 1) | crc.model.top_o;
        crc.clock();
      }
      crc.model.shift_i = 0;
      EXPECT_EQ(value, expected) << "width " << row.width << " start " << start;
    }
  }
}

}  // namespace
