// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The CDM bit of the next frame: pages 27, 32, Tables 23, 45.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vmb4_cdm_select.h"
#include "tests/support/model_context.hpp"

namespace {

TEST(CdmSelectBlock, EverySetting_CdmIsThatOfTable45OnTheSelectedLines) {
  mb4test::Block<Vmb4_cdm_select> block;
  auto& m = block.model;
  for (unsigned setting = 0; setting < 1024; ++setting) {
    const unsigned lines = setting & 3;
    const unsigned instr = (setting >> 2) & 7;
    const bool active = ((setting >> 5) & 1) != 0;
    m.manual_i = static_cast<std::uint8_t>(lines);
    m.instr_i = static_cast<std::uint8_t>(instr);
    m.active_i = active;
    m.control0_i = static_cast<std::uint8_t>((setting >> 6) & 3);
    m.control1_i = static_cast<std::uint8_t>(setting >> 8);
    m.eval();
    // 001: CDM = 1; 011: CDM = not(CDSSEL); a control communication makes its own bits.
    const unsigned cds0 = instr == 1 || instr == 3 ? lines : 0;
    const unsigned cds1 = instr == 1 ? lines : 0;
    EXPECT_EQ(m.cdm0_o, active ? m.control0_i : cds0) << setting;
    EXPECT_EQ(m.cdm1_o, active ? m.control1_i : cds1) << setting;
  }
}

}  // namespace
