// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The SPI host interface alone, with a plain byte memory behind it: datasheet pages 17..19.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <vector>

#include "Vmb4_spi.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace host_t = mb4test::places::mb4_pkg::host_t;

using Bytes = std::vector<std::uint8_t>;

class SpiBlock : public testing::Test {
 protected:
  SpiBlock() {
    for (unsigned i = 0; i < 256; ++i) memory[i] = static_cast<std::uint8_t>(i ^ 0xC3);
    // A reset is an edge to Verilator, that of the frame too: NCS falls first, which opens it.
    spi.rst_ni = 1;
    spi.cs_ni = 1;
    spi.sclk_i = 0;
    spi.mosi_i = 0;
    spi.rd_data_i = 0xEE;
    spi.eval();
    spi.cs_ni = 0;
    spi.eval();
    spi.rst_ni = 0;
    spi.cs_ni = 1;
    spi.eval();
    spi.rst_ni = 1;
    spi.eval();
  }

  void select(bool active) {
    spi.cs_ni = active ? 0 : 1;
    spi.eval();
  }
  unsigned field(mb4test::Place place) const { return static_cast<unsigned>(place.of(spi.host_o)); }
  // One clock: MISO is what the host samples with the rising edge.
  bool clock(bool mosi) {
    spi.mosi_i = mosi ? 1 : 0;
    spi.eval();
    const bool selected = spi.cs_ni == 0;
    const bool miso = spi.miso_o != 0;
    // What the registers see at the rising edge.
    const bool write = selected && field(host_t::kWrEn) != 0;
    const bool read = selected && field(host_t::kRdEn) != 0;
    if (write) {
      memory[field(host_t::kWrAddr)] = static_cast<std::uint8_t>(field(host_t::kWrData));
      ++writes;
    }
    if (read) {
      next = memory[field(host_t::kRdAddr)];
      ++reads;
    }
    spi.sclk_i = 1;
    spi.eval();
    if (read) {
      spi.rd_data_i = next;
      spi.eval();
    }
    spi.sclk_i = 0;
    spi.eval();
    return miso;
  }
  std::uint8_t byte(std::uint8_t value) {
    unsigned rx = 0;
    for (int i = 7; i >= 0; --i) rx = (rx << 1) | (clock(((value >> i) & 1) != 0) ? 1U : 0U);
    return static_cast<std::uint8_t>(rx);
  }
  Bytes frame(const Bytes& tx) {
    Bytes rx;
    select(true);
    for (const auto value : tx) rx.push_back(byte(value));
    select(false);
    return rx;
  }

  mb4test::Owned<Vmb4_spi> owner;
  Vmb4_spi& spi = *owner;
  std::array<std::uint8_t, 256> memory{};
  std::uint8_t next = 0;
  unsigned writes = 0;
  unsigned reads = 0;
};

// Table 3.
TEST_F(SpiBlock, ReadOpcodes_DataFollowWithoutADummyByte) {
  EXPECT_EQ(frame({0x03, 0x10, 0, 0, 0}), (Bytes{0, 0, 0x10 ^ 0xC3, 0x11 ^ 0xC3, 0x12 ^ 0xC3}));
  EXPECT_EQ(frame({0x05, 0, 0}), (Bytes{0, 0xF0 ^ 0xC3, 0xF1 ^ 0xC3}));
  EXPECT_EQ(frame({0x09, 0, 0}), (Bytes{0, 0x00 ^ 0xC3, 0x01 ^ 0xC3}));
  EXPECT_EQ(writes, 0U);
}

TEST_F(SpiBlock, WriteOpcodes_StartWhereTable3Says) {
  frame({0x02, 0x20, 1, 2, 3});
  frame({0x07, 4, 5});
  frame({0x0B, 6, 7});
  EXPECT_EQ(writes, 7U);
  EXPECT_EQ(reads, 0U);
  EXPECT_EQ(memory[0x20], 1);
  EXPECT_EQ(memory[0x21], 2);
  EXPECT_EQ(memory[0x22], 3);
  EXPECT_EQ(memory[0xF4], 4);
  EXPECT_EQ(memory[0xF5], 5);
  EXPECT_EQ(memory[0x00], 6);
  EXPECT_EQ(memory[0x01], 7);
}

// Decision 13.
TEST_F(SpiBlock, WrapAround_FollowsTheAddressByte) {
  frame({0x02, 0xFF, 0x5A, 0xA5});
  EXPECT_EQ(memory[0xFF], 0x5A);
  EXPECT_EQ(memory[0x00], 0xA5);
  EXPECT_EQ(frame({0x03, 0xFF, 0, 0}), (Bytes{0, 0, 0x5A, 0xA5}));
}

TEST_F(SpiBlock, UnknownOpcode_NoAccessAndZeros) {
  for (unsigned opcode = 0; opcode < 256; ++opcode) {
    if (opcode == 2 || opcode == 3 || opcode == 5 || opcode == 7 || opcode == 9 || opcode == 11) {
      continue;
    }
    EXPECT_EQ(frame({static_cast<std::uint8_t>(opcode), 0x02, 0x00, 0xFF}), (Bytes{0, 0, 0, 0}));
  }
  EXPECT_EQ(writes, 0U);
  EXPECT_EQ(reads, 126U);  // with an opcode whose bit 1 is 0; nobody sees it
}

TEST_F(SpiBlock, NcsHigh_MisoIsHighImpedanceAndClocksAreIgnored) {
  EXPECT_EQ(spi.miso_oe_o, 0);
  select(true);
  EXPECT_EQ(spi.miso_oe_o, 1);
  select(false);
  EXPECT_EQ(spi.miso_oe_o, 0);
  for (int i = 0; i < 40; ++i) clock((i & 1) != 0);
  EXPECT_EQ(writes + reads, 0U);
  EXPECT_EQ(frame({0x03, 0x42, 0}), (Bytes{0, 0, 0x42 ^ 0xC3}));
}

// An incomplete byte has no effect, whatever its length, in every part of a frame.
TEST_F(SpiBlock, FrameEndsInsideAByte_TheByteIsLost) {
  const Bytes tx{0x02, 0x30, 0x77, 0x88};
  for (unsigned clocks = 0; clocks <= 32; ++clocks) {
    writes = 0;
    select(true);
    for (unsigned i = 0; i < clocks; ++i) clock(((tx[i / 8] >> (7 - i % 8)) & 1) != 0);
    select(false);
    EXPECT_EQ(writes, clocks < 24 ? 0U : clocks < 32 ? 1U : 2U) << clocks;
    // The next frame is whole.
    EXPECT_EQ(frame({0x03, 0x11, 0}), (Bytes{0, 0, 0x11 ^ 0xC3}));
  }
}

// MISO changes on the falling edge only, so that the host may sample at the rising one.
TEST_F(SpiBlock, MisoChanges_OnFallingEdgesOnly) {
  select(true);
  byte(0x03);
  byte(0x55);
  for (int i = 0; i < 64; ++i) {
    const auto before = spi.miso_o;
    spi.sclk_i = 1;
    const bool read = field(host_t::kRdEn) != 0;
    const unsigned address = field(host_t::kRdAddr);
    spi.eval();
    if (read) spi.rd_data_i = memory[address];
    spi.eval();
    EXPECT_EQ(spi.miso_o, before);
    spi.sclk_i = 0;
    spi.eval();
  }
  select(false);
}

}  // namespace
