// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Expected edges come from the SSI documents of makers (Posital, TR-Electronic, National
// Instruments) and from the datasheet's SSI chapter (pages 14, 16).
#include "sim/lines/ssi/ssi_slave.hpp"

#include <gtest/gtest.h>

#include "tests/unit/lines/registers/control_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

constexpr Time kPeriod = 1000 * kPsPerNs;  // 1 MHz
constexpr Time kStart = 10'000 * kPsPerNs;

SsiSlaveConfig encoder(unsigned data_bits, std::uint64_t word) {
  SsiSlaveConfig config;
  config.data_bits = data_bits;
  config.source.constant = word;
  return config;
}

// Rising edge #n of the frame.
constexpr Time rising(unsigned n) { return kStart + n * kPeriod - kPeriod / 2; }

// The MSB appears with the first rising edge; after the last bit the line is 0.
TEST(SsiSlave, BinaryWord_AppearsFromTheFirstRisingEdgeOn) {
  ChainBench bench;
  auto& slave = bench.put<SsiSlave>(encoder(13, 0x1A5B & 0x1FFF));
  EXPECT_TRUE(bench.chain.slo());
  EXPECT_EQ(bench.frame(kStart, kPeriod, 14),
            "1101001011011"
            "0");
  EXPECT_EQ(slave.frames(), 1U);
}

class SsiLengths : public testing::TestWithParam<unsigned> {};

TEST_P(SsiLengths, Word_IsCompleteAndEndsWithZero) {
  const unsigned bits = GetParam();
  const std::uint64_t word = 0xA5C3'96F0'5A3C'69E1U >> (64 - bits);
  ChainBench bench;
  bench.put<SsiSlave>(encoder(bits, word));
  EXPECT_EQ(bench.frame(kStart, kPeriod, bits + 3), binary(word, bits) + "000");
}

INSTANTIATE_TEST_SUITE_P(Bits, SsiLengths, testing::Range(1U, 65U));

// The first falling edge shows nothing: data changes with rising edges only.
TEST(SsiSlave, Word_ChangesOnRisingEdgesOnly) {
  ChainBench bench;
  bench.put<SsiSlave>(encoder(8, 0x55));
  bench.frame(kStart, kPeriod, 9);
  ASSERT_EQ(bench.slo.size(), 9U);  // 1 to 0, seven times back and forth, then to 0
  for (unsigned n = 1; n <= 9; ++n) EXPECT_EQ(bench.slo[n - 1].first, rising(n));
}

// Written out by hand: consecutive Gray numbers differ in one bit.
TEST(SsiSlave, GrayWord_IsCoded) {
  const char* const codes[] = {"000", "001", "011", "010", "110", "111", "101", "100"};
  for (unsigned position = 0; position < 8; ++position) {
    ChainBench bench;
    SsiSlaveConfig config = encoder(3, position);
    config.gray = true;
    bench.put<SsiSlave>(config);
    EXPECT_EQ(bench.frame(kStart, kPeriod, 4), codes[position] + std::string("0"));
  }
}

// A power-fail bit behind a Gray-coded position stays as it is.
TEST(SsiSlave, FlagBehindGray_IsNotCoded) {
  ChainBench bench;
  SsiSlaveConfig config = encoder(4, 0b1011);  // position 5, flag 1
  config.gray = true;
  config.flag_bits = 1;
  bench.put<SsiSlave>(config);
  EXPECT_EQ(bench.frame(kStart, kPeriod, 5),
            "111"
            "1"
            "0");
}

// Every falling edge triggers the monoflop again; the line is 1 when it has run out.
TEST(SsiSlave, Monoflop_RunsFromTheLastFallingEdge) {
  for (const Time monoflop : {from_us(12.5), from_us(20), from_us(25)}) {
    ChainBench bench;
    SsiSlaveConfig config = encoder(12, 0xFFF);
    config.monoflop = monoflop;
    auto& slave = bench.put<SsiSlave>(config);
    bench.frame(kStart, kPeriod, 13);
    const Time last_falling = kStart + 12 * kPeriod;
    bench.run_until(last_falling + monoflop - 1);
    EXPECT_FALSE(slave.idle());
    EXPECT_FALSE(bench.chain.slo());
    bench.run_until(last_falling + monoflop);
    EXPECT_TRUE(slave.idle());
    EXPECT_EQ(bench.slo.back(), std::make_pair(last_falling + monoflop, true));
  }
}

// Posital: 25 bits repeat in a raster of 26 clocks, one 0 between the words.
TEST(SsiSlave, Ring_RepeatsTheWordBehindOneZero) {
  ChainBench bench;
  SsiSlaveConfig config = encoder(25, 0x1A5B37C);
  config.ring = true;
  auto& slave = bench.put<SsiSlave>(config);
  bench.queue.post(rising(20), [&] { slave.set_data(0); });  // latched long before
  const std::string word = binary(0x1A5B37C, 25) + "0";
  EXPECT_EQ(bench.frame(kStart, kPeriod, 3 * 26), word + word + word);
  EXPECT_EQ(slave.frames(), 1U);
}

TEST(SsiSlave, RingAcrossAShortPause_GoesOnWithTheOldWord) {
  for (const double pause_us : {15.0, 25.0}) {
    ChainBench bench;
    SsiSlaveConfig config = encoder(25, 0x1A5B37C);
    config.ring = true;
    auto& slave = bench.put<SsiSlave>(config);
    const std::string old_word = binary(0x1A5B37C, 25) + "0";
    EXPECT_EQ(bench.frame(kStart, kPeriod, 26), old_word);
    slave.set_data(0x0F0F0F0);
    const Time second = kStart + 25 * kPeriod + from_us(pause_us);
    EXPECT_EQ(bench.frame(second, kPeriod, 26),
              pause_us < 20 ? old_word : binary(0x0F0F0F0, 25) + "0");
  }
}

TEST(SsiSlave, ShortPauseWithoutRing_GivesZeros) {
  ChainBench bench;
  bench.put<SsiSlave>(encoder(8, 0xFF));
  EXPECT_EQ(bench.frame(kStart, kPeriod, 9), "111111110");
  EXPECT_EQ(bench.frame(kStart + 15 * kPeriod, kPeriod, 9), "000000000");
}

// Page 14: a response up to one clock less 30 ns is allowed; the model has any.
TEST(SsiSlave, Response_DelaysEveryBit) {
  for (const Time response : {Time{1}, 499 * kPsPerNs, 970 * kPsPerNs, 2300 * kPsPerNs}) {
    ChainBench bench;
    SsiSlaveConfig config = encoder(8, 0x55);
    config.response = response;
    bench.put<SsiSlave>(config);
    bench.frame(kStart, kPeriod, 9);
    bench.run_until(kStart + 15 * kPeriod);
    ASSERT_EQ(bench.slo.size(), 9U);
    for (unsigned n = 1; n <= 9; ++n) {
      EXPECT_EQ(bench.slo[n - 1], std::make_pair(rising(n) + response, n % 2 == 0)) << response;
    }
    bench.run_until(kStart + 100 * kPeriod);
    EXPECT_TRUE(bench.chain.slo());
  }
}

// A line that rests low (CDM = 1) and rises is no frame.
TEST(SsiSlave, MaRestsLow_NextFrameIsNotShifted) {
  ChainBench bench;
  auto& slave = bench.put<SsiSlave>(encoder(8, 0xC5));
  bench.frame(kStart, kPeriod, 9, false);
  const Time second = kStart + 60 * kPeriod;
  bench.ma(second - kPeriod, true);
  EXPECT_TRUE(slave.idle());
  EXPECT_TRUE(slave.last_cdm());
  EXPECT_EQ(bench.frame(second, kPeriod, 9), "110001010");
  EXPECT_EQ(slave.frames(), 2U);
}

// Pages 16, 28: a register write without any answer, one CDM bit a frame as the inverted level of
// MA when the monoflop runs out. The bits are the worked frame "write 0x06 to 0x60".
TEST(SsiSlave, ExtendedSsi_TakesABlindRegisterWrite) {
  ChainBench bench;
  SsiSlaveConfig config = encoder(8, 0xC5);
  config.control.present = true;
  auto& slave = bench.put<SsiSlave>(config);
  Time start = kStart;
  const auto send = [&](const std::string& cdm) {
    for (const char bit : cdm) {
      if (!bench.chain.ma()) bench.ma(start - kPeriod, true);
      EXPECT_EQ(bench.frame(start, kPeriod, 9, bit == '0'), "110001010");
      start += 9 * kPeriod + from_us(30);
    }
  };
  send(std::string(14, '0'));
  send(
      "1"
      "1"
      "000"
      "1100000"
      "1011"
      "01"
      "1"
      "00000110"
      "0101"
      "0"
      "0");
  bench.run_until(start);
  EXPECT_EQ(slave.reg_read(0x60), 0x06);
  EXPECT_EQ(slave.control()->counters().writes, 1U);
  EXPECT_EQ(slave.control()->counters().protocol_errors, 0U);
}

}  // namespace
}  // namespace mb4test
