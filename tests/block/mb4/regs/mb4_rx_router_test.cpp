// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Where received bytes and line delays go: pages 23, 26, 32, 33, Tables 10, 20; decision 16.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>

#include "Vmb4_rx_router.h"
#include "tests/support/model_context.hpp"

namespace {

using Writes = std::map<unsigned, unsigned>;  // 64 x bank + address of Table 20: byte

TEST(RxRouterBlock, RandomBytes_StandAtTheAddressesOfTable20) {
  mb4test::Dice random;
  mb4test::Block<Vmb4_rx_router> block;
  auto& m = block.model;
  const auto pick = [&](unsigned limit) { return static_cast<std::uint8_t>(random.below(limit)); };
  for (int step = 0; step < 50'000; ++step) {
    const bool two_lines = pick(2) != 0;
    const bool init = pick(8) == 0;  // INIT measures delays and receives no word
    m.slaveloc5_i = two_lines;
    m.host_bank_i = pick(2);
    m.eng_bank_i = pick(2);
    // Table 10: data channels 5 to 8 are those of line 2 with SLAVELOC5 = 1, else of line 1.
    m.ch1_slave_i = pick(two_lines ? 4 : 8);
    m.ch2_slave_i = static_cast<std::uint8_t>(4 + pick(4));
    m.ch1_wr_byte_i = pick(8);
    m.ch2_wr_byte_i = pick(8);
    m.ch1_wr_data_i = pick(256);
    m.ch2_wr_data_i = pick(256);
    m.ch1_delay_i = pick(256);
    m.ch2_delay_i = pick(256);
    m.ch1_wr_en_i = !init && pick(2) != 0;
    m.ch2_wr_en_i = !init && two_lines && pick(2) != 0;
    m.ch1_delay_en_i = init && pick(2) != 0;
    m.ch2_delay_en_i = init && two_lines && pick(2) != 0;
    m.eval();

    Writes expected;
    if (m.ch1_wr_en_i) {
      expected[64U * m.eng_bank_i + 8U * m.ch1_slave_i + m.ch1_wr_byte_i] = m.ch1_wr_data_i;
    }
    if (m.ch2_wr_en_i) {
      expected[64U * m.eng_bank_i + 8U * m.ch2_slave_i + m.ch2_wr_byte_i] = m.ch2_wr_data_i;
    }
    // Page 33: SCDATA1(7:0) and SCDATA5(7:0), in the bank that the host reads.
    if (m.ch1_delay_en_i) expected[64U * m.host_bank_i] = m.ch1_delay_i;
    if (m.ch2_delay_en_i) expected[64U * m.host_bank_i + 0x20] = m.ch2_delay_i;

    Writes seen;
    const auto address = [](unsigned wr_addr, unsigned half) {
      return 64 * (wr_addr >> 5) + 32 * half + (wr_addr & 31);
    };
    if (m.lo_wr_en_o) seen[address(m.lo_wr_addr_o, 0)] = m.lo_wr_data_o;
    if (m.hi_wr_en_o) seen[address(m.hi_wr_addr_o, 1)] = m.hi_wr_data_o;
    ASSERT_EQ(seen, expected) << "step " << step;
  }
}

}  // namespace
