// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Expected edges come from the protocol (datasheet BiSS C chapter, page 15; docs/theory.md,
// A frame), never from the chip.
#include "sim/lines/biss/biss_c_slave.hpp"

#include <gtest/gtest.h>

#include "tests/unit/lines/clocked/chain_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

constexpr Time kPeriod = 100 * kPsPerNs;  // 10 MHz
constexpr Time kStart = 1000 * kPsPerNs;
// 28 data bits of the golden vector, CRC6 on the line 0x27.
constexpr std::uint64_t kWord = 0b1010101011110011011110111111;
constexpr unsigned kRisings = 28 + 6 + 5;  // N + 5

// Rising edge #n of the frame.
constexpr Time rising(unsigned n) { return kStart + n * kPeriod - kPeriod / 2; }

TEST(BissCSlave, ReferenceFrame_ShowsEveryBitAfterItsRisingEdge) {
  ChainBench bench;
  bench.add(constant_slave(28, kWord, 0x43));
  // #1 still idle level, #2 Ack, #3 start, #4 CDS, 28 data, 6 CRC, stop.
  EXPECT_EQ(bench.frame(kStart, kPeriod, kRisings),
            "101"
            "0" +
                binary(kWord, 28) + binary(0x27, 6) + "0");
}

TEST(BissCSlave, ReferenceFrame_ChangesOnRisingEdgesOnly) {
  ChainBench bench;
  bench.add(constant_slave(28, kWord, 0x43));
  bench.frame(kStart, kPeriod, kRisings);
  ASSERT_GE(bench.slo.size(), 2U);
  EXPECT_EQ(bench.slo[0], std::make_pair(rising(2), false));
  EXPECT_EQ(bench.slo[1], std::make_pair(rising(3), true));
  for (const auto& [time, level] : bench.slo) EXPECT_EQ((time - kStart) % kPeriod, kPeriod / 2);
}

TEST(BissCSlave, BusyPeriods_DelayStartBitByThatMany) {
  for (const unsigned busy : {1U, 3U, 17U}) {
    ChainBench bench;
    BissCSlaveConfig config = constant_slave(28, kWord, 0x43);
    config.busy_periods = busy;
    bench.add(config);
    EXPECT_EQ(bench.frame(kStart, kPeriod, kRisings + busy),
              std::string(1, '1') + std::string(1 + busy, '0') + "10" + binary(kWord, 28) +
                  binary(0x27, 6) + "0")
        << "busy " << busy;
  }
}

class SlaveLengths : public testing::TestWithParam<unsigned> {};

TEST_P(SlaveLengths, AlternatingWord_ArrivesCompleteAndStops) {
  const unsigned bits = GetParam();
  const std::uint64_t word = 0xA5C3'96F0'5A3C'69E1U >> (64 - bits);
  ChainBench bench;
  bench.add(constant_slave(bits, word, 0));
  EXPECT_EQ(bench.frame(kStart, kPeriod, bits + 5 + 2), "1010" + binary(word, bits) + "000");
}

INSTANTIATE_TEST_SUITE_P(Bits, SlaveLengths, testing::Range(1U, 65U));

// Timeout: 1.5 periods after the last edge of MA (adaptive, measured from falling #1 to rising #2).
TEST(BissCSlave, AdaptiveTimeout_IsOneAndAHalfPeriods) {
  for (const Time period : {100 * kPsPerNs, 1000 * kPsPerNs, 12'500 * kPsPerNs}) {
    ChainBench bench;
    BissCSlave& slave = bench.add(constant_slave(28, kWord, 0x43));
    bench.frame(kStart, period, kRisings);
    const Time last = kStart + kRisings * period - period / 2;
    bench.run_until(last + 3 * period / 2 - 1);
    EXPECT_FALSE(slave.idle());
    EXPECT_FALSE(bench.chain.slo());
    bench.run_until(last + 3 * period / 2);
    EXPECT_TRUE(slave.idle());
    EXPECT_EQ(bench.slo.back(), std::make_pair(last + 3 * period / 2, true));
  }
}

TEST(BissCSlave, SlowerClockAfterFast_IsMeasuredAnew) {
  ChainBench bench;
  BissCSlave& slave = bench.add(constant_slave(28, kWord, 0x43));
  bench.frame(kStart, kPeriod, kRisings);
  bench.run_until(100 * kPsPerUs);
  EXPECT_EQ(bench.frame(100 * kPsPerUs, 50 * kPeriod, kRisings),
            "1010" + binary(kWord, 28) + binary(0x27, 6) + "0");
  EXPECT_EQ(slave.frames(), 2U);
}

TEST(BissCSlave, AdaptiveTimeoutWithSampling_StaysInItsBounds) {
  ChainBench bench;
  BissCSlaveConfig config = constant_slave(28, kWord, 0x43);
  config.timeout.sample_period = 20 * kPsPerNs;
  BissCSlave& slave = bench.add(config);
  for (unsigned i = 1; i <= 50; ++i) {
    bench.frame(i * 10 * kPsPerUs, kPeriod, kRisings);
    EXPECT_GE(slave.timeout(), 3 * kPeriod / 2);
    EXPECT_LE(slave.timeout(), 3 * kPeriod / 2 + 60 * kPsPerNs);
  }
}

TEST(BissCSlave, FixedTimeout_CountsFromTheLastEdgeOfEitherDirection) {
  for (const bool rest : {true, false}) {
    ChainBench bench;
    BissCSlaveConfig config = constant_slave(28, kWord, 0x43);
    config.timeout.fixed = from_us(12.5);
    bench.add(config);
    bench.frame(kStart, kPeriod, kRisings, rest);
    const Time last = rising(kRisings) + (rest ? 0 : kPeriod / 2);
    bench.run_until(last + from_us(20));
    EXPECT_EQ(bench.slo.back(), std::make_pair(last + from_us(12.5), true));
  }
}

// CDM is the inverted level of MA in the timeout.
TEST(BissCSlave, LevelInTimeout_IsTakenInvertedAsCdm) {
  ChainBench bench;
  BissCSlave& slave = bench.add(constant_slave(28, kWord, 0x43));
  bench.frame(kStart, kPeriod, kRisings, false);
  EXPECT_EQ(slave.cdm_count(), 0U);  // not before the timeout
  bench.run_until(10 * kPsPerUs);
  EXPECT_EQ(slave.cdm_count(), 1U);
  EXPECT_TRUE(slave.last_cdm());
  bench.ma(10 * kPsPerUs, true);  // MA returns to 1 between the frames
  bench.frame(11 * kPsPerUs, kPeriod, kRisings, true);
  bench.run_until(30 * kPsPerUs);
  EXPECT_EQ(slave.cdm_count(), 2U);
  EXPECT_FALSE(slave.last_cdm());
}

// Table 25: after CDM = 1 with HOLDCDM MA rests low and rises just before the next frame.
TEST(BissCSlave, MaRestsLow_NextFrameIsNotShifted) {
  ChainBench bench;
  BissCSlave& slave = bench.add(constant_slave(28, kWord, 0x43));
  bench.frame(kStart, kPeriod, kRisings, false);
  const Time second = 20 * kPsPerUs;
  bench.ma(second - kPeriod / 2, true);
  EXPECT_TRUE(slave.idle());  // a rising edge is no start
  EXPECT_EQ(bench.frame(second, kPeriod, kRisings),
            "1010" + binary(kWord, 28) + binary(0x27, 6) + "0");
  EXPECT_EQ(slave.frames(), 2U);
  EXPECT_EQ(slave.timeout(), 3 * kPeriod / 2);  // measured from the falling edge
}

// INIT (datasheet page 16): two low pulses are acknowledged and time out, but are no frame.
TEST(BissCSlave, TwoPulses_AreAcknowledgedButCountAsNoFrame) {
  ChainBench bench;
  BissCSlave& slave = bench.add(constant_slave(28, kWord, 0x43));
  bench.frame(kStart, kPeriod, 2);
  EXPECT_EQ(bench.slo.back(), std::make_pair(rising(2), false));
  bench.run_until(10 * kPsPerUs);
  EXPECT_EQ(bench.slo.back(), std::make_pair(rising(2) + 3 * kPeriod / 2, true));
  EXPECT_EQ(slave.frames(), 0U);
  EXPECT_EQ(slave.cdm_count(), 0U);
}

TEST(BissCSlave, WordChangedAfterLatch_IsSentInTheNextFrame) {
  ChainBench bench;
  BissCSlave& slave = bench.add(constant_slave(8, 0x11, 0));
  bench.queue.post(rising(1) + 1, [&] { EXPECT_TRUE(slave.set_data(0xEE)); });
  EXPECT_EQ(bench.frame(kStart, kPeriod, 13), "1010" + binary(0x11, 8) + "0");
  EXPECT_EQ(bench.frame(20 * kPsPerUs, kPeriod, 13), "1010" + binary(0xEE, 8) + "0");
}

TEST(BissCSlave, WordTooLong_IsRefused) {
  BissCSlave slave(constant_slave(8, 0, 0), 1);
  EXPECT_FALSE(slave.set_data(0x100));
  EXPECT_TRUE(slave.set_data(0xFF));
}

TEST(BissCSlave, RegisterFile_KeepsAllBytes) {
  BissCSlave slave(constant_slave(8, 0, 0), 1);
  for (unsigned i = 0; i < 256; ++i) {
    slave.reg_write(static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i));
  }
  for (unsigned i = 0; i < 256; ++i)
    EXPECT_EQ(slave.reg_read(static_cast<std::uint8_t>(i)), 255 - i);
}

// A word of 4 position bits, nE, nW and a life counter of `bits` bits.
BissCSlaveConfig counting_slave(unsigned bits, unsigned first) {
  BissCSlaveConfig config = constant_slave(6 + bits, 0x27ULL << bits, 0);
  config.life_counter = {bits, first};
  return config;
}

// The life counters of the next `frames` frames. The rest of the word must be as `rest` says.
std::vector<std::uint64_t> life_counters(ChainBench& bench, unsigned bits, unsigned frames,
                                         std::uint64_t rest = 0x27) {
  std::vector<std::uint64_t> values;
  for (unsigned i = 0; i < frames; ++i) {
    const Time start = bench.now + 20 * kPeriod;
    const std::string sent = bench.frame(start, kPeriod, 6 + bits + 5).substr(4, 6 + bits);
    bench.run_until(bench.now + 20 * kPeriod);
    const std::uint64_t word = std::stoull(sent, nullptr, 2);
    EXPECT_EQ(word >> bits, rest) << "frame " << i;
    values.push_back(word % (1U << bits));
  }
  return values;
}

using Values = std::vector<std::uint64_t>;

TEST(LifeCounter, CountsFramesAndGoesOnAtItsFirstValue) {
  ChainBench bench;
  bench.add(counting_slave(2, 0));
  EXPECT_EQ(life_counters(bench, 2, 6), (Values{0, 1, 2, 3, 0, 1}));
  ChainBench from_one;
  from_one.add(counting_slave(2, 1));
  EXPECT_EQ(life_counters(from_one, 2, 6), (Values{1, 2, 3, 1, 2, 3}));
}

TEST(LifeCounter, SixBits_Have64Values) {
  ChainBench bench;
  bench.add(counting_slave(6, 0));
  const Values values = life_counters(bench, 6, 130);
  for (unsigned i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], i % 64);
}

// Two pulses and a rest (INIT) are no frame: the word that was latched is not sent.
TEST(LifeCounter, FrameWithoutAStartBit_DoesNotCount) {
  ChainBench bench;
  const BissCSlave& slave = bench.add(counting_slave(3, 0));
  EXPECT_EQ(life_counters(bench, 3, 2), (Values{0, 1}));
  bench.frame(bench.now + 20 * kPeriod, kPeriod, 2);
  bench.run_until(bench.now + 20 * kPeriod);
  EXPECT_EQ(life_counters(bench, 3, 1), (Values{2}));
  EXPECT_EQ(slave.sent_in(3), 0x27U << 3U | 2U);
}

TEST(LifeCounter, HeldWord_KeepsTheCounterOfTheSlave) {
  ChainBench bench;
  BissCSlave& slave = bench.add(counting_slave(3, 0));
  life_counters(bench, 3, 2);
  ASSERT_TRUE(slave.set_data(0x35U << 3U | 7U));
  EXPECT_EQ(life_counters(bench, 3, 2, 0x35), (Values{2, 3}));
}

TEST(LifeCounter, StuckCounter_StandsStillAndGoesOn) {
  ChainBench bench;
  BissCSlave& slave = bench.add(counting_slave(3, 0));
  life_counters(bench, 3, 2);
  slave.set_fault(slave_fault::kStuckCounter, true);
  EXPECT_EQ(life_counters(bench, 3, 2), (Values{1, 1}));
  slave.set_fault(slave_fault::kStuckCounter, false);
  EXPECT_EQ(life_counters(bench, 3, 2), (Values{2, 3}));
}

TEST(LifeCounter, SkippedWord_IsTwoStepsInEachFrame) {
  ChainBench bench;
  BissCSlave& slave = bench.add(counting_slave(3, 0));
  life_counters(bench, 3, 2);
  slave.set_fault(slave_fault::kSkippedWord, true);
  EXPECT_EQ(life_counters(bench, 3, 2), (Values{3, 5}));
  slave.set_fault(slave_fault::kSkippedWord, false);
  EXPECT_EQ(life_counters(bench, 3, 1), (Values{6}));
}

// The sensor goes on meanwhile: after the fault its counter and its ramp are where they would be.
TEST(LifeCounter, StuckWord_IsTheWholeWordAgain) {
  ChainBench bench;
  BissCSlaveConfig config = counting_slave(3, 0);
  config.flag_bits = 5;
  config.flags = 3U << 3U;
  config.source.kind = DataSource::Kind::kRamp;
  BissCSlave& slave = bench.add(config);
  EXPECT_EQ(life_counters(bench, 3, 1, 0b0000'11), (Values{0}));
  EXPECT_EQ(life_counters(bench, 3, 1, 0b0001'11), (Values{1}));
  slave.set_fault(slave_fault::kStuckWord, true);
  EXPECT_EQ(life_counters(bench, 3, 2, 0b0001'11), (Values{1, 1}));
  slave.set_fault(slave_fault::kStuckWord, false);
  EXPECT_EQ(life_counters(bench, 3, 1, 0b0100'11), (Values{4}));
}

}  // namespace
}  // namespace mb4test
