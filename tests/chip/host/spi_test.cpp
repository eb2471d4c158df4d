// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SPI through the pins: datasheet pages 11, 17..19 (Table 3), decision 13.
#include <gtest/gtest.h>

#include <tuple>

#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

using Bytes = std::vector<std::uint8_t>;

TEST(ChipSpi, OpcodeAndAddress_MisoIsZero) {
  Chip chip("");
  chip.write(reg::slave_cfg_address(1),
             {reg::kGraysGray | reg::kEnscdYes | 63,
              reg::kSelcrcsByPolynomial | reg::SCRCPOLY<1>::of(127), 0xFF});
  const auto rx = chip.spi({0x03, 0xC0, 0xFF, 0xFF, 0xFF});
  EXPECT_EQ(rx, (Bytes{0x00, 0x00, 0xFF, 0xFF, 0xFF}));
  EXPECT_EQ(chip.spi({0x02, 0xC4, 0xFF, 0xFF}), (Bytes{0, 0, 0, 0}));
}

// Decision 13: the address wraps from 0xFF to 0x00, in both directions of data.
TEST(ChipSpi, BurstPast0xFF_WrapsTo0x00) {
  Chip chip("");
  chip.write(0xFD, {1, 2, 3, 0xA0, 0xA1, 0xA2});
  EXPECT_EQ(chip.read(reg::kAddrScdata, 3), (Bytes{0xA0, 0xA1, 0xA2}));
  EXPECT_EQ(chip.read(0xFE, 5), (Bytes{0x00, 0x00, 0xA0, 0xA1, 0xA2}));
}

TEST(ChipSpi, UnknownOpcodes_AreIgnoredUntilNcsRises) {
  Chip chip("");
  for (unsigned opcode = 0; opcode < 256; ++opcode) {
    if (opcode == 0x02 || opcode == 0x03 || opcode == 0x05 || opcode == 0x07 || opcode == 0x09 ||
        opcode == 0x0B) {
      continue;
    }
    // What follows would be a valid write to 0xC0, and a read, if it were looked at.
    EXPECT_EQ(chip.spi({static_cast<std::uint8_t>(opcode), 0x02, 0xC0, 0x55, 0x03, 0xEB, 0x00}),
              (Bytes{0, 0, 0, 0, 0, 0, 0}));
  }
  EXPECT_EQ(chip.read(reg::slave_cfg_address(1)), 0);
}

// Decision 13: a byte takes effect at its 8th rising edge, an incomplete one not at all.
TEST(ChipSpi, AbortedByte_HasNoEffect) {
  for (unsigned clocks = 0; clocks <= 24; ++clocks) {
    Chip chip("");
    auto& simulator = chip.simulator;
    const std::uint32_t bits = 0x02C0FF;
    simulator.set_pin(sim::Pin::kNcs, false);
    simulator.advance(20'000);
    for (unsigned i = 0; i < clocks; ++i) {
      simulator.set_pin(sim::Pin::kDb0, ((bits >> (23 - i)) & 1U) != 0);
      simulator.advance(10'000);
      simulator.set_pin(sim::Pin::kAle, true);
      simulator.advance(10'000);
      simulator.set_pin(sim::Pin::kAle, false);
    }
    simulator.advance(10'000);
    simulator.set_pin(sim::Pin::kNcs, true);
    simulator.advance(50'000);
    EXPECT_EQ(chip.read(reg::slave_cfg_address(1)),
              clocks == 24 ? reg::kGraysGray | reg::kEnscdYes | 63 : 0)
        << clocks;
    EXPECT_EQ(chip.read(reg::SCRCLEN<1>::kAddress), 0);
  }
}

// Pages 18, 19: 0x02 to 0xF4 acts like 0x07; 0x07 goes on to 0xF5.
TEST(ChipSpi, WriteInstruction_StartsAt0xF4) {
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0x1111111"));
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x00, reg::kFreqagsAgsMin);
  chip.spi({0x07, 0x04, 0x0C});
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrIface), reg::kCfgifLvds);
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 1U);
  chip.spi({0x02, 0xF4, 0x04});
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.simulator.slave(1)->frames(), 2U);
}

// SCLK, system clock and a starting phase: 50 MHz SCLK is I203, I204 (10 ns each); 10..25 MHz is
// D01, D05, from the pin or from the oscillator. All opcodes at once.
class SpiAtRatio : public testing::TestWithParam<std::tuple<unsigned, unsigned, bool>> {};

TEST_P(SpiAtRatio, AllOpcodes_WorkAtEveryPhase) {
  const auto [sclk_khz, clk_khz, oscillator] = GetParam();
  const std::string hz = std::to_string(clk_khz * 1000);
  Chip chip(one_slave("data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF", "delay_ns = 20.0",
                      oscillator ? "f_clk_hz = 0\nf_osc_hz = " + hz : "f_clk_hz = " + hz));
  chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(sclk_khz * 1000ULL));
  if (oscillator) chip.write(reg::kAddrIface, {reg::kClkeniInternal});
  // A slow host sees EOT = 0 only in a slow frame.
  chip.configure_slave1(28, reg::kScrclenCrc6, sclk_khz >= 33'333 ? 0x00 : 0x1F,
                        reg::kFreqagsAgsMin);
  std::uint64_t random = 1;
  const auto phase = [&] {
    random = random * 6364136223846793005ULL + 1442695040888963407ULL;
    chip.simulator.advance((random >> 33) % 200'000);
  };
  for (unsigned i = 0; i < 25; ++i) {
    const auto b = [&](unsigned k) { return static_cast<std::uint8_t>(i * 29 + k * 17 + 3); };
    phase();
    chip.write(reg::slave_cfg_address(2), {b(0), b(1), b(2), b(3)});  // 0x02
    phase();
    ASSERT_EQ(chip.read(reg::slave_cfg_address(2), 4), (Bytes{b(0), b(1), b(2), b(3)}));  // 0x03
    chip.write(reg::slave_cfg_address(2), {0, 0, 0, 0});
    phase();
    Bytes burst{0x0B};
    for (unsigned k = 0; k < 64; ++k) burst.push_back(b(k));
    chip.spi(burst);  // 0x0B
    phase();
    chip.advance_us(1);
    Bytes rx = chip.spi(Bytes(65, 0x00));  // an unknown opcode between: nothing
    ASSERT_EQ(rx, Bytes(65, 0x00));
    Bytes tx(65, 0x00);
    tx[0] = 0x09;
    rx = chip.spi(tx);  // 0x09
    burst[0] = 0x00;
    ASSERT_EQ(rx, burst);
    chip.spi({0x02, 0x80, b(5), b(6), b(7)});
    chip.advance_us(1);
    ASSERT_EQ(chip.read(reg::kAddrRdata, 3), (Bytes{b(5), b(6), b(7)}));
    phase();
    chip.instruct(reg::kInstrCdm0);  // 0x07
    // Decision 26: the first status read that can follow sees EOT = 0.
    const Bytes status = chip.spi({0x05, 0x00, 0x00, 0x00, 0x00, 0x00});  // 0x05
    ASSERT_EQ(status[1], 0xFA) << i;
    ASSERT_EQ(status[4], i < 14 ? 0x00 : 0x80) << "CDMTIMEOUT after 14 frames with CDM = 0";
    ASSERT_EQ(status[5], 0x04);
    ASSERT_TRUE(chip.wait_eot());
    ASSERT_EQ(chip.status(), reg::kResetStatus0);
    ASSERT_EQ(chip.read(reg::kAddrSvalidLo), reg::SVALID<1>::kMask);
    ASSERT_EQ(chip.read(reg::kAddrScdata, 4), (Bytes{0xBF, 0x37, 0xAF, 0x0A}));
    chip.write(reg::kAddrSvalidLo, {0});
    chip.advance_us(1);
    ASSERT_EQ(chip.read(reg::kAddrSvalidLo), 0);
  }
  // Two writes of 0xF4 follow each other as closely as SPI allows. The chip carries out both.
  for (unsigned i = 0; i < 25; ++i) {
    const std::uint64_t before = chip.simulator.slave(1)->frames();
    chip.advance_us(100);  // the slave's timeout: BREAK ends no frame
    phase();
    chip.instruct(reg::kBreakAbort);
    chip.instruct(reg::kInstrCdm0);
    ASSERT_TRUE(chip.wait_eot()) << i;
    ASSERT_EQ(chip.simulator.slave(1)->frames(), before + 1) << i;
  }
}

std::string ratio_name(const testing::TestParamInfo<SpiAtRatio::ParamType>& info) {
  return "Sclk" + std::to_string(std::get<0>(info.param)) + "kHz_Clk" +
         std::to_string(std::get<1>(info.param)) + "kHz" +
         (std::get<2>(info.param) ? "_Oscillator" : "");
}

INSTANTIATE_TEST_SUITE_P(Ratios, SpiAtRatio,
                         testing::Combine(testing::Values(50'000U, 33'333U, 10'000U, 1'000U),
                                          testing::Values(20'000U, 25'000U, 10'000U, 12'500U,
                                                          16'777U),
                                          testing::Values(false)),
                         ratio_name);

INSTANTIATE_TEST_SUITE_P(RatiosOscillator, SpiAtRatio,
                         testing::Combine(testing::Values(50'000U, 10'000U),
                                          testing::Values(10'000U, 25'000U), testing::Values(true)),
                         ratio_name);

// Two chips in one process do not know of each other.
TEST(ChipSpi, TwoChips_AreIndependent) {
  Chip a("");
  Chip b("[chip]\nf_clk_hz = 25_000_000\n");
  a.write(reg::slave_cfg_address(1), {18});
  b.write(reg::slave_cfg_address(1), {52});
  EXPECT_EQ(a.read(reg::slave_cfg_address(1)), 18);
  EXPECT_EQ(b.read(reg::slave_cfg_address(1)), 52);
}

}  // namespace
