// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes and reads of a host for each SCLK, CLK and phase between them (I203, I204:
// SCLK up to 50 MHz; D01, D05: CLK 10 to 25 MHz, here also 1 MHz and stopped).
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
namespace reg = mb4::regs;
namespace sim = mb4::sim;
using Bytes = std::vector<std::uint8_t>;

constexpr unsigned kPhases = 42;

class HostSweep : public testing::TestWithParam<unsigned> {
 protected:
  static std::string scenario(unsigned clk_hz) {
    return "[chip]\nf_clk_hz = " + std::to_string(clk_hz) +
           "\n[host]\ninterface = \"spi\"\n[[channel]]\nnumber = 1\n[[channel.slave]]\n"
           "protocol = \"biss-c\"\ndata_bits = 64\nflag_bits = 0\ncrc = 0\nsource = \"ramp\"\n"
           "start = 0\nstep = 0x0101010101010101\n";
  }
};

// 0xFF times the ramp's step is -1: the number of the frame whose word it is, huge if it is torn.
std::uint64_t frame_of(const Bytes& bytes, std::size_t begin) {
  std::uint64_t value = 0;
  for (std::size_t i = 8; i-- > 0;) value = value << 8U | bytes[begin + i];
  return -(value * 0xFF);
}

TEST_P(HostSweep, EveryPhase_WritesAndReadsAreRightAndNoWordIsTorn) {
  const unsigned clk_hz = GetParam();
  unsigned points = 0;
  for (const unsigned sclk_hz : {50'000'000U, 49'999'000U, 41'700'000U, 33'333'000U, 25'000'000U,
                                 20'000'000U, 12'345'000U, 10'000'000U, 5'000'000U}) {
    Chip chip(scenario(clk_hz));
    auto& simulator = chip.simulator;
    simulator.spi().set_timing(sim::SpiTiming::for_frequency(sclk_hz));
    const bool clock = clk_hz != 0;
    const sim::Time clk = clock ? sim::kPsPerSecond / clk_hz : 50'000;
    if (clock) {
      simulator.advance(80 * clk);
      chip.write(reg::slave_cfg_address(1), {reg::kEnscdYes | 63, 0, 0x00, 0x00});
      chip.write(reg::kAddrCtrl, {reg::kRegversBissC, reg::FREQR::of(5), 0, 0x0F});
      chip.write(reg::kAddrSlaveloc5,
                 {reg::kResetSlaveloc5, reg::kCfgch2Unused | reg::kCfgch1BissC});
      // With SCLK above 2 f_CLK the host itself must leave 3 T between writes of 0xF4
      // (docs/timing.md).
      chip.instruct(reg::kAgsOn);
      simulator.advance(2000 * clk);
    }
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      // On a grid of the clock, then this far into a period.
      simulator.run_until((simulator.now() / clk + 13) * clk + clk * phase / kPhases);
      const auto b = [&](unsigned k) {
        // Channels 6 and 7 stay off: frames run.
        return static_cast<std::uint8_t>((phase * 31 + k * 17 + sclk_hz % 251) &
                                         (k % 4 == 0 ? 0xBFU : 0xFFU));
      };
      chip.write(reg::slave_cfg_address(6), {b(0), b(1), b(2), b(3), b(4), b(5), b(6)});
      ASSERT_EQ(chip.read(reg::slave_cfg_address(6), 7),
                (Bytes{b(0), b(1), b(2), b(3), b(4), b(5), b(6)}));
      ASSERT_EQ(chip.read(reg::kAddrRevision, 2), (Bytes{reg::kRevisionY, reg::kVersionIcMb4}));
      if (clock) {
        chip.instruct(reg::kHoldbankPrevented | reg::kAgsOn);
        const auto rx = chip.spi(Bytes{reg::kSpiOpcodeReadRegisters0, 0, 0, 0, 0, 0, 0, 0, 0});
        ASSERT_LE(frame_of(rx, 1), simulator.slave(1)->frames())
            << "torn: SCLK " << sclk_hz << " phase " << phase;
        ASSERT_EQ(chip.read(reg::kAddrScdata, 8), Bytes(rx.begin() + 1, rx.end()));
        simulator.advance(5 * clk);
        chip.instruct(reg::kAgsOn);
        chip.spi({reg::kSpiOpcodeWriteRegisters, reg::rdata_address(17), b(7), b(8), b(9), b(10)});
        simulator.advance(8 * clk);
        ASSERT_EQ(chip.read(reg::rdata_address(17), 4), (Bytes{b(7), b(8), b(9), b(10)}));
        // nAGSERR falls where a slow host holds the banks for longer than a frame (decision 15).
        ASSERT_EQ(
            chip.status() & (reg::nDELAYERR::kMask | reg::nSCDERR::kMask | reg::nREGERR::kMask),
            reg::kNdelayerrGood | reg::kNscderrGood | reg::kNregerrGood);
      } else {
        ASSERT_EQ(chip.status(), reg::kResetStatus0);
      }
      ++points;
    }
  }
  std::printf("CLK %u Hz: %u points\n", clk_hz, points);
  EXPECT_EQ(points, 9 * kPhases);
}

// 6 x 9 x 42 = 2,268 points.
INSTANTIATE_TEST_SUITE_P(Clk, HostSweep,
                         testing::Values(0U, 1'000'000U, 10'000'000U, 16'777'000U, 20'000'000U,
                                         25'000'000U));

}  // namespace
