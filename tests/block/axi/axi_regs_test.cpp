// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The registers of the BiSS C master on AXI alone, with five channels: the manual's register map
// and the rulings on the widths of 0x20, 0x24 and 0x28 (docs/axi.md).
#include "axi_regs.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>

#include "Vaxi_regs.h"
#include "places.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace reg = biss_axi::regs;

constexpr unsigned kChannels = 5;
constexpr std::uint32_t kPresent = (1U << kChannels) - 1;

// The bits that a host can write. An index of five channels has three bits.
const std::map<unsigned, std::uint32_t> kWritable{{reg::kAddrSoftReset, 0x1},
                                                  {reg::kAddrSampleClock, 0x1},
                                                  {reg::kAddrMode, 0x1},
                                                  {reg::kAddrRequest, 0x1},
                                                  {reg::kAddrSampleDivider, 0xFFFFFFF},
                                                  {reg::kAddrMaDivider, 0xFF},
                                                  {reg::kAddrPositionBits, 0xFF},
                                                  {reg::kAddrCrcCheck, 0x1},
                                                  {reg::kAddrChannelEnable, kPresent},
                                                  {reg::kAddrChannelIndex, 0x7},
                                                  {reg::kAddrMaShift, kPresent}};

struct Result {
  std::uint32_t single, delay, received, calculated;
};

class AxiRegsBlock : public testing::Test {
 protected:
  AxiRegsBlock() {
    m.word_req_i = m.word_write_i = m.word_addr_i = m.word_be_i = 0;
    m.word_data_i = 0;
    m.single_valid_i = 0;
    for (auto& word : m.results_i.m_storage) word = 0;
    for (auto& word : m.mores_i.m_storage) word = 0;
    m.page_data_i = 0;
    block.reset();
  }
  std::uint32_t read(unsigned address) {
    m.word_req_i = 1;
    m.word_write_i = 0;
    m.word_addr_i = static_cast<std::uint8_t>(address / 4);
    m.eval();
    const std::uint32_t data = m.word_data_o;
    block.clock();
    m.word_req_i = 0;
    return data;
  }
  void write(unsigned address, std::uint32_t data, unsigned enables = 0xF, bool request = true) {
    m.word_req_i = request;
    m.word_write_i = 1;
    m.word_addr_i = static_cast<std::uint8_t>(address / 4);
    m.word_data_i = data;
    m.word_be_i = static_cast<std::uint8_t>(enables);
    block.clock();
    m.word_req_i = m.word_write_i = 0;
  }
  std::uint32_t any() { return random.below(0x10000) << 16 | random.below(0x10000); }
  void set_result(unsigned channel, const Result& result) {
    using namespace mb4test::places::axi_pkg::result_t;
    kSingle.in(channel, kAllBits).set(m.results_i, result.single);
    kDelay.in(channel, kAllBits).set(m.results_i, result.delay);
    kReceived.in(channel, kAllBits).set(m.results_i, result.received);
    kCalculated.in(channel, kAllBits).set(m.results_i, result.calculated);
  }

  mb4test::Dice random;
  mb4test::Block<Vaxi_regs> block;
  Vaxi_regs& m = block.model;
};

TEST_F(AxiRegsBlock, Reset_EverythingReadsZero) {
  for (unsigned address = 0; address < 256; address += 4) EXPECT_EQ(read(address), 0U) << address;
  EXPECT_EQ(m.cfg_o, 0U);
  EXPECT_EQ(m.enable_o, 0);
  EXPECT_EQ(m.ma_shift_o, 0);
}

// Bytes that are not enabled, bits that a register does not have, addresses without a register and
// cycles without a request change nothing.
TEST_F(AxiRegsBlock, RandomWrites_ReachTheirBitsOnly) {
  std::map<unsigned, std::uint32_t> expected;
  for (int i = 0; i < 20000; ++i) {
    const unsigned address = 4 * (i % 2 == 0 ? random.below(64) : random.below(11));
    const std::uint32_t data = any();
    const unsigned enables = random.below(16);
    const bool request = random.below(8) != 0;
    write(address, data, enables, request);
    if (kWritable.contains(address) && request) {
      std::uint32_t mask = kWritable.at(address);
      for (unsigned byte = 0; byte < 4; ++byte) {
        if ((enables >> byte & 1U) == 0) mask &= ~(0xFFU << 8 * byte);
      }
      expected[address] = (expected[address] & ~mask) | (data & mask);
    }
    const unsigned other = 4 * random.below(64);
    ASSERT_EQ(read(address), expected[address]) << std::hex << address;
    ASSERT_EQ(read(other), expected[other]) << std::hex << other;
    namespace cfg_t = mb4test::places::axi_pkg::cfg_t;
    ASSERT_EQ(m.cfg_o, cfg_t::kSoftReset(expected[reg::kAddrSoftReset]) |
                           cfg_t::kExternalClock(expected[reg::kAddrSampleClock]) |
                           cfg_t::kSinglePoint(expected[reg::kAddrMode]) |
                           cfg_t::kRequest(expected[reg::kAddrRequest]) |
                           cfg_t::kSampleDivider(expected[reg::kAddrSampleDivider]) |
                           cfg_t::kMaDivider(expected[reg::kAddrMaDivider]) |
                           cfg_t::kPositionBits(expected[reg::kAddrPositionBits]) |
                           cfg_t::kCrcCheck(expected[reg::kAddrCrcCheck]));
    ASSERT_EQ(m.enable_o, expected[reg::kAddrChannelEnable]);
    ASSERT_EQ(m.ma_shift_o, expected[reg::kAddrMaShift]);
  }
}

// 0x2C, 0x30, 0x38 and 0x3C are those of the channel of 0x24; an index without a channel reads 0.
// 0x34 has one bit for each channel.
TEST_F(AxiRegsBlock, Results_AreThoseOfTheIndexedChannel) {
  for (int round = 0; round < 50; ++round) {
    std::array<Result, 8> results{};
    for (unsigned c = 0; c < kChannels; ++c) {
      results[c] = {any(), random.below(1024), random.below(64), random.below(64)};
      set_result(c, results[c]);
    }
    m.single_valid_i = static_cast<std::uint8_t>(random.below(1U << kChannels));
    for (unsigned c = 0; c < 8; ++c) {
      write(reg::kAddrChannelIndex, c);
      EXPECT_EQ(read(reg::kAddrReceivedCrc), results[c].received) << c;
      EXPECT_EQ(read(reg::kAddrCalculatedCrc), results[c].calculated) << c;
      EXPECT_EQ(read(reg::kAddrSinglePointData), results[c].single) << c;
      EXPECT_EQ(read(reg::kAddrLineDelay), results[c].delay) << c;
      EXPECT_EQ(read(reg::kAddrSinglePointValid), m.single_valid_i);
      // They are read-only.
      for (unsigned address = reg::kAddrReceivedCrc; address <= reg::kAddrLineDelay; address += 4) {
        const std::uint32_t before = read(address);
        write(address, ~before);
        EXPECT_EQ(read(address), before);
      }
    }
  }
}

}  // namespace
