// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The page alone, with five channels and all extras: the common words (regmap/axi.rdl), what
// configures extras, and the time of the sampling instant.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vaxi_page.h"
#include "axi_regs.hpp"
#include "tests/block/axi/axi_bus.hpp"
#include "tests/support/model_context.hpp"
// This project does not write Verilator's own header, so its warnings do not count.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include "Vaxi_page___024root.h"
#pragma GCC diagnostic pop

namespace {

namespace reg = biss_axi::regs;

class AxiPageBlock : public testing::Test {
 protected:
  AxiPageBlock() {
    m.clear_i = m.start_i = m.skip_i = m.done_i = m.bad_i = m.alarm_i = m.access_end_i = 0;
    m.sense_i = m.overrun_i = m.tick_i = m.half_next_i = 0;
    m.bus_i = 0;
    m.switches_i = 0xA;
    block.clock();
    m.rst_ni = 1;
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }
  void clock() {
    block.clock();
    ++now;
  }
  std::uint32_t read(unsigned address) {
    ++now;
    return mb4test::read_page(block, address);
  }
  void write(unsigned address, std::uint32_t data) {
    ++now;
    mb4test::write_page(block, address, data);
  }
  // Both words of a time, with other words read and a clock more or less between them.
  std::uint64_t read_time(unsigned low_address, unsigned high_address) {
    const std::uint64_t low = read(low_address);
    clocks(dice.below(8));
    read(reg::kAddrId);
    return low | std::uint64_t{read(high_address)} << 32U;
  }
  template <typename Port>
  void pulse(Port& port) {
    port = 1;
    clock();
    port = 0;
  }
  // What has come since the last call. An event crosses enc_irq in a few clocks.
  unsigned events() {
    clocks(12);
    const unsigned status = read(reg::kAddrIrqStatus);
    write(reg::kAddrIrqStatus, status);
    return status;
  }
  mb4test::Dice dice;
  mb4test::Block<Vaxi_page> block;
  Vaxi_page& m = block.model;
  std::uint64_t now = 0;
};

TEST_F(AxiPageBlock, Identity_IsThatOfTheCommonPage) {
  EXPECT_EQ(read(reg::kAddrId), 0x454E'4302U);
  EXPECT_EQ(read(reg::kAddrVersion), reg::kResetVersion);
  EXPECT_EQ(read(reg::kAddrFeatures), 5U << 16U | 1U << 13U | 0xAU << 9U | 0x1FFU);
}

TEST_F(AxiPageBlock, EachEvent_SetsItsBit) {
  EXPECT_EQ(events(), 0U);
  pulse(m.done_i);
  EXPECT_EQ(events(), 1U);
  m.bad_i = 1;
  clocks(5);
  EXPECT_EQ(events(), 0U) << "bad counts with done only";
  pulse(m.done_i);
  EXPECT_EQ(events(), 3U);
  m.bad_i = 0;
  pulse(m.alarm_i);
  EXPECT_EQ(events(), 2U);
  pulse(m.access_end_i);
  EXPECT_EQ(events(), 4U);
  pulse(m.sense_i);
  EXPECT_EQ(events(), 8U);
  pulse(m.skip_i);
  EXPECT_EQ(events(), 16U);
  pulse(m.overrun_i);
  EXPECT_EQ(events(), 16U);
  pulse(m.done_i);
  clocks(12);
  pulse(m.done_i);
  EXPECT_EQ(events(), 17U) << "the frame before has not been taken";
  write(reg::kAddrIrqEnable, 0x2);
  pulse(m.done_i);
  clocks(12);
  EXPECT_EQ(m.irq_o, 0);
  pulse(m.alarm_i);
  clocks(12);
  EXPECT_EQ(m.irq_o, 1);
}

TEST_F(AxiPageBlock, SkippedStartsAndLostFrames_AreKeptUntilCleared) {
  for (int i = 0; i < 70'000; ++i) pulse(m.skip_i);
  EXPECT_EQ(read(reg::kAddrSkipCount), 70'000U & 0xFFFF);
  const auto lost = [](unsigned frames, unsigned flag) { return frames << 16U | flag; };
  pulse(m.overrun_i);
  EXPECT_EQ(read(reg::kAddrStreamStatus), lost(1, 1));
  write(reg::kAddrStreamStatus, ~1U);
  EXPECT_EQ(read(reg::kAddrStreamStatus), lost(1, 1));
  write(reg::kAddrStreamStatus, 1);
  EXPECT_EQ(read(reg::kAddrStreamStatus), lost(1, 0));
  // A frame that is lost while the host clears is not forgotten.
  m.overrun_i = 1;
  write(reg::kAddrStreamStatus, 1);
  m.overrun_i = 0;
  EXPECT_EQ(read(reg::kAddrStreamStatus) & 1U, 1U);
  const unsigned before = read(reg::kAddrStreamStatus) >> 16U;
  for (int i = 0; i < 70'000; ++i) pulse(m.overrun_i);
  EXPECT_EQ(read(reg::kAddrStreamStatus), lost((70'000 + before) & 0xFFFF, 1));
  pulse(m.clear_i);
  EXPECT_EQ(read(reg::kAddrStreamStatus), 0U);
  EXPECT_EQ(read(reg::kAddrSkipCount), 0U);
}

// Two falling and rising edges of MA after a start; the stamp is that of the first rising one.
TEST_F(AxiPageBlock, SampleTime_IsThatOfTheFirstRisingEdge) {
  for (int round = 0; round < 50; ++round) {
    pulse(m.start_i);
    std::uint64_t edge = 0;
    for (int half = 0; half < 6; ++half) {
      clocks(dice.below(20));
      m.half_next_i = half % 2 != 0 ? 1 : 0;
      pulse(m.tick_i);
      if (half == 1) edge = now;  // the clock in which MA is 1
    }
    clocks(dice.below(50));
    EXPECT_EQ(read(reg::kAddrSampleTimeLow), edge) << round;
    EXPECT_EQ(read(reg::kAddrSampleTimeHigh), 0U);
  }
  const std::uint64_t before = now;
  EXPECT_EQ(read(reg::kAddrTimeLow), before);
}

// Around 2^32 clocks: the high word is that of the moment at which the low one was read.
TEST_F(AxiPageBlock, TimesBeyondTheirLowWord_AreOfOneMoment) {
  for (int round = 0; round < 20; ++round) {
    m.rst_ni = 0;
    m.eval();
    m.rst_ni = 1;
    now = m.rootp->axi_page__DOT__u_time__DOT__low_q = 0xFFFF'FF80U + dice.below(16);
    clock();
    for (int i = 0; i < 20; ++i) {
      const std::uint64_t before = now;
      EXPECT_EQ(read_time(reg::kAddrTimeLow, reg::kAddrTimeHigh), before);
      pulse(m.start_i);
      m.tick_i = m.half_next_i = 1;
      clock();
      m.tick_i = m.half_next_i = 0;
      const std::uint64_t edge = now;
      clock();
      EXPECT_EQ(read_time(reg::kAddrSampleTimeLow, reg::kAddrSampleTimeHigh), edge);
    }
    EXPECT_GT(now, 0x1'0000'0000U);
  }
}

TEST_F(AxiPageBlock, Configuration_ReachesItsFields) {
  for (int round = 0; round < 100; ++round) {
    const std::uint32_t polynomial = dice.below(0x20000), start = dice.below(0x10000);
    const std::uint32_t timeout = dice.below(0x100000) | dice.below(2) << 31U;
    write(reg::kAddrCrcPolynomial, polynomial | 0xFFF00000U);
    write(reg::kAddrCrcStart, start | 0xABC00000U);
    write(reg::kAddrTimeout, timeout | 0x12300000U);
    EXPECT_EQ(read(reg::kAddrCrcPolynomial), polynomial);
    EXPECT_EQ(read(reg::kAddrCrcStart), start);
    EXPECT_EQ(read(reg::kAddrTimeout), timeout);
    namespace at = mb4test::places::axi_pkg::page_t;
    EXPECT_EQ(m.page_o, at::kCrcPolynomial(polynomial) | at::kCrcStart(start) |
                            at::kTimeoutFixed(timeout >> 31U) | at::kTimeoutLimit(timeout));
  }
}

}  // namespace
