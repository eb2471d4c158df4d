// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The configuration of the data channels alone: pages 23 to 26, Tables 11 to 19. The registers are
// a memory, which a reset does not clear; the host must read 0 all the same (page 22).
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>

#include "Vmb4_slave_cfg.h"
#include "places.hpp"
#include "tests/block/mb4/host_port.hpp"
#include "tests/support/model_context.hpp"

namespace {

constexpr unsigned kLists = 4;

// Tables 13 to 15: the polynomial of a CRC byte, 0 for no CRC.
unsigned polynomial(unsigned byte) {
  static const std::map<unsigned, unsigned> kTable14 = {
      {3, 0xB}, {4, 0x13}, {5, 0x25}, {6, 0x43}, {7, 0x89}, {8, 0x12F}, {16, 0x190D9}};
  if (byte > 0x80) return (byte & 0x7F) << 1 | 1;
  const auto row = kTable14.find(byte);
  return row == kTable14.end() ? 0 : row->second;
}

namespace row_t = mb4test::places::mb4_pkg::slave_cfg_t;

// What a word list reads; `length` is the byte with SCDLEN, ENSCD and GRAYS or LSTOP (Table 11).
std::uint64_t list_row(unsigned length, unsigned crc, unsigned start) {
  const unsigned full = polynomial(crc);
  unsigned bits = 0;
  while (full >> (bits + 1) != 0) ++bits;
  // The polynomial with the highest power, up to x^7.
  return row_t::kCrcStart(start) | row_t::kCrcOn(bits != 0) |
         row_t::kCrcLast(bits == 0 ? 0 : bits - 1) | row_t::kCrcPoly(full >> 1) |
         row_t::kGrayLstop(length >> 7) | row_t::kEnscd(length >> 6) | row_t::kScdlen(length);
}

class SlaveCfgBlock : public testing::Test {
 protected:
  SlaveCfgBlock() {
    m.wr_clk_i = m.rd_clk_i = m.clk_i = m.list_en_i = 0;
    m.host_i = 0;
    reset();
  }
  void reset() {
    mb4test::pulse_reset(m);
    bytes.fill(0);
  }
  void write(unsigned address, unsigned byte) {
    m.host_i = mb4test::host_writes(0xC0 | address, byte);
    m.wr_clk_i = 1;
    m.eval();
    m.wr_clk_i = 0;
    m.host_i = 0;
    m.eval();
    bytes[address] = byte;
  }
  unsigned read(unsigned address) { return read_map(0xC0 | address); }
  unsigned read_map(unsigned address) {
    m.host_i = mb4test::host_reads(address);
    m.rd_clk_i = 1;
    m.eval();
    m.rd_clk_i = 0;
    m.host_i = address ^ 1;  // asks nothing
    m.eval();
    return m.rd_data_o;
  }
  // What list `list` gets for data channel `x` (0 to 7). All lists are asked at once.
  std::uint64_t list_reads(unsigned list, unsigned x, mb4test::Dice& random) {
    m.list_en_i = 0xF;
    unsigned slaves = random.below(1U << 12);
    slaves = (slaves & ~(7U << 3 * list)) | x << 3 * list;
    m.list_slave_i = static_cast<std::uint16_t>(slaves);
    m.clk_i = 1;
    m.eval();
    m.clk_i = 0;
    m.list_en_i = 0;
    m.eval();
    return mb4test::Place{row_t::kAllBits * list, row_t::kAllBits}.get(m.list_cfg_o);
  }
  std::array<unsigned, 32> bytes{};
  mb4test::Owned<Vmb4_slave_cfg> owner;
  Vmb4_slave_cfg& m = *owner;
};

TEST_F(SlaveCfgBlock, RandomWrites_HostAndListsReadThem) {
  mb4test::Dice random;
  for (int step = 0; step < 20'000; ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step);
    if (random.below(400) == 0) reset();
    // Every second CRC byte is a code of Table 14.
    const unsigned byte = random.below(2) != 0 ? random.below(17) : random.below(256);
    if (random.below(3) == 0) write(random.below(32), byte);
    const unsigned address = random.below(32);
    ASSERT_EQ(read(address), bytes[address]) << "address " << address;
    const unsigned other = random.below(0x100);
    if (other < 0xC0 || other >= 0xE0) {
      ASSERT_EQ(read_map(other), 0U) << "address " << other;
    }
    unsigned enscd = 0;
    for (unsigned x = 0; x < 8; ++x) enscd |= (bytes[4 * x] >> 6 & 1U) << x;  // Table 11: bit 6
    ASSERT_EQ(m.enscd_o, enscd);
    const unsigned x = random.below(8);
    // A word list asks only for channels with ENSCDx.
    if ((enscd >> x & 1U) == 0) continue;
    const unsigned list = random.below(kLists);
    const std::uint64_t expected =
        list_row(bytes[4 * x], bytes[4 * x + 1], bytes[4 * x + 2] | bytes[4 * x + 3] << 8);
    ASSERT_EQ(list_reads(list, x, random), expected) << "list " << list << " channel " << x + 1;
  }
}

}  // namespace
