// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What INSTR asks for, for every setting: pages 23, 27, 28, 32, Tables 8, 10, 23, 45, 46; decisions
// 37, 43.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vmb4_frame_kind.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

TEST(FrameKindBlock, EverySetting_LinesAndKindAreThoseOfTheTables) {
  mb4test::Block<Vmb4_frame_kind> block;
  auto& m = block.model;
  mb4test::Dice random;
  namespace access_t = mb4test::places::mb4_pkg::access_t;
  using namespace mb4test::places::mb4_pkg::kind_t;
  const auto bits = [&](mb4test::Place place) { return place.of(m.kind_o); };
  for (unsigned setting = 0; setting < 2048; ++setting) {
    const unsigned instr = setting & 7;
    const unsigned chsel = (setting >> 3) & 3;
    const bool cts = (setting >> 5) & 1;
    const bool regvers = (setting >> 6) & 1;
    const unsigned cfgch[2] = {(setting >> 7) & 3, (setting >> 9) & 3};
    m.instr_i = static_cast<std::uint8_t>(instr);
    // The fields that say nothing of the kind are free.
    m.access_i = static_cast<std::uint32_t>(
        access_t::kChsel(chsel) | access_t::kWnr(random.below(2)) |
        access_t::kRegadr(random.below(128)) | access_t::kRegnum(random.below(64)) |
        access_t::kCts(cts) | access_t::kRegvers(regvers) | access_t::kSlaveid(random.below(8)));
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
    ASSERT_EQ(bits(kSelect), select) << "lines of the access";
    ASSERT_EQ(bits(kManual), named);
    ASSERT_EQ(bits(kSsi), ssi);
    ASSERT_EQ(bits(kInUse), in_use);
    ASSERT_EQ(bits(kFrameUse), is_register ? select : in_use);
    ASSERT_EQ(bits(kInitUse), in_use & ~ssi) << "INIT";
    ASSERT_EQ(bits(kIsFrame), plain || (access && can_run)) << "frame";
    ASSERT_EQ(bits(kIsControl), access && can_run && regvers) << "control communication";
    ASSERT_EQ(bits(kIsRegister), is_register) << "BiSS B register access";
    ASSERT_EQ(bits(kIsVoid), access && !can_run) << "void";
  }
}

}  // namespace
