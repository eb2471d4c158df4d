// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Sensor frames of BiSS B and the ways into register mode (datasheet pages 12, 13, 16;
// docs/choices.md, 6 and 7).
#include "sim/lines/biss/biss_b_slave.hpp"

#include <gtest/gtest.h>

#include "tests/unit/lines/biss/biss_b_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

constexpr Time kPeriod = 400 * kPsPerNs;
constexpr Time kStart = 1000 * kPsPerNs;
// The golden vector of 28 bits; its CRC6 on the line is 0x27.
constexpr std::uint64_t kWord = 0b1010101011110011011110111111;

TEST(BissBSlave, Frame_HasNoControlBit) {
  BissBBench bench;
  auto& slave = bench.add(biss_b_slave(28, kWord, 0x43));
  // #1 still idle, #2 Ack, #3 start, then data at once.
  EXPECT_EQ(bench.frame(kStart, kPeriod, 28 + 6 + 4),
            "101" + binary(kWord, 28) + binary(0x27, 6) + "0");
  EXPECT_EQ(slave.frames(), 1U);
}

TEST(BissBSlave, BusyPeriods_DelayTheStartBit) {
  BissBBench bench;
  BissBSlaveConfig config = biss_b_slave(8, 0xA5, 0);
  config.busy_periods = 3;
  bench.add(config);
  EXPECT_EQ(bench.frame(kStart, kPeriod, 15),
            "10000110100101"
            "0");
}

class BissBLengths : public testing::TestWithParam<unsigned> {};

TEST_P(BissBLengths, Word_ArrivesCompleteAndStops) {
  const unsigned bits = GetParam();
  const std::uint64_t word = 0xA5C3'96F0'5A3C'69E1U >> (64 - bits);
  BissBBench bench;
  bench.add(biss_b_slave(bits, word, 0));
  EXPECT_EQ(bench.frame(kStart, kPeriod, bits + 6), "101" + binary(word, bits) + "000");
}

INSTANTIATE_TEST_SUITE_P(Bits, BissBLengths, testing::Range(1U, 65U));

TEST(BissBSlave, SensorTimeout_EndsTheFrame) {
  for (const double timeout_us : {1.0, 4.0, 16.0, 128.0}) {  // those of iC-NQ
    BissBBench bench;
    BissBSlaveConfig config = biss_b_slave(8, 0, 0);
    config.timeout.fixed = from_us(timeout_us);
    bench.add(config);
    bench.frame(kStart, kPeriod, 12);
    const Time last = kStart + 12 * kPeriod - kPeriod / 2;
    bench.run_until(last + from_us(200));
    EXPECT_EQ(bench.slo.back(), std::make_pair(last + from_us(timeout_us), true));
  }
}

TEST(BissBSlave, Chain_SendsNearSlaveFirst) {
  BissBBench bench;
  bench.add(biss_b_slave(13, 0x1234, 0));
  BissBSlaveConfig far = biss_b_slave(9, 0x0AB, 0);
  far.busy_periods = 2;
  bench.add(far);
  EXPECT_EQ(bench.frame(kStart, kPeriod, 22 + 6),
            "100"
            "01" +
                binary(0x1234, 13) + binary(0x0AB, 9) + "0");
}

// The hand-over: SL falls when MA has been low for the sensor timeout, in a chain for the longest.
TEST(BissBSlave, MaStaysLow_SlFallsAfterTheSensorTimeout) {
  for (const bool near_is_longer : {true, false}) {
    BissBBench bench;
    BissBSlaveConfig near = biss_b_slave(8, 0, 0);
    BissBSlaveConfig far = biss_b_slave(8, 0, 0);
    near.timeout.fixed = from_us(near_is_longer ? 20 : 10);
    far.timeout.fixed = from_us(near_is_longer ? 10 : 20);
    auto& slave = bench.add(near);
    bench.add(far);
    bench.ma(kStart, false);
    bench.run_until(kStart + from_us(20) - 1);
    EXPECT_TRUE(bench.chain.slo());
    bench.run_until(kStart + from_us(20));
    EXPECT_EQ(bench.slo, (ChainBench::Edges{{kStart + from_us(20), false}}));
    EXPECT_TRUE(slave.in_register_mode());
    EXPECT_EQ(slave.handshakes(), 1U);
    bench.run_until(kStart + from_us(5000));  // the master may take its time
    EXPECT_FALSE(bench.chain.slo());
  }
}

// INIT of BiSS B (page 16, figure 16): the hand-over alone, then MA = 1. SL is 1 again after the
// register timeout, and the next frame is a good one.
TEST(BissBSlave, Init_EndsWithTheRegisterTimeout) {
  BissBBench bench;
  BissBSlaveConfig config = biss_b_slave(8, 0xA5, 0);
  config.register_timeout = from_us(32);
  auto& slave = bench.add(config);
  ASSERT_TRUE(bench.hand_over());
  const Time up = bench.now + from_us(3);
  bench.ma(up, true);
  bench.run_until(up + from_us(100));
  EXPECT_EQ(bench.slo.back(), std::make_pair(up + from_us(32), true));
  EXPECT_TRUE(slave.idle());
  EXPECT_EQ(bench.frame(up + from_us(100), kPeriod, 12), "101101001010");
}

// Page 16, figure 15: with MO the register mode begins at once.
TEST(BissBSlave, MoFallsBeforeMa_SelectsRegisterModeWithoutTimeout) {
  for (const Time before : {Time{0}, 100 * kPsPerNs}) {
    BissBBench bench;
    auto& near = bench.add(biss_b_slave(8, 0, 0));
    auto& far = bench.add(biss_b_slave(8, 0, 0));
    bench.set_mo(0, true);
    bench.run_until(kStart);
    if (before != 0) bench.set_mo(kStart - before, false);
    bench.mo = false;
    bench.ma(kStart, false);
    for (BissBSlave* slave : {&near, &far}) {
      EXPECT_TRUE(slave->in_register_mode());
      EXPECT_EQ(slave->mo_selections(), 1U);
      EXPECT_EQ(slave->handshakes(), 0U);
    }
    EXPECT_FALSE(bench.chain.slo());
  }
}

// SLI = 0 of the last slave does not select register mode, also on a bus whose master has switched
// MO off.
TEST(BissBSlave, SliRestsLow_IsTheLastSlaveOfASensorFrame) {
  BissBBench bench;
  auto& slave = bench.add(biss_b_slave(8, 0xA5, 0));
  bench.set_mo(0, true);
  bench.set_mo(kStart, false);
  EXPECT_EQ(bench.frame(kStart + from_us(17), kPeriod, 12), "101101001010");
  EXPECT_TRUE(slave.is_last());
  EXPECT_EQ(slave.mo_selections(), 0U);
}

// On a bus the master makes the start bit, as in BiSS C.
TEST(BissBSlave, MoHigh_StartBitComesFromMo) {
  BissBBench bench;
  auto& slave = bench.add(biss_b_slave(8, 0xA5, 0));
  bench.set_mo(0, true);
  bench.ma(kStart, false);
  std::string bits;
  for (unsigned i = 1; i <= 14; ++i) {
    bench.mo = i == 1 || i == 5;
    bench.ma(kStart + i * kPeriod - kPeriod / 2, true);
    bits += bench.chain.slo() ? '1' : '0';
    bench.ma(kStart + i * kPeriod, false);
  }
  EXPECT_FALSE(slave.is_last());
  EXPECT_EQ(bits,
            "1000"
            "1" +
                binary(0xA5, 8) + "0");
}

}  // namespace
}  // namespace mb4test
