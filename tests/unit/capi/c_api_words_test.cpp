// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The C interface with the iC-MB4 on a bus of words. Expected values: decision 45, the table of the
// page (docs/buses.md), and the datasheet for the byte map.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "mb4_page_regs.hpp"
#include "mb4_regs.hpp"
#include "mb4sim.h"

namespace reg = mb4::regs;
namespace page = mb4::page;

namespace {

constexpr std::uint32_t kWord0 = 0x0123'4567;

struct Bus {
  const char* name;
  const char* keys;
};

class CApiWords : public testing::TestWithParam<Bus> {
 protected:
  void SetUp() override {
    const std::string scenario = std::string("[chip]\nf_clk_hz = 20_000_000\n[host]\n") +
                                 GetParam().keys +
                                 "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = "
                                 "\"biss-c\"\ncrc = 0x43\ndata_bits = 28\ndata = 0x1234567\n";
    char error[200];
    sim = mb4sim_open(scenario.c_str(), error, sizeof error);
    ASSERT_NE(sim, nullptr) << error;
  }
  void TearDown() override { mb4sim_close(sim); }

  std::uint32_t read(std::uint32_t address) {
    std::uint32_t data = ~0U;
    EXPECT_EQ(mb4sim_axi_read(sim, address, &data), 0) << std::hex << address;
    return data;
  }
  void write(std::uint32_t address, std::uint32_t data, std::uint8_t strobe = 0xF) {
    EXPECT_EQ(mb4sim_axi_write(sim, address, data, strobe), 0) << std::hex << address;
  }
  // One BiSS C slave of 28 bits on line 1, MA at 10 MHz.
  void configure() {
    write(reg::slave_cfg_address(1), 0x0000'065BU);  // ENSCD1, 28 bits; CRC 6 bits of the table
    write(0xE4, 0x0000'4000U);                       // REGVERS: BiSS C; FREQS = 0
    write(reg::kAddrSlaveloc5, 0x0000'0D10U);        // line 1 BiSS C, line 2 unused
  }

  mb4sim* sim = nullptr;
};

TEST_P(CApiWords, ByteMapAndPage_AreReadAndWritten) {
  EXPECT_EQ(read(page::kAddrId), 0x454E'4301U);
  EXPECT_EQ(read(0xE8) >> 16, 0x8420U);  // REVISION, VERSION
  write(0x80, kWord0);
  write(0x80, 0xFFFF'FFFFU, 0x2);
  EXPECT_EQ(read(0x80), 0x0123'FF67U);
  EXPECT_EQ(read(0x200), 0U);
  EXPECT_EQ(read(0xFFC), 0U);
  std::uint32_t data = 0;
  EXPECT_EQ(mb4sim_axi_read(sim, 0x1000, &data), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_axi_read(sim, 0x101, &data), MB4SIM_ERROR_VALUE);
}

// Each start and length in three words, against the words themselves. The other bytes stay.
TEST_P(CApiWords, Bytes_ArePartsOfWords) {
  constexpr std::uint32_t kAt = 0x80;
  for (std::uint32_t first = 0; first < 12; ++first) {
    for (std::size_t n = 0; n + first <= 12; ++n) {
      for (const std::uint32_t word : {0U, 4U, 8U}) write(kAt + word, 0xE0E1E2E3U + word);
      std::array<std::uint8_t, 12> bytes{};
      for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i + 1);
      ASSERT_EQ(mb4sim_mem_write(sim, kAt + first, bytes.data(), n), 0);
      std::array<std::uint8_t, 14> back{};
      back.fill(0x77);
      ASSERT_EQ(mb4sim_mem_read(sim, kAt + first, back.data(), n), 0);
      for (std::uint32_t at = 0; at < 12; ++at) {
        const bool written = at >= first && at < first + n;
        const std::uint32_t word = at / 4 * 4;
        const std::uint32_t before = ((0xE0E1E2E3U + word) >> (8 * (at % 4))) & 0xFF;
        const std::uint32_t is = (read(kAt + word) >> (8 * (at % 4))) & 0xFF;
        EXPECT_EQ(is, written ? at - first + 1 : before) << first << " " << n << " " << at;
        EXPECT_TRUE(!written || back[at - first] == is);
      }
      EXPECT_EQ(back[n], 0x77);
    }
  }
}

TEST_P(CApiWords, BytesOutsideOfTheRange_TouchNothing) {
  std::array<std::uint8_t, 8> bytes{};
  bytes.fill(0x77);
  const std::uint64_t before = mb4sim_time_ns(sim);
  EXPECT_EQ(mb4sim_mem_read(sim, 0xFFC, bytes.data(), 5), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_mem_write(sim, 0xFFC, bytes.data(), 5), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_mem_read(sim, 0xFFFF'FFFF, bytes.data(), 8), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_mem_read(sim, 0, bytes.data(), SIZE_MAX), MB4SIM_ERROR_VALUE);
  EXPECT_EQ(mb4sim_mem_read(sim, 0, nullptr, 1), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_mem_write(nullptr, 0, bytes.data(), 1), MB4SIM_ERROR_UNKNOWN);
  EXPECT_EQ(mb4sim_mem_read(sim, 0x1000, nullptr, 0), 0);
  EXPECT_EQ(mb4sim_time_ns(sim), before);
  EXPECT_EQ(bytes[0], 0x77);
  EXPECT_EQ(mb4sim_mem_read(sim, 0xFFC, bytes.data(), 4), 0);
  EXPECT_EQ(bytes[3], 0);
  EXPECT_EQ(bytes[4], 0x77);
}

TEST_P(CApiWords, Frame_BringsWordTimeAndInterrupt) {
  configure();
  write(page::kAddrIrqEnable, page::FRAME::kMask);
  EXPECT_EQ(mb4sim_pin_read(sim, "IRQ"), 0);
  const std::uint32_t before = read(page::kAddrTimeLow);
  write(reg::kAddrInstr, reg::kInstrCdm0, 0x1);
  ASSERT_EQ(mb4sim_run_until(sim, "IRQ", 1, 20'000), 1);
  EXPECT_EQ(read(page::kAddrIrqStatus), page::FRAME::kMask);
  EXPECT_EQ(read(page::snapshot_address(1)), 0x0123'4567U);
  EXPECT_EQ(read(page::snapshot_address(1) + page::kSnapshotFlagsOffset), 1U);
  EXPECT_EQ(read(page::snapshot_address(1) + page::kSnapshotFrameOffset), 1U);
  EXPECT_GT(read(page::snapshot_address(1) + page::kSnapshotTimeLowOffset), before);
  EXPECT_LT(read(page::snapshot_address(1) + page::kSnapshotTimeLowOffset),
            read(page::kAddrTimeLow));
  write(page::kAddrIrqStatus, page::FRAME::kMask);
  EXPECT_EQ(mb4sim_pin_read(sim, "IRQ"), 0);
}

// While the core's clock stands still, what needs it is answered with an error, and the rest works.
TEST_P(CApiWords, CoreClockStandsStill_IsAnErrorAnswerInTime) {
  char error[200];
  ASSERT_EQ(mb4sim_inject(sim, "[[fault]]\nkind = \"clock-stop\"\nat_us = 0\nfor_us = 500\n", error,
                          sizeof error),
            0)
      << error;
  std::uint32_t data = 1;
  const std::uint64_t before = mb4sim_time_ns(sim);
  EXPECT_EQ(mb4sim_axi_read(sim, page::kAddrTimeLow, &data), 1);
  EXPECT_EQ(data, 0U);
  EXPECT_LT(mb4sim_time_ns(sim) - before, 110'000U);  // 1024 clocks of 10 MHz
  write(reg::slave_cfg_address(1), kWord0);
  EXPECT_EQ(read(reg::slave_cfg_address(1)), kWord0);
  mb4sim_advance_ns(sim, 500'000);
  EXPECT_GT(read(page::kAddrTimeLow), 0U);
}

TEST_P(CApiWords, ResetPin_SilencesTheBus) {
  ASSERT_EQ(mb4sim_pin_write(sim, "NRES", 0), 0);
  std::uint32_t data = 1;
  EXPECT_EQ(mb4sim_axi_read(sim, page::kAddrId, &data), MB4SIM_ERROR_SILENT);
  ASSERT_EQ(mb4sim_pin_write(sim, "NRES", 1), 0);
  mb4sim_advance_ns(sim, 5'000);
  EXPECT_EQ(read(page::kAddrId), 0x454E'4301U);
}

TEST_P(CApiWords, PinsAndCallsOfOtherHosts_AreRefused) {
  const std::uint8_t tx[2] = {};
  std::uint8_t data = 0;
  char why[100];
  EXPECT_EQ(mb4sim_spi_transfer(sim, tx, nullptr, sizeof tx), MB4SIM_ERROR_HOST);
  EXPECT_EQ(mb4sim_bus_read(sim, 0, &data), MB4SIM_ERROR_HOST);
  EXPECT_EQ(mb4sim_trace_start(sim, "words.fst"), MB4SIM_ERROR_TRACE);
  EXPECT_EQ(mb4sim_last_error(sim, why, sizeof why), MB4SIM_ERROR_TRACE);
  EXPECT_EQ(mb4sim_pin_write(sim, "GETSENS", 1), 0);
  EXPECT_EQ(mb4sim_pin_read(sim, "GETSENS"), 1);
  EXPECT_EQ(mb4sim_pin_read(sim, "NCS"), 0);
  EXPECT_EQ(mb4sim_pin_read(sim, "CLKENI"), 0);
  write(reg::kAddrInstr, 0x0100U, 0x2);  // CLKENI: only the pin
  EXPECT_EQ(mb4sim_pin_read(sim, "CLKENI"), 1);
  EXPECT_EQ(mb4sim_pin_write(sim, "NER", 0), 0);
  mb4sim_advance_ns(sim, 1'000);
  EXPECT_EQ(read(page::kAddrIrqStatus) & page::ERROR::kMask, page::ERROR::kMask);
}

INSTANTIATE_TEST_SUITE_P(Buses, CApiWords,
                         testing::Values(Bus{"Axi", "interface = \"axi\"\n"},
                                         Bus{"Wb", "interface = \"wb\"\nbus_hz = 100_000_000\n"},
                                         Bus{"SlowAxi",
                                             "interface = \"axi\"\nbus_hz = 10_000_000\n"}),
                         [](const auto& bus) { return bus.param.name; });

}  // namespace
