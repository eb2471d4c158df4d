// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The read port of SPI2 alone: page 19; docs/choices.md, "after reset". A byte is of the bank that
// the host has at its edge.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vmb4_read_port2.h"
#include "tests/support/model_context.hpp"

namespace {

TEST(ReadPort2Block, RandomReads_ByteIsOfTheBankAtTheEdge) {
  mb4test::Dice random;
  mb4test::Owned<Vmb4_read_port2> owner;
  Vmb4_read_port2& m = *owner;
  m.rd_clk_i = m.rd_en_i = m.bank_i = m.ram_ready_i = 0;
  m.data_i = 0xFFFF;
  mb4test::pulse_reset(m);
  EXPECT_EQ(m.rd_data_o, 0);
  bool ready = false;
  bool bank = false;
  for (int step = 0; step < 5'000; ++step) {
    m.rd_en_i = random.below(2) != 0;
    m.bank_i = random.below(2) != 0;
    m.ram_ready_i = random.below(4) != 0;
    if (m.rd_en_i != 0) {
      ready = m.ram_ready_i != 0;
      bank = m.bank_i != 0;
    }
    m.rd_clk_i = 1;
    m.eval();
    if (m.rd_en_i != 0) m.data_i = static_cast<std::uint16_t>(random.below(65536));
    m.bank_i = random.below(2) != 0;  // too late for this byte
    m.ram_ready_i = random.below(2) != 0;
    m.rd_clk_i = 0;
    m.eval();
    ASSERT_EQ(m.rd_data_o, !ready ? 0 : bank ? m.data_i >> 8 : m.data_i & 0xFF) << step;
  }
}

}  // namespace
