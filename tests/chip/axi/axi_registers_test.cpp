// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Registers and clocks of the BiSS C master on AXI (hello-fpga manual, 2.4; docs/axi.md).
#include <vector>

#include "sim/core/random.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/chip/axi/axi_bench.hpp"

namespace mb4test {
namespace {

// Table 2.4: width of each register of a master with n channels; 0 = only read.
struct Row {
  std::uint8_t address;
  std::uint32_t writable;
};
std::vector<Row> table(unsigned n) {
  const std::uint32_t channels = (1U << n) - 1;
  const std::uint32_t index = n == 1 ? 1 : n == 4 ? 3 : 15;
  return {{0x00, 1},          {0x04, 1},     {0x08, 1},        {0x0C, 1},
          {0x10, 0xFFF'FFFF}, {0x14, 0xFF},  {0x18, 0xFF},     {0x1C, 1},
          {0x20, channels},   {0x24, index}, {0x28, channels}, {0x2C, 0},
          {0x30, 0},          {0x34, 0},     {0x38, 0},        {0x3C, 0}};
}

std::vector<AxiEncoder> encoders(unsigned n) { return std::vector<AxiEncoder>(n); }

TEST(Axi, F1EveryRegister_HasItsWidthResetAndStrobes) {
  for (const unsigned n : {1U, 4U, 16U}) {
    AxiBench bench(axi_scenario(encoders(n)));
    sim::Random random(n);
    // The request register comes last, so that nothing runs; soft reset holds all else still.
    for (const Row& row : table(n)) EXPECT_EQ(bench.read(row.address), 0U) << row.address;
    for (unsigned round = 0; round < 20; ++round) {
      bench.write(0x00, 1);
      std::vector<std::uint32_t> held;
      for (const Row& row : table(n)) {
        if (row.address == 0x00) continue;
        const auto data = static_cast<std::uint32_t>(random.next());
        bench.write(row.address, ~data);
        const std::uint32_t before = bench.read(row.address);
        EXPECT_EQ(before, ~data & row.writable) << row.address;
        const auto strobe = static_cast<std::uint8_t>(random.next() & 0xFU);
        EXPECT_EQ(bench.host.write(row.address, data, strobe), std::uint8_t{0});
        std::uint32_t mask = 0;
        for (unsigned byte = 0; byte < 4; ++byte) {
          if ((strobe >> byte & 1U) != 0) mask |= 0xFFU << 8U * byte;
        }
        held.push_back(((before & ~mask) | (data & mask)) & row.writable);
        EXPECT_EQ(bench.read(row.address), held.back()) << row.address;
      }
      // No register has changed another one; soft reset has changed none.
      bench.write(0x00, 0);
      std::size_t place = 0;
      for (const Row& row : table(n)) {
        if (row.address == 0x00) continue;
        EXPECT_EQ(bench.read(row.address), held[place++]) << row.address;
      }
    }
    // Behind the map there is nothing, and no access hangs.
    for (unsigned address = 0x40; address < 0x100; address += 4) {
      bench.write(static_cast<std::uint8_t>(address), 0xFFFF'FFFF);
      EXPECT_EQ(bench.read(static_cast<std::uint8_t>(address)), 0U) << address;
    }
  }
}

TEST(Axi, F2DividersOf4And1000_GiveAnEighthAndATwoThousandth) {
  AxiBench bench(axi_scenario(encoders(1)));
  std::vector<sim::Time> rises;
  const auto tap = [](sim::Time now, void* receiver, sim::ClockedLine::Signal signal, bool level) {
    auto& list = *static_cast<std::vector<sim::Time>*>(receiver);
    if (signal == sim::ClockedLine::Signal::kMa && level && (list.empty() || list.back() != now)) {
      list.push_back(now);
    }
  };
  bench.write(axireg::kAddrSampleDivider, 1000);
  bench.set_up(26, 4);
  bench.write(axireg::kAddrMode, 0);
  bench.write(axireg::kAddrChannelEnable, 0);
  std::vector<sim::Time> samples;
  bool before = bench.pin("sample_clk_output");
  bench.simulator.run_while_waiting(
      [&] {
        const bool now = bench.pin("sample_clk_output");
        if (now && !before) samples.push_back(bench.simulator.now());
        before = now;
        return samples.size() == 3;
      },
      bench.simulator.now() + 100 * sim::kPsPerUs);
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_EQ(samples[1] - samples[0], 2000 * bench.period);
  EXPECT_EQ(samples[2] - samples[1], 2000 * bench.period);
  bench.write(axireg::kAddrMode, 1);
  bench.write(axireg::kAddrChannelEnable, 1);
  clocked(bench.simulator.line(1))->set_tap(tap, &rises);
  ASSERT_TRUE(bench.frame());
  // 5 edges, 26 + 2 + 6 bits (protocol: latch, acknowledge, start, CDS, end).
  ASSERT_EQ(rises.size(), 39U);
  for (std::size_t i = 1; i < rises.size(); ++i) {
    EXPECT_EQ(rises[i] - rises[i - 1], 8 * bench.period) << i;
  }
}

// 3.9: 0 acts as 1 and as 32 bits; more than 32 as 32.
TEST(Axi, ZeroInDividersAndBits_ActsAsOneAndAs32) {
  for (const unsigned bits : {0U, 33U, 255U}) {
    AxiBench bench(axi_scenario({{.bits = 32}}, 20'000'000));
    bench.set_up(bits, 0);
    EXPECT_EQ(bench.read(axireg::kAddrMaDivider), 0U);
    bench.simulator.slave(1)->set_data(raw_word(0x9234'5679));
    const auto beat = bench.frame();
    ASSERT_TRUE(beat);
    EXPECT_EQ(beat->words[0], 0x9234'5679U);
    EXPECT_EQ(ma_check(bench.simulator.line_end(1)).shortest(), bench.period);
  }
  AxiBench bench(axi_scenario({{}}, 20'000'000));
  sim::Time rise[2] = {};
  unsigned count = 0;
  bool before = bench.pin("sample_clk_output");
  bench.simulator.run_while_waiting(
      [&] {
        const bool now = bench.pin("sample_clk_output");
        if (now && !before) rise[count++] = bench.simulator.now();
        before = now;
        return count == 2;
      },
      bench.simulator.now() + sim::kPsPerUs);
  EXPECT_EQ(rise[1] - rise[0], 2 * bench.period);
}

TEST(AxiScenario, WhatTheMasterDoesNotHave_IsRefusedByKey) {
  const auto error = [](const std::string& text) -> std::string {
    try {
      sim::parse_scenario(text, "test.toml");
    } catch (const sim::ScenarioError& failure) {
      return failure.what();
    }
    return "";
  };
  const std::string master = "[master]\ntype = \"axi\"\n";
  const std::string slave = "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n";
  const std::string channel = "[[channel]]\nnumber = 1\n";
  EXPECT_EQ(error(master + channel + slave), "");
  EXPECT_NE(error(master + channel + slave + slave).find("more than 1 slave on a channel"),
            std::string::npos);
  EXPECT_NE(error(master + "[[channel]]\nnumber = 17\n").find("key 'number'"), std::string::npos);
  EXPECT_NE(error(master + "[host]\ninterface = \"wb\"\n").find("axi"), std::string::npos);
  const std::string spi = "[host]\ninterface = \"spi\"\n";
  EXPECT_EQ(error(master + spi + channel + slave), "");
  EXPECT_NE(error(master + "[chip]\nf_clk_hz = 48_000_000\n" + spi + "sclk_hz = 12_000_001\n")
                .find("key 'sclk_hz'"),
            std::string::npos);
  EXPECT_NE(error(master + "[host]\nsclk_hz = 1_000_000\n").find("sclk_hz"), std::string::npos);
  EXPECT_NE(error(master + "[host]\nma_hz = 3_000_000\n").find("key 'ma_hz'"), std::string::npos);
  EXPECT_NE(error(master + "[chip.quirks]\nREVISION = 0x20\n").find("key 'REVISION'"),
            std::string::npos);
}

// A channel that ends early waits for the slow one. Disabled and enabled again in this time, it has
// no word of this frame: its position is 0, so it must not be good.
TEST(Axi, ChannelDisabledBeforeTheOthersEnd_IsNotGood) {
  for (const bool disabled : {false, true}) {
    AxiBench bench(axi_scenario({{}, {.slave = "busy_periods = 400\n"}}));
    bench.simulator.slave(1)->set_data(raw_word(0x1234567));
    bench.simulator.slave(2)->set_data(raw_word(0x2345678));
    bench.set_up(26, 5);  // MA = 10 MHz
    ASSERT_TRUE(bench.frame(200 * sim::kPsPerUs));
    bench.request();
    bench.simulator.advance(20 * sim::kPsPerUs);  // channel 1 has ended, channel 2 is busy
    ASSERT_EQ(bench.host.beats_waiting(), 0U);
    if (disabled) {
      bench.write(axireg::kAddrChannelEnable, 2);
      bench.write(axireg::kAddrChannelEnable, 3);
    }
    bench.simulator.advance(200 * sim::kPsPerUs);
    ASSERT_EQ(bench.host.beats_waiting(), 1U);
    const auto beat = bench.host.next_beat();
    EXPECT_EQ(beat->user, disabled ? 2U : 3U);
    EXPECT_EQ(beat->words[0], disabled ? 0U : 0x1234567U);
    EXPECT_EQ(beat->words[1], 0x2345678U);
  }
}

}  // namespace
}  // namespace mb4test
