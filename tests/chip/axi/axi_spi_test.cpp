// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_spi: the driver over words on SPI, encoders behind cables (docs/axi.md, "biss_spi").
#include <cstdint>
#include <string>
#include <vector>

#include "biss_spi.h"
#include "tests/chip/axi/axi_spi_bench.hpp"

namespace mb4test {
namespace {

// Four channels, an eighth and a quarter of the clock, both modes of SPI.
TEST(AxiSpi, Driver_ReadsEachChannel) {
  for (const std::uint64_t clk : {100'000'000U, 48'000'000U}) {
    for (const unsigned part : {8U, 4U}) {
      std::vector<AxiEncoder> encoders;
      for (unsigned c = 0; c < 4; ++c) {
        encoders.push_back({.delay_ns = 70.0 * c,
                            .slave = "data = " + std::to_string(raw_word(0x12345 + c)) + "\n"});
      }
      SpiBench bench(behind_spi(encoders, clk, clk / part));
      bench.simulator.spi().set_mode({part == 4, part == 4});
      bench.simulator.advance(sim::kPsPerUs);  // SCLK rests before NCS falls
      EXPECT_TRUE(bench.port.clear());
      biss_axi::Config config;
      config.f_clk_hz = static_cast<std::uint32_t>(clk);
      config.ma_hz = static_cast<std::uint32_t>(clk / 12);
      config.channels = 0xF;
      if (clk / 12 * 12 != clk) config.ma_hz = static_cast<std::uint32_t>(clk / 10);
      ASSERT_TRUE(bench.device.configure(config).ok());
      const auto good = bench.device.read_all();
      ASSERT_TRUE(good.ok());
      EXPECT_EQ(*good, 0xFU);
      for (unsigned c = 0; c < 4; ++c) {
        const auto position = bench.device.position(c);
        ASSERT_TRUE(position.ok()) << c;
        EXPECT_EQ(*position, 0x12345U + c);
      }
      EXPECT_FALSE(bench.port.was_void());
      EXPECT_FALSE(bench.port.was_late());
    }
  }
}

TEST(AxiSpi, Reset_IsToldByTheAnswer) {
  SpiBench bench(behind_spi({{}}, 100'000'000, 10'000'000));
  std::uint32_t value = 0;
  EXPECT_TRUE(bench.port.read(axireg::kAddrMaDivider, value));
  EXPECT_TRUE(bench.port.was_void());
  EXPECT_TRUE(bench.port.clear());
  EXPECT_TRUE(bench.port.write(axireg::kAddrMaDivider, 7));
  EXPECT_TRUE(bench.port.read(axireg::kAddrMaDivider, value));
  EXPECT_EQ(value, 7U);
  EXPECT_FALSE(bench.port.was_void());
}

int c_transfer(void* context, const std::uint8_t* tx, std::uint8_t* rx, std::uint8_t size) {
  static_cast<sim::SpiHost*>(context)->transfer({tx, size}, {rx, size});
  return 0;
}

// The C99 read path: positions, an encoder that sends nE = 0, a line without an encoder, a request
// in the timeout.
TEST(AxiSpi, C99Calls_ReadEachChannel) {
  SpiBench bench(behind_spi({{.slave = "data = " + std::to_string(raw_word(0x2A5A5A5)) + "\n"},
                             {.slave = "data = " + std::to_string(0x155U << 2U | 1U) + "\n"},
                             {}},
                            48'000'000, 6'000'000));
  bench.simulator.inject(
      "[[channel]]\nnumber = 3\n[[channel.event]]\nat_us = 0\naction = \"unplug\"\n");
  biss_spi master{c_transfer, &bench.simulator.spi(), 0};
  biss_spi_reading reading{};
  EXPECT_EQ(biss_spi_configure(&master, 0x10, 12, 26), int{BISS_SPI_ARGUMENT});
  ASSERT_EQ(biss_spi_configure(&master, 7, 12, 26), int{BISS_SPI_OK});
  EXPECT_EQ(biss_spi_position(&master, 0, &reading), int{BISS_SPI_NO_DATA});
  ASSERT_EQ(biss_spi_request(&master), int{BISS_SPI_OK});
  bench.simulator.advance(100 * sim::kPsPerUs);
  EXPECT_EQ(biss_spi_position(&master, 0, &reading), int{BISS_SPI_OK});
  EXPECT_EQ(reading.position, 0x2A5A5A5U);
  EXPECT_FALSE(reading.slave_error || reading.slave_warning);
  EXPECT_EQ(biss_spi_position(&master, 1, &reading), int{BISS_SPI_SLAVE_ERROR});
  EXPECT_EQ(reading.position, 0x155U);
  EXPECT_TRUE(reading.slave_error);
  EXPECT_FALSE(reading.slave_warning);
  EXPECT_EQ(biss_spi_position(&master, 2, &reading), int{BISS_SPI_NO_DATA});
  EXPECT_EQ(reading.position, 0U);
  // A reset is told, and nothing of before comes.
  EXPECT_EQ(master.answer & BISS_SPI_VOID, 0U);
  bench.simulator.set_pin(*bench.simulator.pin_by_name("axi_aresetn"), false);
  bench.simulator.advance(sim::kPsPerUs);
  bench.simulator.set_pin(*bench.simulator.pin_by_name("axi_aresetn"), true);
  bench.simulator.advance(200 * sim::kPsPerUs);
  EXPECT_EQ(biss_spi_position(&master, 0, &reading), int{BISS_SPI_NO_DATA});
  EXPECT_NE(master.answer & BISS_SPI_VOID, 0U);
}

// The line is pulled off: no number comes, and none of before.
TEST(AxiSpi, UnpluggedLine_GivesNoNumber) {
  SpiBench bench(behind_spi({{.slave = "data = " + std::to_string(raw_word(77)) + "\n"}},
                            100'000'000, 10'000'000, "full"));
  ASSERT_TRUE(bench.device.configure({}).ok());
  ASSERT_TRUE(bench.device.read_all().ok());
  auto last = bench.page.last(0);
  ASSERT_TRUE(last.ok());
  EXPECT_TRUE(last->good);
  EXPECT_EQ(last->position, 77U);
  const std::uint16_t number = last->number;
  bench.simulator.inject(
      "[[channel]]\nnumber = 1\n[[channel.event]]\nat_us = 0\naction = \"unplug\"\n");
  const auto good = bench.device.read_all();
  ASSERT_TRUE(good.ok());
  EXPECT_EQ(*good, 0U);
  EXPECT_FALSE(bench.device.position(0).ok());
  last = bench.page.last(0);
  ASSERT_TRUE(last.ok());
  EXPECT_FALSE(last->good);
  EXPECT_TRUE(last->slave_error);
  EXPECT_EQ(last->position, 0U);
  EXPECT_EQ(static_cast<std::uint16_t>(last->number - number), 1U);
}

}  // namespace
}  // namespace mb4test
