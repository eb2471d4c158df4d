// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The C interface with a master on AXI, through the shared library.
#include <gtest/gtest.h>

#include <cstdint>

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

}  // namespace
