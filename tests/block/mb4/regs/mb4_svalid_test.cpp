// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The flags SVALIDx of four data channels: page 35, Table 61; decisions 18, 34, 35.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vmb4_svalid.h"
#include "tests/support/model_context.hpp"

namespace {

class Svalid : public mb4test::Block<Vmb4_svalid> {
 public:
  Svalid() {
    none();
    model.eng_bank_i = model.keep_bank_i = 0;
    reset();
  }
  void none() {
    model.begin_i = model.set_en_i = model.set_valid_i = model.split_i = model.clear_i = 0;
    model.keep_en_i = model.keep_i = model.set_slave_i = 0;
  }
  void pulse() {
    clock();
    none();
  }
  bool flag(unsigned bank, unsigned slave) const {
    return ((model.svalid_o >> (4 * bank + slave)) & 1) != 0;
  }
};

// One event a clock, in the bank of each side.
TEST(SvalidBlock, RandomEvents_EachFlagIsThatOfItsLastEvent) {
  mb4test::Dice random;
  Svalid svalid;
  auto& m = svalid.model;
  bool flags[2][4] = {};
  for (int step = 0; step < 20'000; ++step) {
    const unsigned bank = random.below(2);
    const unsigned slave = random.below(4);
    const bool valid = random.below(4) != 0;
    m.eng_bank_i = static_cast<std::uint8_t>(bank);
    const unsigned host_bank = random.below(2);
    m.keep_bank_i = static_cast<std::uint8_t>(host_bank);
    m.set_slave_i = static_cast<std::uint8_t>(slave);
    switch (random.below(32) == 0 ? 4 : random.below(6) % 4) {
      case 0:  // a word begins
        m.begin_i = 1;
        flags[bank][slave] = false;
        break;
      case 1:  // a word is complete
        m.set_en_i = 1;
        m.set_valid_i = valid;
        flags[bank][slave] = valid;
        break;
      case 2: {  // the host writes: 0 clears, 1 has no effect
        const unsigned keep = random.below(16);
        m.keep_en_i = 1;
        m.keep_i = static_cast<std::uint8_t>(keep);
        for (unsigned i = 0; i < 4; ++i)
          flags[host_bank][i] = flags[host_bank][i] && ((keep >> i) & 1) != 0;
        break;
      }
      case 3:  // SWBANK splits a word
        m.split_i = 1;
        flags[0][slave] = flags[1][slave] = false;
        break;
      default:  // INIT of BiSS C
        m.clear_i = 1;
        for (auto& row : flags) {
          for (bool& flag : row) flag = false;
        }
    }
    svalid.pulse();
    for (unsigned b = 0; b < 2; ++b) {
      for (unsigned s = 0; s < 4; ++s) {
        ASSERT_EQ(svalid.flag(b, s), flags[b][s])
            << "step " << step << " bank " << b << " slave " << s;
      }
    }
  }
}

// One bank: the host clears the flag in the clock in which the word is complete.
TEST(SvalidBlock, HostClearsAsTheWordEnds_FlagIsThatOfTheWord) {
  Svalid svalid;
  svalid.model.keep_en_i = svalid.model.set_en_i = svalid.model.set_valid_i = 1;
  svalid.model.keep_i = 0;
  svalid.model.set_slave_i = 2;
  svalid.pulse();
  EXPECT_EQ(svalid.model.svalid_o, 1U << 2);
}

}  // namespace
