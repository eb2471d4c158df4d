// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The C interface with a master on AXI, through the shared library.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "axi_regs.hpp"
#include "mb4sim.h"

namespace reg = biss_axi::regs;

namespace {

constexpr const char* kScenario = R"(
[master]
type = "axi"
[chip]
f_clk_hz = 100_000_000
[[channel]]
number = 1
delay_ns = 35
[[channel.slave]]
protocol = "biss-c"
crc = 0x43
data_bits = 28
data = 0x1234567
)";

class CApiAxi : public testing::Test {
 protected:
  void SetUp() override {
    char error[200];
    sim = mb4sim_open(kScenario, error, sizeof error);
    ASSERT_NE(sim, nullptr) << error;
    mb4sim_advance_ns(sim, 41'000);  // a reset holds starts back
  }
  void TearDown() override { mb4sim_close(sim); }

  mb4sim* sim = nullptr;
};

TEST_F(CApiAxi, CallsOfOtherHosts_AreRefusedAndTheHandleLivesOn) {
  const uint8_t tx[2] = {};
  uint8_t data = 0;
  char why[100];
  EXPECT_EQ(mb4sim_spi_transfer(sim, tx, nullptr, sizeof tx), MB4SIM_ERROR_HOST);
  mb4sim_spi_select(sim, 1);
  EXPECT_EQ(mb4sim_last_error(sim, why, sizeof why), MB4SIM_ERROR_HOST);
  EXPECT_STREQ(why, "the scenario's host has another interface");
  EXPECT_EQ(mb4sim_spi_byte(sim, 0), 0);
  EXPECT_EQ(mb4sim_last_error(sim, nullptr, 0), MB4SIM_ERROR_HOST);
  EXPECT_EQ(mb4sim_bus_read(sim, 0, &data), MB4SIM_ERROR_HOST);
  EXPECT_EQ(mb4sim_bus_write(sim, 0, 0), MB4SIM_ERROR_HOST);
  const uint64_t before = mb4sim_time_ns(sim);
  mb4sim_advance_ns(sim, 1000);
  EXPECT_EQ(mb4sim_last_error(sim, nullptr, 0), 0);
  EXPECT_EQ(mb4sim_time_ns(sim), before + 1000);
  EXPECT_EQ(mb4sim_slave_set_data(sim, 1, 7), 0);
}

// The pins of this master have names of their own.
TEST_F(CApiAxi, OnEdge_TellsTheLevelsOfTheLines) {
  const struct {
    uint32_t address, value;
  } steps[] = {{reg::kAddrMode, 1},     {reg::kAddrMaDivider, 5},     {reg::kAddrPositionBits, 26},
               {reg::kAddrCrcCheck, 1}, {reg::kAddrChannelEnable, 1}, {reg::kAddrRequest, 1}};
  for (const auto& step : steps) EXPECT_EQ(mb4sim_axi_write(sim, step.address, step.value, 0xF), 0);
  const auto keep = [](void* context, unsigned, unsigned place, uint64_t, int level) {
    static_cast<std::vector<int>*>(context)->at(place) = level;
  };
  for (const int ma : {0, 1}) {
    ASSERT_EQ(mb4sim_run_until(sim, "ma0", ma, 20'000), 1);
    std::vector<int> levels(4, -1);
    ASSERT_EQ(mb4sim_on_edge(sim, keep, &levels), 0);
    EXPECT_EQ(levels, (std::vector<int>{ma, 0, 1, 1}));
    ASSERT_EQ(mb4sim_on_edge(sim, nullptr, nullptr), 0);
  }
}

#ifdef MB4_TRACE
TEST_F(CApiAxi, Trace_WritesAWaveformOfWhatLiesBetween) {
  const std::string path = testing::TempDir() + "c_api_axi_" + std::to_string(getpid()) + ".fst";
  char why[200];
  EXPECT_EQ(mb4sim_trace_start(sim, "/no/such/folder/axi.fst"), MB4SIM_ERROR_TRACE);
  EXPECT_EQ(mb4sim_last_error(sim, why, sizeof why), MB4SIM_ERROR_TRACE);
  EXPECT_STREQ(why, "/no/such/folder/axi.fst: cannot write the waveform");
  EXPECT_EQ(mb4sim_trace_stop(sim), MB4SIM_ERROR_TRACE);
  ASSERT_EQ(mb4sim_trace_start(sim, path.c_str()), 0);
  mb4sim_advance_ns(sim, 10'000);
  EXPECT_EQ(mb4sim_trace_stop(sim), 0);
  EXPECT_GT(std::filesystem::file_size(path), 500U);
  std::filesystem::remove(path);
}
#endif

TEST_F(CApiAxi, Registers_AreReadAndWritten) {
  uint32_t data = 1;
  EXPECT_EQ(mb4sim_axi_read(sim, reg::kAddrMaDivider, &data), 0);
  EXPECT_EQ(data, 0U);
  const uint64_t before = mb4sim_time_ns(sim);
  EXPECT_EQ(mb4sim_axi_write(sim, reg::kAddrSampleDivider, 0x0234'5678, 0xF), 0);
  EXPECT_GT(mb4sim_time_ns(sim), before);
  // The access writes only the bytes of the strobe.
  EXPECT_EQ(mb4sim_axi_write(sim, reg::kAddrSampleDivider, 0xFFFF'FFFF, 0x2), 0);
  EXPECT_EQ(mb4sim_axi_read(sim, reg::kAddrSampleDivider, &data), 0);
  EXPECT_EQ(data, 0x0234'FF78U);
  EXPECT_EQ(mb4sim_axi_read(sim, 0xFC, &data), 0);
  EXPECT_EQ(data, 0U);
}

TEST_F(CApiAxi, Frame_BringsTheWordOfTheEncoder) {
  uint32_t data = 0;
  const struct {
    uint32_t address, value;
  } steps[] = {{reg::kAddrMode, 1},     {reg::kAddrMaDivider, 5},     {reg::kAddrPositionBits, 26},
               {reg::kAddrCrcCheck, 1}, {reg::kAddrChannelEnable, 1}, {reg::kAddrRequest, 1}};
  for (const auto& step : steps) EXPECT_EQ(mb4sim_axi_write(sim, step.address, step.value, 0xF), 0);
  mb4sim_advance_ns(sim, 20'000);
  EXPECT_EQ(mb4sim_axi_read(sim, reg::kAddrSinglePointValid, &data), 0);
  EXPECT_EQ(data, 1U);
  EXPECT_EQ(mb4sim_axi_read(sim, reg::kAddrSinglePointData, &data), 0);
  EXPECT_EQ(data, 0x1234567U >> 2);  // without nE and nW
  uint64_t raw = 0;
  EXPECT_EQ(mb4sim_slave_sent(sim, 1, 1, &raw), 0);
  EXPECT_EQ(raw, 0x1234567U);
}

// A pulse at the sample clock is a frame; its word comes by the stream only.
TEST_F(CApiAxi, Stream_BringsTheFramesOfTheExternalClock) {
  const struct {
    uint32_t address, value;
  } steps[] = {{reg::kAddrMaDivider, 5}, {reg::kAddrPositionBits, 26},
               {reg::kAddrCrcCheck, 1},  {reg::kAddrSampleClock, 1},
               {reg::kAddrMode, 0},      {reg::kAddrChannelEnable, 1}};
  for (const auto& step : steps) EXPECT_EQ(mb4sim_axi_write(sim, step.address, step.value, 0xF), 0);
  uint32_t words[2] = {77, 77};
  uint32_t user = 77;
  mb4sim_advance_ns(sim, 100'000);
  while (mb4sim_stream_read(sim, nullptr, 0, nullptr) > 0) {
  }
  for (uint32_t n = 1; n <= 3; ++n) {
    EXPECT_EQ(mb4sim_slave_set_data(sim, 1, n << 2 | 3), 0);
    EXPECT_EQ(mb4sim_pin_write(sim, "ext_sample_clk", 1), 0);
    mb4sim_advance_ns(sim, 50'000);
    EXPECT_EQ(mb4sim_pin_write(sim, "ext_sample_clk", 0), 0);
    mb4sim_advance_ns(sim, 50'000);
  }
  const uint64_t now = mb4sim_time_ns(sim);
  for (uint32_t n = 1; n <= 3; ++n) {
    EXPECT_EQ(mb4sim_stream_read(sim, words, 2, &user), 1);
    EXPECT_EQ(words[0], n);
    EXPECT_EQ(words[1], 77U);
    EXPECT_EQ(user, 1U);
  }
  EXPECT_EQ(mb4sim_stream_read(sim, words, 2, &user), 0);
  EXPECT_EQ(mb4sim_time_ns(sim), now);
  EXPECT_EQ(mb4sim_stream_read(sim, nullptr, 1, &user), MB4SIM_ERROR_UNKNOWN);
  mb4sim* const chip = mb4sim_open("", nullptr, 0);
  ASSERT_NE(chip, nullptr);
  EXPECT_EQ(mb4sim_stream_read(chip, words, 2, &user), MB4SIM_ERROR_HOST);
  mb4sim_close(chip);
}

TEST_F(CApiAxi, WrongAccesses_AreToldAndChangeNothing) {
  uint32_t data = 77;
  const uint64_t before = mb4sim_time_ns(sim);
  for (const uint32_t address : {1U, 2U, 0x3EU, 0x100U, 0xFFFF'FFFCU}) {
    EXPECT_EQ(mb4sim_axi_read(sim, address, &data), MB4SIM_ERROR_VALUE);
    EXPECT_EQ(mb4sim_axi_write(sim, address, 0, 0xF), MB4SIM_ERROR_VALUE);
  }
  EXPECT_EQ(mb4sim_axi_write(sim, 0, 0, 0x10), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_axi_read(sim, 0, nullptr), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_axi_read(nullptr, 0, &data), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_axi_write(nullptr, 0, 0, 0xF), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(data, 77U);
  EXPECT_EQ(mb4sim_time_ns(sim), before);
  mb4sim* const chip = mb4sim_open("", nullptr, 0);
  ASSERT_NE(chip, nullptr);
  EXPECT_EQ(mb4sim_axi_read(chip, 0, &data), MB4SIM_ERROR_HOST);
  EXPECT_EQ(mb4sim_axi_write(chip, 0, 0, 0xF), MB4SIM_ERROR_HOST);
  mb4sim_close(chip);
}

// No access stops the model, and a late answer is not taken for that of the next access.
TEST_F(CApiAxi, ClockOrResetThatStopsTheBus_IsSilenceAndLeavesNothingBehind) {
  uint32_t data = 77;
  EXPECT_EQ(mb4sim_axi_write(sim, reg::kAddrPositionBits, 26, 0xF), 0);
  EXPECT_EQ(mb4sim_axi_write(sim, reg::kAddrMaDivider, 5, 0xF), 0);
  mb4sim_pin_write(sim, "axi_aresetn", 0);
  EXPECT_EQ(mb4sim_axi_read(sim, reg::kAddrMaDivider, &data), MB4SIM_ERROR_SILENT);
  EXPECT_EQ(data, 77U);
  mb4sim_pin_write(sim, "axi_aresetn", 1);
  EXPECT_EQ(mb4sim_axi_read(sim, reg::kAddrMaDivider, &data), 0);
  EXPECT_EQ(data, 0U);
  EXPECT_EQ(mb4sim_axi_write(sim, reg::kAddrPositionBits, 26, 0xF), 0);
  EXPECT_EQ(mb4sim_axi_write(sim, reg::kAddrMaDivider, 5, 0xF), 0);
  // The clock stops 1 us after each injection, which is somewhere in an access, and comes back in
  // the next one.
  for (int at_ns = 1000; at_ns < 1120; at_ns += 10) {
    const std::string fault =
        "[[fault]]\nkind = \"clock-stop\"\nat_us = " + std::to_string(at_ns / 1000) + "." +
        std::to_string(1000 + at_ns % 1000).substr(1) + "\nfor_us = 15\n";
    char error[200];
    ASSERT_EQ(mb4sim_inject(sim, fault.c_str(), error, sizeof error), 0) << error;
    mb4sim_advance_ns(sim, 1000);
    int silent = 0;
    while (silent == 0) silent = mb4sim_axi_read(sim, reg::kAddrPositionBits, &data);
    ASSERT_EQ(silent, MB4SIM_ERROR_SILENT);
    EXPECT_EQ(mb4sim_axi_read(sim, reg::kAddrMaDivider, &data), 0);
    EXPECT_EQ(data, 5U) << at_ns;
    EXPECT_EQ(mb4sim_axi_read(sim, reg::kAddrPositionBits, &data), 0);
    EXPECT_EQ(data, 26U) << at_ns;
  }
}

}  // namespace
