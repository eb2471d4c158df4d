// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What INSTR asks for, for every setting: pages 23, 27, 28, 32, Tables 8, 10, 23, 45, 46; decisions
// 37, 43.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vmb4_frame_kind.h"
#include "tests/support/model_context.hpp"

namespace {

TEST(FrameKindBlock, EverySetting_LinesAndKindAreThoseOfTheTables) {
  mb4test::Block<Vmb4_frame_kind> block;
  auto& m = block.model;
  mb4test::Dice random;
  const auto bits = [&](unsigned lsb, unsigned width) {
    return (static_cast<unsigned>(m.kind_o) >> lsb) & ((1U << width) - 1);
  };
  for (unsigned setting = 0; setting < 2048; ++setting) {
    const unsigned instr = setting & 7;
    const unsigned chsel = (setting >> 3) & 3;
    const bool cts = (setting >> 5) & 1;
    const bool regvers = (setting >> 6) & 1;
    const unsigned cfgch[2] = {(setting >> 7) & 3, (setting >> 9) & 3};
    m.instr_i = static_cast<std::uint8_t>(instr);
    // mb4_pkg::access_t; the fields that say nothing of the kind are free.
    m.access_i = chsel << 19 | random.below(1U << 14) << 5 | (cts ? 1U << 4 : 0) |
                 (regvers ? 1U << 3 : 0) | random.below(8);
    m.protocol_i = static_cast<std::uint8_t>(cfgch[1] << 2 | cfgch[0]);
    m.eval();

    unsigned in_use = 0, ssi = 0, named = 0, select = 0;
    for (unsigned line = 0; line < 2; ++line) {
      const unsigned bit = 1U << line;
      // Table 8: 3 is no device.
      if (cfgch[line] != 3) in_use |= bit;
      if (cfgch[line] == 2) ssi |= bit;
      // Table 23: 00 is channel 1.
      if ((chsel & bit) != 0 || (chsel == 0 && line == 0)) named |= bit;
      // REGVERS: BiSS B by its own registers (page 28), BiSS C and extended SSI by CDM (page 16).
      if ((named & in_use & bit) != 0 && (cfgch[line] != 0) == regvers) select |= bit;
    }
    // Page 27: registers of one channel at a time, commands on both.
    const bool can_run = select != 0;
    if (select == 3 && regvers && cts) select = 1;
    // Table 45.
    const bool access = instr == 4 || instr == 7;
    const bool plain = instr >= 1 && instr <= 3;

    SCOPED_TRACE(testing::Message() << "INSTR " << instr << " CHSEL " << chsel << " CTS " << cts
                                    << " REGVERS " << regvers << " CFGCH " << cfgch[0] << cfgch[1]);
    const bool is_register = access && can_run && !regvers;
    ASSERT_EQ(bits(8, 2), select) << "lines of the access";
    ASSERT_EQ(bits(10, 2), named);
    ASSERT_EQ(bits(12, 2), ssi);
    ASSERT_EQ(bits(14, 2), in_use);
    ASSERT_EQ(bits(6, 2), is_register ? select : in_use);
    ASSERT_EQ(bits(4, 2), in_use & ~ssi) << "INIT";
    ASSERT_EQ(bits(3, 1), plain || (access && can_run)) << "frame";
    ASSERT_EQ(bits(2, 1), access && can_run && regvers) << "control communication";
    ASSERT_EQ(bits(1, 1), is_register) << "BiSS B register access";
    ASSERT_EQ(bits(0, 1), access && !can_run) << "void";
  }
}

}  // namespace
