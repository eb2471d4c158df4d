// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Control frames published by TI (TIDEP0022, Tables 7 and 11): the chip sends them itself, and the
// test makes them by hand.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/support/control_host.hpp"

namespace {

using mb4test::Chip;
using mb4test::ControlHost;
using mb4test::kAllGood;
using mb4test::one_slave;
namespace reg = mb4::regs;

const char kTi[] = "preset = \"wachendorff-wdgf58m\"";

// TI TIDEP0022, Table 7 (slots 1..32 as bits 31..0) and Table 11.
struct TiRow {
  std::uint8_t address;
  std::uint32_t cdm;
  std::uint8_t value;
};
constexpr std::array kTiRows{
    TiRow{0x44, 0x889B4000, 0x00}, TiRow{0x45, 0x88BD4000, 0xD9}, TiRow{0x46, 0x88D74000, 0x01},
    TiRow{0x47, 0x88F14000, 0x32}, TiRow{0x60, 0x8C174000, 0x0B}, TiRow{0x67, 0x8CE54000, 0x5F},
    TiRow{0x68, 0x8D014000, 0x00}, TiRow{0x78, 0x8F0B4000, 0x46}, TiRow{0x79, 0x8F2D4000, 0x3A},
    TiRow{0x7A, 0x8F474000, 0xC0}, TiRow{0x7B, 0x8F614000, 0x0C}, TiRow{0x7C, 0x8F934000, 0x00},
    TiRow{0x7D, 0x8FB54000, 0x01}};

std::uint32_t slots_1_to_32(const std::vector<bool>& cdm, std::size_t start) {
  std::uint32_t bits = 0;
  for (std::size_t slot = 1; slot <= 32; ++slot) bits = bits << 1U | (cdm[start + slot] ? 1U : 0U);
  return bits;
}

class ControlTi : public testing::TestWithParam<std::uint8_t> {};

TEST_P(ControlTi, EveryReadRow_IsOnMaBitForBit) {
  for (const TiRow& row : kTiRows) {
    Chip chip(one_slave(kTi));
    chip.configure_slave1(chip.simulator.slave(1)->data_bits(), reg::kScrclenCrc6, GetParam(),
                          reg::kFreqagsAgsMin);
    ControlHost host(chip);
    host.set_read(0, row.address, 1);
    ASSERT_EQ(host.run_single(60), 47U) << "14 zeros, 32 slots, one more for P";
    for (std::size_t i = 0; i < 14; ++i) EXPECT_FALSE(host.cdm()[i]) << i;
    EXPECT_TRUE(host.cdm()[14]) << "S";
    EXPECT_EQ(slots_1_to_32(host.cdm(), 14), row.cdm) << std::hex << unsigned{row.address};
    EXPECT_EQ(host.rdata(1)[0], row.value);
    EXPECT_EQ(host.status(), kAllGood);
    std::printf("read 0x%02X: 47 frames, CDM 0x%08X, value 0x%02X\n", unsigned{row.address},
                slots_1_to_32(host.cdm(), 14), unsigned{host.rdata(1)[0]});
  }
}

// All of Table 11: values that the design guide has read back, at 1, 2, 5 and 10 MHz; also of
// 0x7E and 0x7F, for which Table 7 has no row.
TEST_P(ControlTi, EveryValueOfTable11_IsReadBack) {
  constexpr std::array<std::pair<unsigned, unsigned>, 15> kTable11{{{0x44, 0x00},
                                                                    {0x45, 0xD9},
                                                                    {0x46, 0x01},
                                                                    {0x47, 0x32},
                                                                    {0x60, 0x0B},
                                                                    {0x67, 0x5F},
                                                                    {0x68, 0x00},
                                                                    {0x78, 0x46},
                                                                    {0x79, 0x3A},
                                                                    {0x7A, 0xC0},
                                                                    {0x7B, 0x0C},
                                                                    {0x7C, 0x00},
                                                                    {0x7D, 0x01},
                                                                    {0x7E, 0x57},
                                                                    {0x7F, 0x41}}};
  Chip chip(one_slave(kTi));
  chip.configure_slave1(chip.simulator.slave(1)->data_bits(), reg::kScrclenCrc6, GetParam(),
                        reg::kFreqagsAgsMin);
  ControlHost host(chip);
  for (const auto& [address, value] : kTable11) {
    host.set_read(0, address, 1);
    ASSERT_NE(host.run_single(60), 0U);
    EXPECT_EQ(host.rdata(1)[0], value) << std::hex << address;
    EXPECT_EQ(host.status(), kAllGood);
  }
}

// The printed write row has a wrong header CRC; this is the frame that writes 0x06 to 0x60.
TEST_P(ControlTi, Write0x06To0x60_IsTheConsistentFrame) {
  Chip chip(one_slave(kTi));
  chip.configure_slave1(chip.simulator.slave(1)->data_bits(), reg::kScrclenCrc6, GetParam(),
                        reg::kFreqagsAgsMin);
  ControlHost host(chip);
  host.set_write(0, 0x60, {0x06});
  ASSERT_EQ(host.run_single(60), 47U);
  EXPECT_EQ(slots_1_to_32(host.cdm(), 14), 0x8C16C194U);
  EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x60), 0x06);
  EXPECT_EQ(host.status(), kAllGood);
}

// 10, 5, 2 and 1 MHz.
INSTANTIATE_TEST_SUITE_P(Freqs, ControlTi, testing::Values(0x00, 0x01, 0x04, 0x09));

// One frame by hand; returns CDSSEL.
bool exchange(Chip& chip, std::uint8_t instruction) {
  chip.instruct(instruction);
  EXPECT_TRUE(chip.wait_eot());
  return (chip.read(reg::kAddrStatus3) & reg::CDSSEL::kMask) != 0;
}

// Table 45: the host sends every CDM itself. With INSTR = 011 the chip waits for the slave's start
// bit: it sends CDM = 1 while CDS is 0, and CDM = 0 in the frame that brings CDS = 1.
TEST(ControlByHand, ReadOfABusySlave_Works) {
  Chip chip(one_slave(std::string(kTi) + "\nread_busy_frames = 5"));
  chip.configure_slave1(chip.simulator.slave(1)->data_bits(), reg::kScrclenCrc6, 0x00,
                        reg::kFreqagsAgsMin);
  const auto send = [&](std::uint8_t instruction) { return exchange(chip, instruction); };
  for (int i = 0; i < 13; ++i) send(0x04);
  EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDMTIMEOUT::kMask, 0);
  send(0x04);
  EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDMTIMEOUT::kMask, reg::kCdmtimeoutReached)
      << "CDMTIMEOUT";
  send(0x02);  // S
  EXPECT_EQ(chip.read(reg::kAddrStatus3) & reg::CDMTIMEOUT::kMask, 0);
  const std::uint32_t frame = 0x8CE54000;  // read 0x67, slots 1..
  for (int slot = 1; slot <= 18; ++slot) send((frame >> (32 - slot)) & 1U ? 0x02 : 0x04);
  unsigned waits = 0;
  while (!send(0x06)) ASSERT_LT(++waits, 20U);
  EXPECT_EQ(waits, 5U);
  unsigned value = 0;
  for (int bit = 0; bit < 12; ++bit) value = value << 1U | (send(0x04) ? 1U : 0U);
  EXPECT_EQ(value, 0x5FU << 4U | 0xF) << "0x5F and its inverted CRC";
  EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->counters().protocol_errors, 0U);
}

// The write row of Table 7 as it is printed: its header CRC is wrong, the slave says nothing and
// keeps its register. With the right one it writes.
TEST(ControlByHand, PrintedWriteRow_IsRejected) {
  for (const std::uint32_t frame : {0x8C13C194U, 0x8C16C194U}) {
    const bool right = frame == 0x8C16C194U;
    Chip chip(one_slave(kTi));
    chip.configure_slave1(chip.simulator.slave(1)->data_bits(), reg::kScrclenCrc6, 0x00,
                          reg::kFreqagsAgsMin);
    for (int i = 0; i < 14; ++i) exchange(chip, 0x04);
    exchange(chip, 0x02);  // S
    unsigned answers = 0;
    for (int slot = 1; slot <= 32; ++slot) {
      const bool cds = exchange(chip, (frame >> (32 - slot)) & 1U ? 0x02 : 0x04);
      if (slot > 16) answers += cds ? 1 : 0;
    }
    const auto& counters = clocked(chip.simulator.slave(1))->control()->counters();
    EXPECT_EQ(counters.header_errors, right ? 0U : 1U);
    EXPECT_EQ(counters.writes, right ? 1U : 0U);
    EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x60), right ? 0x06 : 0x0B);
    // W, S and the ones of 00000110 0101.
    EXPECT_EQ(answers, right ? 6U : 0U) << std::hex << frame;
  }
}

}  // namespace
