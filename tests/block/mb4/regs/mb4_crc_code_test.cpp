// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The polynomial of each choice of CRC: pages 24, 25, Tables 13 to 15.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>

#include "Vmb4_crc_code.h"
#include "tests/support/model_context.hpp"

namespace {

TEST(CrcCodeBlock, EveryCode_PolynomialOfTables14And15WithoutItsLastOne) {
  const std::map<unsigned, unsigned> table14 = {{3, 0xB},  {4, 0x13}, {5, 0x25},
                                                {6, 0x43}, {7, 0x89}, {8, 0x12F}};
  mb4test::Block<Vmb4_crc_code> block;
  auto& m = block.model;
  for (unsigned code = 0; code < 128; ++code) {
    m.code_i = static_cast<std::uint8_t>(code);
    m.selcrc_i = 1;
    m.eval();
    EXPECT_EQ(m.poly_o, code) << "SCRCPOLY " << code;
    m.selcrc_i = 0;
    m.eval();
    const auto row = table14.find(code);
    // 0x190D9 has a code of its own; codes that are not permitted switch the CRC off.
    EXPECT_EQ(m.poly_o, row != table14.end() ? row->second >> 1
                        : code == 0x10       ? 0xECU
                                             : 0U)
        << "SCRCLEN " << code;
  }
}

}  // namespace
