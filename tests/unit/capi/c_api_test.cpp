// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The C interface through the shared library.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "mb4_regs.hpp"
#include "mb4sim.h"

namespace {

namespace reg = mb4::regs;

constexpr const char* kScenario = R"(
[[channel]]
number = 1
[[channel.slave]]
protocol = "biss-c"
preset = "resolute-26"
data = 0x2ABCDEF
registers = { 0x44 = [0x00, 0xD9] }
)";

class CApi : public testing::Test {
 protected:
  void SetUp() override {
    sim = mb4sim_open(kScenario, error, sizeof error);
    ASSERT_NE(sim, nullptr) << error;
  }
  void TearDown() override { mb4sim_close(sim); }

  char error[200] = "untouched";
  mb4sim* sim = nullptr;
};

TEST_F(CApi, OpenedFromText_HasEmptyErrorAndRunningTime) {
  EXPECT_STREQ(error, "");
  EXPECT_EQ(mb4sim_time_ns(sim), 1000U);
  mb4sim_advance_ns(sim, 500);
  EXPECT_EQ(mb4sim_time_ns(sim), 1500U);
  EXPECT_EQ(mb4sim_clk_cycles(sim), 30U);  // 20 MHz
}

TEST_F(CApi, Transfer_TakesItsRealTime) {
  const uint8_t tx[4] = {reg::kSpiOpcodeReadRegisters, reg::kAddrRevision, 0, 0};
  uint8_t rx[4] = {};
  const uint64_t before = mb4sim_time_ns(sim);
  EXPECT_EQ(mb4sim_spi_transfer(sim, tx, rx, 4), 0);
  // 32 bits of 100 ns, one high phase of 100 instead of 50 ns (I204), hold of NCS 50 ns.
  EXPECT_EQ(mb4sim_time_ns(sim) - before, 3200U + 50 + 50);
  EXPECT_EQ(rx[2], reg::kRevisionY);
  EXPECT_EQ(rx[3], reg::kVersionIcMb4);
}

TEST_F(CApi, ByteByByte_ReadsTheSame) {
  mb4sim_spi_select(sim, 1);
  mb4sim_spi_byte(sim, reg::kSpiOpcodeReadRegisters);
  mb4sim_spi_byte(sim, reg::kAddrVersion);
  EXPECT_EQ(mb4sim_spi_byte(sim, 0), reg::kVersionIcMb4);
  mb4sim_spi_select(sim, 0);
  EXPECT_EQ(mb4sim_pin_read(sim, "NCS"), 1);
}

TEST_F(CApi, TransferWhileSelected_ContinuesThatFrameAndEndsIt) {
  mb4sim_spi_select(sim, 1);
  mb4sim_spi_byte(sim, reg::kSpiOpcodeReadRegisters);
  const uint8_t tx[3] = {reg::kAddrRevision, 0, 0};
  uint8_t rx[3] = {};
  EXPECT_EQ(mb4sim_spi_transfer(sim, tx, rx, 3), 0);
  EXPECT_EQ(rx[1], reg::kRevisionY);
  EXPECT_EQ(rx[2], reg::kVersionIcMb4);
  EXPECT_EQ(mb4sim_pin_read(sim, "NCS"), 1);
}

TEST_F(CApi, Clk_ShowsItsPresentLevel) {
  // 20 MHz: rising edges at 25 ns + n * 50 ns, falling ones at n * 50 ns.
  EXPECT_EQ(mb4sim_pin_read(sim, "CLK"), 0);
  mb4sim_advance_ns(sim, 25);
  EXPECT_EQ(mb4sim_pin_read(sim, "CLK"), 1);
  mb4sim_advance_ns(sim, 24);
  EXPECT_EQ(mb4sim_pin_read(sim, "CLK"), 1);
  mb4sim_advance_ns(sim, 1);
  EXPECT_EQ(mb4sim_pin_read(sim, "CLK"), 0);
}

TEST_F(CApi, NullRx_IsAllowed) {
  const uint8_t tx[3] = {reg::kSpiOpcodeWriteRegisters, reg::kAddrFreq, reg::FREQR::of(5)};
  EXPECT_EQ(mb4sim_spi_transfer(sim, tx, nullptr, 3), 0);
}

TEST_F(CApi, Pins_HaveDatasheetNames) {
  for (const char* pin :
       {"NCS", "ALE", "NRD_RNW", "NWR_E", "DB0", "DB7", "CFGSPI", "INT_NMOT", "NRES", "CLK",
        "GETSENS", "NER", "EOT", "MA1", "MA2_NMA1", "MO1", "MO2_NMO1", "SL1", "SL2_NSL1"}) {
    EXPECT_GE(mb4sim_pin_read(sim, pin), 0) << pin;
  }
  EXPECT_EQ(mb4sim_pin_read(sim, "MA3"), -1);
  EXPECT_EQ(mb4sim_pin_write(sim, "MA3", 1), -1);
  EXPECT_EQ(mb4sim_pin_read(sim, nullptr), -1);
}

TEST_F(CApi, WrittenInput_ReadsBack) {
  EXPECT_EQ(mb4sim_pin_write(sim, "GETSENS", 1), 0);
  EXPECT_EQ(mb4sim_pin_read(sim, "GETSENS"), 1);
  EXPECT_EQ(mb4sim_pin_write(sim, "GETSENS", 2), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_pin_write(sim, "EOT", 1), MB4SIM_ERROR_DRIVEN);
  EXPECT_EQ(mb4sim_pin_write(sim, "SL1", 1), MB4SIM_ERROR_DRIVEN);
}

TEST_F(CApi, Slave_HasDataRegistersAndFrames) {
  uint8_t value = 0;
  EXPECT_EQ(mb4sim_slave_reg_read(sim, 1, 0x45, &value), 0);
  EXPECT_EQ(value, 0xD9);
  EXPECT_EQ(mb4sim_slave_reg_write(sim, 1, 0x7F, 0x5A), 0);
  EXPECT_EQ(mb4sim_slave_reg_read(sim, 1, 0x7F, &value), 0);
  EXPECT_EQ(value, 0x5A);
  EXPECT_EQ(mb4sim_slave_set_data(sim, 1, 0xFFFFFFF), 0);
  EXPECT_EQ(mb4sim_slave_set_data(sim, 1, 0x10000000), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_slave_frames(sim, 1), 0U);
  for (const unsigned missing : {0U, 2U, 5U, 9U}) {
    EXPECT_EQ(mb4sim_slave_set_data(sim, missing, 0), MB4SIM_ERROR_UNKNOWN);
    EXPECT_EQ(mb4sim_slave_reg_read(sim, missing, 0, &value), MB4SIM_ERROR_UNKNOWN);
    EXPECT_EQ(mb4sim_slave_frames(sim, missing), 0U);
  }
}

TEST_F(CApi, SetData_IsReadByTheChip) {
  const auto send = [&](std::initializer_list<uint8_t> bytes) {
    EXPECT_EQ(mb4sim_spi_transfer(sim, bytes.begin(), nullptr, bytes.size()), 0);
  };
  send({reg::kSpiOpcodeWriteRegisters, reg::slave_cfg_address(1), reg::kEnscdYes | 27,
        reg::kScrclenCrc6, 0, 0});
  send({reg::kSpiOpcodeWriteRegisters, reg::kAddrCtrl, reg::kRegversBissC, reg::FREQR::of(5), 0,
        reg::kFreqagsAgsMin});
  send({reg::kSpiOpcodeWriteRegisters, reg::kAddrCfgch, reg::kCfgch1BissC | reg::kCfgch2Unused});
  mb4sim_slave_set_data(sim, 1, 0x1234567);
  send({reg::kSpiOpcodeWriteInstruction, reg::kInstrCdm0});
  mb4sim_advance_ns(sim, 20'000);
  const uint8_t tx[5] = {reg::kSpiOpcodeReadRegisters0, 0, 0, 0, 0};
  uint8_t rx[5] = {};
  EXPECT_EQ(mb4sim_spi_transfer(sim, tx, rx, 5), 0);
  EXPECT_EQ(rx[1], 0x67);
  EXPECT_EQ(rx[2], 0x45);
  EXPECT_EQ(rx[3], 0x23);
  EXPECT_EQ(rx[4], 0x01);
  EXPECT_EQ(mb4sim_slave_frames(sim, 1), 1U);
}

TEST(CApiOpen, BadText_ReturnsNullAndOneLine) {
  char error[200];
  EXPECT_EQ(mb4sim_open("[chip]\nclock = 1\n", error, sizeof error), nullptr);
  EXPECT_STREQ(error,
               "scenario:2:1: key 'clock': unknown key, known here: f_clk_hz, f_osc_hz, features, "
               "[chip.quirks] (in [chip])");
}

TEST(CApiOpen, ShortBuffer_IsCutAndTerminated) {
  char error[10];
  std::memset(error, 'x', sizeof error);
  EXPECT_EQ(mb4sim_open("[chip]\nclock = 1\n", error, sizeof error), nullptr);
  EXPECT_STREQ(error, "scenario:");
  EXPECT_EQ(mb4sim_open("[chip]\nclock = 1\n", nullptr, 0), nullptr);
  EXPECT_EQ(mb4sim_open(nullptr, error, sizeof error), nullptr);
}

// BiSS B and SSI behind the same calls.
TEST(CApiOpen, OtherProtocols_HaveDataAndRegisters) {
  char error[200];
  mb4sim* sim = mb4sim_open(
      "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-b\"\ndata_bits = 12\n"
      "registers = { 0x44 = 0x5A }\n[[channel]]\nnumber = 2\n[[channel.slave]]\n"
      "protocol = \"ssi\"\ndata_bits = 25\ngray = true\n",
      error, sizeof error);
  ASSERT_NE(sim, nullptr) << error;
  uint8_t value = 0;
  EXPECT_EQ(mb4sim_slave_reg_read(sim, 1, 0x44, &value), 0);
  EXPECT_EQ(value, 0x5A);
  EXPECT_EQ(mb4sim_slave_set_data(sim, 1, 0xFFF), 0);
  EXPECT_EQ(mb4sim_slave_set_data(sim, 1, 0x1000), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_slave_set_data(sim, 5, 0x1FFFFFF), 0);
  EXPECT_EQ(mb4sim_slave_set_data(sim, 5, 0x2000000), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_slave_frames(sim, 5), 0U);
  mb4sim_close(sim);
}

TEST(CApiOpen, File_FindsItsEdgeFileBesideIt) {
  char error[200];
  mb4sim* sim = mb4sim_open_file(MB4_EXAMPLES "/ti-tidm-1010.toml", error, sizeof error);
  ASSERT_NE(sim, nullptr) << error;
  EXPECT_EQ(mb4sim_slave_set_data(sim, 1, 0), MB4SIM_ERROR_VALUE);  // a recording has no data
  mb4sim_close(sim);
  EXPECT_EQ(mb4sim_open_file("/no/such.toml", error, sizeof error), nullptr);
  EXPECT_STREQ(error, "/no/such.toml: cannot read: No such file or directory");
}

TEST(CApiOpen, NullHandle_IsHarmless) {
  const uint8_t tx[1] = {0};
  mb4sim_close(nullptr);
  mb4sim_advance_ns(nullptr, 1);
  EXPECT_EQ(mb4sim_spi_transfer(nullptr, tx, nullptr, 1), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_time_ns(nullptr), 0U);
  EXPECT_EQ(mb4sim_pin_read(nullptr, "EOT"), MB4SIM_ERROR_UNKNOWN);
}

TEST(CApiOpen, LongestAdvance_EndsAtTheEndOfTime) {
  mb4sim* sim = mb4sim_open("[chip]\nf_clk_hz = 0\n", nullptr, 0);
  ASSERT_NE(sim, nullptr);
  constexpr uint64_t kEndNs = (uint64_t{1} << 63) / 1000;
  mb4sim_advance_ns(sim, UINT64_MAX);
  EXPECT_EQ(mb4sim_time_ns(sim), kEndNs);
  mb4sim_advance_ns(sim, UINT64_MAX / 1000);
  EXPECT_EQ(mb4sim_time_ns(sim), kEndNs);
  mb4sim_close(sim);
}

TEST(CApiOpen, ControlCharacters_AreEscaped) {
  char error[200];
  EXPECT_EQ(mb4sim_open("\"a\\n\" = 1\n", error, sizeof error), nullptr);
  EXPECT_STREQ(error,
               "scenario:1:1: key 'a\\n': unknown key, known here: [[channel]], [chip], [[fault]], "
               "[host], [master], [sim]");
}

TEST(CApiOpen, Version_HasThreeNumbers) {
  unsigned major = 0;
  unsigned minor = 0;
  unsigned patch = 0;
  EXPECT_EQ(std::sscanf(mb4sim_version(), "%u.%u.%u", &major, &minor, &patch), 3);
}

}  // namespace
