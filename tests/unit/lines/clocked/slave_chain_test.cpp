// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Chains (datasheet page 15; docs/choices.md, 10): slave 1, next to the master, comes first; each
// slave is a shift register of its own length.
#include "sim/lines/clocked/slave_chain.hpp"

#include <gtest/gtest.h>

#include "sim/lines/biss/biss_b_slave.hpp"
#include "tests/unit/lines/clocked/chain_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

constexpr Time kPeriod = 100 * kPsPerNs;
constexpr Time kStart = 1000 * kPsPerNs;

std::string line_word(std::uint64_t word, unsigned bits, std::uint32_t polynomial) {
  const Crc crc{polynomial, 0};
  return binary(word, bits) + binary(crc.line_bits(word, bits), crc.width());
}

TEST(SlaveChain, TwoSlaves_SendNearOneFirst) {
  ChainBench bench;
  bench.add(constant_slave(13, 0x1234, 0x43));
  bench.add(constant_slave(9, 0x0AB, 0x25));
  const std::string data = line_word(0x1234, 13, 0x43) + line_word(0x0AB, 9, 0x25);
  EXPECT_EQ(bench.frame(kStart, kPeriod, static_cast<unsigned>(data.size()) + 5),
            "1010" + data + "0");
}

// The datasheet's example of a sensor bus with three slaves (page 26): 19+2 bits CRC6, 12+2 bits
// CRC5, 24 bits CRC16; 86 bits altogether.
TEST(SlaveChain, ThreeSlavesOfDatasheetExample_SendTheirWordsInOrder) {
  ChainBench bench;
  bench.add(constant_slave(21, 0x15A5A5, 0x43));
  bench.add(constant_slave(14, 0x2F0F, 0x25));
  bench.add(constant_slave(24, 0xC0FFEE, 0x190D9));
  const std::string data = line_word(0x15A5A5, 21, 0x43) + line_word(0x2F0F, 14, 0x25) +
                           line_word(0xC0FFEE, 24, 0x190D9);
  ASSERT_EQ(data.size(), 86U);
  EXPECT_EQ(bench.frame(kStart, kPeriod, 86 + 5), "1010" + data + "0");
}

TEST(SlaveChain, BusyLastSlave_DelaysStartBitOfAll) {
  ChainBench bench;
  BissCSlaveConfig near = constant_slave(8, 0x5A, 0);
  near.busy_periods = 100;  // only the last slave makes the start bit
  BissCSlaveConfig far = constant_slave(8, 0xC3, 0);
  far.busy_periods = 2;
  bench.add(near);
  bench.add(far);
  EXPECT_EQ(bench.frame(kStart, kPeriod, 16 + 5 + 2),
            "1"
            "000"
            "10" +
                binary(0x5AC3, 16) + "0");
}

// Datasheet page 15: in the timeout only the last slave forces SLO high, the others pass SLI on.
// The master sees 1 when all have timed out.
TEST(SlaveChain, DifferentTimeouts_SlRisesWithTheLongest) {
  for (const bool near_is_longer : {true, false}) {
    ChainBench bench;
    BissCSlaveConfig near = constant_slave(8, 0, 0);
    BissCSlaveConfig far = constant_slave(8, 0, 0);
    near.timeout.fixed = from_us(near_is_longer ? 20 : 10);
    far.timeout.fixed = from_us(near_is_longer ? 10 : 20);
    bench.add(near);
    bench.add(far);
    bench.frame(kStart, kPeriod, 21);
    const Time last = kStart + 21 * kPeriod - kPeriod / 2;
    bench.run_until(last + from_us(30));
    EXPECT_EQ(bench.slo.back(), std::make_pair(last + from_us(20), true)) << near_is_longer;
  }
}

// In the data of a frame the chain does not pass falling edges on. Each slave still counts its
// timeout from the last edge, and knows the level of MA.
TEST(SlaveChain, MaRestsInTheData_EachSlaveTimesOutFromTheLastEdge) {
  for (const bool rest : {true, false}) {
    ChainBench bench;
    BissCSlaveConfig config = constant_slave(8, 0x5A, 0);
    config.timeout.fixed = from_us(10);
    const BissCSlave& near = bench.add(config);
    config.timeout.fixed = from_us(20);
    const BissCSlave& far = bench.add(config);
    bench.frame(kStart, kPeriod, 12, rest);
    const Time last = kStart + 12 * kPeriod - (rest ? kPeriod / 2 : 0);
    bench.run_until(last + from_us(10) - 1);
    EXPECT_EQ(near.cdm_count(), 0U);
    bench.run_until(last + from_us(20) - 1);
    EXPECT_EQ(near.cdm_count(), 1U);
    EXPECT_EQ(far.cdm_count(), 0U);
    bench.run_until(last + from_us(20));
    EXPECT_EQ(far.cdm_count(), 1U);
    EXPECT_EQ(near.last_cdm(), !rest);
    EXPECT_EQ(far.last_cdm(), !rest);
  }
}

TEST(SlaveChain, OnlyTheFarSlaveIsLast) {
  ChainBench bench;
  const BissCSlave& near = bench.add(constant_slave(8, 0, 0));
  const BissCSlave& far = bench.add(constant_slave(8, 0, 0));
  bench.frame(kStart, kPeriod, 21);
  EXPECT_FALSE(near.is_last());
  EXPECT_TRUE(far.is_last());
}

// Bus configuration (datasheet page 15, figure 12): with MO the master makes the start bit and no
// slave is the last one.
TEST(SlaveChain, MoHigh_StartBitComesFromMo) {
  for (const bool passes : {false, true}) {
    ChainBench bench;
    BissCSlaveConfig config = constant_slave(8, 0xA5, 0);
    config.passes_acknowledge = passes;
    const BissCSlave& slave = bench.add(config);
    bench.mo = true;
    bench.chain.drive(0, true, true);
    bench.ma(kStart, false);
    std::string bits;
    // MO: acknowledge with rising edge 2, start bit with rising edge 5, then 0.
    for (unsigned i = 1; i <= 16; ++i) {
      bench.mo = i == 1 || i == 5;
      bench.ma(kStart + i * kPeriod - kPeriod / 2, true);
      bits += bench.chain.slo() ? '1' : '0';
      bench.ma(kStart + i * kPeriod, false);
    }
    EXPECT_FALSE(slave.is_last());
    EXPECT_EQ(bits,
              "1000"
              "10" +
                  binary(0xA5, 8) + "00");
  }
}

// Decision 10: slaves that connect SLI to SLO from the request to the start bit acknowledge when MO
// falls; others at the second rising edge. Two pulses at MA (page 16, figure 13), MO falls `late`
// after the second one's end, or not at all.
template <typename Slave, typename Config>
void expect_acknowledge(const Config& base) {
  for (const bool passes : {false, true}) {
    for (const unsigned slaves : {1U, 3U}) {
      for (const Time late : {Time{0}, kPsPerNs, kPeriod / 2, 5 * kPeriod, kNever}) {
        ChainBench bench;
        Config config = base;
        config.passes_acknowledge = passes;
        config.timeout.fixed = from_us(10);
        for (unsigned i = 0; i < slaves; ++i) bench.put<Slave>(config, 1);
        bench.mo = true;
        bench.chain.drive(0, true, true);
        bench.ma(kStart, false);
        bench.ma(kStart + kPeriod / 2, true);
        bench.ma(kStart + kPeriod, false);
        const Time second = kStart + 3 * kPeriod / 2;
        bench.mo = late != 0;
        bench.ma(second, true);
        if (late != 0 && late != kNever) {
          bench.run_until(second + late);
          bench.mo = false;
          bench.chain.drive(second + late, true, false);
        }
        bench.run_until(second + from_us(20));
        ChainBench::Edges expected;
        if (!passes || late != kNever)
          expected.emplace_back(passes ? second + late : second, false);
        // MO has stayed 1: the slaves pass it on after their timeout, which the chain reports.
        if (late == kNever) expected.emplace_back(second + from_us(10), true);
        EXPECT_EQ(bench.slo, expected) << passes << " " << slaves << " " << late;
        EXPECT_TRUE(bench.chain.idle());
      }
    }
  }
}

TEST(SlaveChain, PassedOnAcknowledge_ComesWithMo) {
  expect_acknowledge<BissCSlave>(constant_slave(8, 0xA5, 0));
  BissBSlaveConfig config;
  config.data_bits = 8;
  expect_acknowledge<BissBSlave>(config);
}

// One of three slaves is of the other kind: it sends 0 at once, and the slaves nearer to the master
// pass this 0 on.
TEST(SlaveChain, MixedKinds_AcknowledgeWithTheFirstOfThem) {
  for (unsigned latched = 0; latched < 3; ++latched) {
    ChainBench bench;
    for (unsigned i = 0; i < 3; ++i) {
      BissCSlaveConfig config = constant_slave(8, 0xA5, 0);
      config.passes_acknowledge = i != latched;
      bench.add(config);
    }
    bench.mo = true;
    bench.chain.drive(0, true, true);
    bench.frame(kStart, kPeriod, 2);
    ASSERT_EQ(bench.slo.size(), 1U) << latched;
    EXPECT_EQ(bench.slo[0], std::make_pair(kStart + 3 * kPeriod / 2, false)) << latched;
  }
}

// Without MO the last slave acknowledges, with and without passes_acknowledge; the others pass it
// on.
TEST(SlaveChain, PassedOnAcknowledgeWithoutMo_ComesFromTheLastSlave) {
  for (const bool passes : {false, true}) {
    ChainBench bench;
    for (const std::uint64_t word : {0x12U, 0x34U, 0x56U}) {
      BissCSlaveConfig config = constant_slave(8, word, 0x43);
      config.passes_acknowledge = passes;
      config.busy_periods = 2;
      bench.add(config);
    }
    const std::string data =
        line_word(0x12, 8, 0x43) + line_word(0x34, 8, 0x43) + line_word(0x56, 8, 0x43);
    EXPECT_EQ(bench.frame(kStart, kPeriod, static_cast<unsigned>(data.size()) + 5 + 2),
              "100010" + data + "0");
    EXPECT_EQ(bench.slo[0], std::make_pair(kStart + 3 * kPeriod / 2, false));
  }
}

// The fault "the acknowledge does not end", for both kinds of slaves: the acknowledge begins as
// usual, and the slave does not pass on the start bit of MO.
TEST(SlaveChain, BusyFault_KeepsMosStartBit) {
  for (const bool passes : {false, true}) {
    ChainBench bench;
    BissCSlaveConfig config = constant_slave(8, 0xA5, 0);
    config.passes_acknowledge = passes;
    bench.add(config).set_fault(slave_fault::kBusy, true);
    bench.mo = true;
    bench.chain.drive(0, true, true);
    bench.ma(kStart, false);
    for (unsigned i = 1; i <= 8; ++i) {
      bench.mo = i == 1 || i == 4;
      bench.ma(kStart + i * kPeriod - kPeriod / 2, true);
      EXPECT_EQ(bench.chain.slo(), i == 1) << passes << " " << i;
      bench.ma(kStart + i * kPeriod, false);
    }
  }
}

TEST(SlaveChain, NoSlaves_LineRestsHigh) {
  ChainBench bench;
  bench.frame(kStart, kPeriod, 10);
  EXPECT_TRUE(bench.chain.slo());
  EXPECT_TRUE(bench.slo.empty());
}

// Each bit of MO leaves slave 1 after as many clocks as the slaves have bits, however long the
// frame is: the chain keeps 2,048 bits in a row before it begins a new one.
TEST(SlaveChain, LongFrameWithMo_BitsOfMoComeBehindTheWords) {
  constexpr unsigned kHead = 6;  // rising edges up to the CDS bit
  constexpr unsigned kBits = 8 + 13 + 3;
  ChainBench bench;
  bench.add(constant_slave(8, 0xA5, 0));
  bench.add(constant_slave(13, 0x1234, 0));
  bench.add(constant_slave(3, 0x5, 0));
  bench.mo = true;
  bench.chain.drive(0, true, true);
  bench.ma(kStart, false);
  std::string sent;
  std::string came;
  for (unsigned i = 1; i <= 5000; ++i) {
    // Acknowledge and start bit as above; then long levels and short ones.
    const bool level = i <= kHead ? i == 1 || i == 5 : i % 700 < 3 || i % 1300 > 1000;
    if (i > kHead + 1) sent += bench.mo ? '1' : '0';
    bench.mo = level;
    bench.ma(kStart + i * kPeriod - kPeriod / 2, true);
    if (i > kHead) came += bench.chain.slo() ? '1' : '0';
    bench.ma(kStart + i * kPeriod, false);
  }
  const std::string words = binary(0xA5, 8) + binary(0x1234, 13) + binary(0x5, 3);
  EXPECT_EQ(came.substr(0, kBits), words);
  EXPECT_EQ(came.substr(kBits), sent.substr(0, came.size() - kBits));
}

// A slave that is silent from the middle of a frame on sends 1. Those before it pass on what they
// have.
TEST(SlaveChain, SilentInTheData_RestOfTheFrameIsOne) {
  ChainBench bench;
  bench.add(constant_slave(4, 0x0, 0));
  BissCSlave& far = bench.add(constant_slave(8, 0x00, 0));
  bench.ma(kStart, false);
  std::string bits;
  for (unsigned i = 1; i <= 16; ++i) {
    if (i == 8) {
      far.set_fault(slave_fault::kSilent, true);
      bench.chain.refresh(bench.now);
    }
    bench.ma(kStart + i * kPeriod - kPeriod / 2, true);
    bits += bench.chain.slo() ? '1' : '0';
    bench.ma(kStart + i * kPeriod, false);
  }
  // The near slave's four bits, the two bits of the far one that it has taken before, then ones.
  EXPECT_EQ(bits,
            "1010"
            "0000"
            "00"
            "111111");
}

// The fault "swapped words": data and CRC of the far slave leave first, for slaves of any lengths.
TEST(SlaveChain, SwappedWords_FarSlaveLeavesFirst) {
  struct Lengths {
    unsigned near, far;
  };
  for (const auto& [near, far] : {Lengths{8, 8}, Lengths{5, 12}, Lengths{12, 5}, Lengths{64, 64}}) {
    ChainBench bench;
    const std::uint64_t one = 0xA5C3'96F0'5A3C'69E1U >> (64 - near);
    const std::uint64_t two = 0xF00D'1234'5678'9ABDU >> (64 - far);
    BissCSlave& slave = bench.add(constant_slave(near, one, 0x43));
    bench.add(constant_slave(far, two, 0x43));
    const unsigned risings = near + far + 2 * 6 + 5;
    const auto frame = [&] {
      const Time start = bench.now + 20 * kPeriod;
      const std::string bits = bench.frame(start, kPeriod, risings);
      bench.run_until(bench.now + 20 * kPeriod);
      return bits.substr(4);
    };
    const std::string first = binary(one, near) + binary(Crc{0x43, 0}.line_bits(one, near), 6);
    const std::string second = binary(two, far) + binary(Crc{0x43, 0}.line_bits(two, far), 6);
    EXPECT_EQ(frame(), first + second + "0") << near << ", " << far;
    slave.set_fault(slave_fault::kSwappedWords, true);
    EXPECT_EQ(frame(), second + first + "0") << near << ", " << far;
    EXPECT_EQ(frame(), second + first + "0") << near << ", " << far;
    slave.set_fault(slave_fault::kSwappedWords, false);
    EXPECT_EQ(frame(), first + second + "0") << near << ", " << far;
  }
}

}  // namespace
}  // namespace mb4test
