// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The second serial interface alone, with SCDATA of both halves behind it: datasheet page 19,
// Tables 4 and 5; decision 13.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "Vmb4_spi2.h"
#include "mb4_regs.hpp"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace reg = mb4::regs;
using Bytes = std::vector<std::uint8_t>;

constexpr unsigned kFirst = reg::kAddrScdata + 4 * reg::kScdataStride;  // SCDATA5
constexpr unsigned kBehind = kFirst + 4 * reg::kScdataStride;

class Spi2Block : public testing::Test {
 protected:
  Spi2Block() {
    for (unsigned i = 0; i < 64; ++i) memory[i] = static_cast<std::uint8_t>(0x80 | i * 5);
    // A reset is an edge to Verilator: NCS falls before it.
    m.rst_ni = m.cs_ni = 1;
    m.sclk_i = m.mosi_i = m.rd_data_i = 0;
    m.eval();
    m.cs_ni = 0;
    m.eval();
    m.rst_ni = 0;
    m.cs_ni = 1;
    m.eval();
    m.rst_ni = 1;
    m.eval();
  }
  void select(bool active) {
    m.cs_ni = active ? 0 : 1;
    m.eval();
  }
  bool clock(bool mosi) {
    m.mosi_i = mosi;
    m.eval();
    const bool miso = m.miso_o != 0;
    namespace at = mb4test::places::mb4_pkg::mem_rd_t;
    const bool read = m.cs_ni == 0 && at::kEn.of(m.read_o) != 0;
    const auto address = static_cast<unsigned>(at::kAddr.of(m.read_o));
    m.sclk_i = 1;
    m.eval();
    if (read) m.rd_data_i = memory[address];
    if (read) ++reads;
    m.eval();
    m.sclk_i = 0;
    m.eval();
    return miso;
  }
  Bytes frame(const Bytes& tx) {
    Bytes rx;
    select(true);
    EXPECT_EQ(m.miso_oe_o, 1);
    for (const unsigned value : tx) {
      unsigned byte = 0;
      for (unsigned bit = 8; bit-- > 0;)
        byte = byte << 1 | (clock((value >> bit & 1U) != 0) ? 1 : 0);
      rx.push_back(static_cast<std::uint8_t>(byte));
    }
    select(false);
    EXPECT_EQ(m.miso_oe_o, 0) << "high impedance";
    return rx;
  }
  // What a byte of the host's address space reads as.
  std::uint8_t at(unsigned address) const {
    address &= 0xFFU;
    return address >= kFirst && address < kBehind ? memory[address] : std::uint8_t{0};
  }

  mb4test::Owned<Vmb4_spi2> owner;
  Vmb4_spi2& m = *owner;
  std::array<std::uint8_t, 64> memory{};
  unsigned reads = 0;
};

// Table 5, 0x03: SCDATA5..8 read as they are, everything else as 0, also in one frame that runs
// into them and out of them.
TEST_F(Spi2Block, ReadRegisters_ShowsSlaves5To8Only) {
  for (unsigned address = 0; address < 256; ++address) {
    const Bytes rx = frame({0x03, static_cast<std::uint8_t>(address), 0, 0, 0});
    ASSERT_EQ(rx, (Bytes{0, 0, at(address), at(address + 1), at(address + 2)})) << address;
  }
}

// Table 5, 0x09: from SCDATA5 on, without an address.
TEST_F(Spi2Block, ReadRegisters0_BeginsWithSlave5) {
  Bytes sent(35);
  Bytes expected(35);
  sent[0] = 0x09;
  for (unsigned i = 1; i < 35; ++i) expected[i] = at(kFirst + i - 1);
  EXPECT_EQ(frame(sent), expected);
  EXPECT_EQ(frame({0x09, 0xFF}), (Bytes{0, at(kFirst)})) << "each frame begins anew";
}

// Writes, status and instruction are not to be reached (page 19): 0 until NCS rises.
TEST_F(Spi2Block, OtherOpcodes_ReadZeros) {
  for (unsigned opcode = 0; opcode < 256; ++opcode) {
    if (opcode == 0x03 || opcode == 0x09) continue;
    const auto byte = static_cast<std::uint8_t>(opcode);
    ASSERT_EQ(frame({byte, kFirst, 0x03, kFirst, 0x09, 0}), Bytes(6)) << opcode;
  }
  EXPECT_EQ(reads, 127U);  // with an opcode whose bit 1 is 0; nobody sees it
  EXPECT_EQ(frame({0x03, kFirst, 0}), (Bytes{0, 0, at(kFirst)}));
}

// Decision 13: a frame that ends inside a byte leaves the next one whole.
TEST_F(Spi2Block, FrameEndsInsideAByte_NextOneIsWhole) {
  for (unsigned clocks = 0; clocks < 24; ++clocks) {
    select(true);
    for (unsigned i = 0; i < clocks; ++i) clock((0x032500U >> (23 - i) & 1U) != 0);
    select(false);
    EXPECT_EQ(frame({0x03, 0x3E, 0, 0, 0}), (Bytes{0, 0, at(0x3E), at(0x3F), 0})) << clocks;
  }
}

}  // namespace
