// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A data memory alone: pages 26, 28, Tables 20, 27. Host and core see the same bytes. After a reset
// the memory is 0 (page 22), and no write of the host may come before that: clearing goes first.
// Bits on the line do not wait, the posted bytes of the host can: the lines go before the host
// (docs/choices.md, "after reset" and 36).
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "Vmb4_memory.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

std::uint16_t write_port(bool enable, unsigned address, unsigned byte) {
  namespace at = mb4test::places::mb4_pkg::mem_wr_t;
  return static_cast<std::uint16_t>(at::kEn(enable) | at::kAddr(address) | at::kData(byte));
}
std::uint8_t read_port(bool enable, unsigned address) {
  namespace at = mb4test::places::mb4_pkg::mem_rd_t;
  return static_cast<std::uint8_t>(at::kEn(enable) | at::kAddr(address));
}

TEST(MemoryBlock, EveryMixOfWriters_BothSidesReadTheByteOfTheFirst) {
  mb4test::Dice random;
  mb4test::Owned<Vmb4_memory> owner;
  Vmb4_memory& m = *owner;
  const auto low = [&] {
    m.clk_i = m.rd_clk_i = 0;
    m.eval();
  };
  m.eng_wr_i = m.host_wr_i = 0;
  m.eng_rd_i = m.rd_i = m.rd2_i = m.rd2_clk_i = 0;
  low();
  std::array<unsigned, 64> bytes{};
  // Page 22: all RAM registers are 0 after power-on. mb4_ram_clear counts the addresses.
  for (unsigned address = 0; address < 64; ++address) {
    m.clear_i = write_port(true, address, 0);
    m.host_wr_i = write_port(true, 0, 0xA5);  // waits
    m.clk_i = 1;
    m.eval();
    ASSERT_EQ(m.host_ready_o, 0);
    low();
  }
  for (int step = 0; step < 20'000; ++step) {
    const bool clears = random.below(16) == 0;
    const bool core_writes = random.below(2) != 0;
    const bool host_asks = random.below(2) != 0;
    SCOPED_TRACE(testing::Message() << "step " << step << " clear " << clears << " lines "
                                    << core_writes << " host " << host_asks);
    const unsigned cleared = random.below(64);
    const unsigned core_address = random.below(64);
    const unsigned core_byte = random.below(256);
    const unsigned host_address = random.below(64);
    const unsigned host_byte = random.below(256);
    m.clear_i = write_port(clears, cleared, 0);
    m.eng_wr_i = write_port(core_writes, core_address, core_byte);
    m.host_wr_i = write_port(host_asks, host_address, host_byte);
    m.eval();
    if (host_asks) {
      ASSERT_EQ(m.host_ready_o, !clears && !core_writes) << "a byte is taken only if written";
    }
    m.clk_i = 1;
    m.eval();
    low();
    if (core_writes) {
      bytes[core_address] = core_byte;
    } else if (clears) {
      bytes[cleared] = 0;
    } else if (host_asks) {
      bytes[host_address] = host_byte;
    }
    m.clear_i = m.eng_wr_i = m.host_wr_i = 0;

    const unsigned core_reads = random.below(64);
    const unsigned host_reads = random.below(32);
    m.eng_rd_i = read_port(true, core_reads);
    m.rd_i = read_port(false, host_reads);
    m.clk_i = 1;
    m.eval();
    low();
    m.eng_rd_i = read_port(false, core_reads);
    m.rd_i = read_port(true, host_reads);
    m.rd_clk_i = 1;
    m.eval();
    low();
    m.rd_i = read_port(false, (host_reads + 1) % 32);
    m.rd_clk_i = m.clk_i = 1;  // neither side asks: both keep their byte
    m.eval();
    low();
    ASSERT_EQ(m.eng_data_o, bytes[core_reads]);
    ASSERT_EQ(m.rd_data_o, bytes[32 + host_reads] << 8 | bytes[host_reads]) << "both banks";
  }
}

}  // namespace
