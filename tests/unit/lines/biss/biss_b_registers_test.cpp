// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Register mode of BiSS B on hand-made bit cells (datasheet page 13, I401 to I407, page 16; fields
// by docs/choices.md). SL stands before the rising edge of each cell: what the slave puts on the
// line with one rising edge is seen at the next.
#include "sim/lines/biss/biss_b_registers.hpp"

#include <gtest/gtest.h>

#include "tests/unit/lines/biss/biss_b_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

BissBSlaveConfig with_registers() {
  BissBSlaveConfig config = biss_b_slave(8, 0xA7, 0);
  config.register_timeout = from_us(32);
  return config;
}

// Start bit, data and CRC of one byte, and what follows.
std::string byte_frame(unsigned byte, const char* more = "") {
  std::string text(1, '1');
  return text.append(data_with_crc(byte)).append(more);
}

// Both ways into register mode; ID of the only slave.
class BissBAccess : public testing::TestWithParam<bool> {
 protected:
  void enter() {
    if (GetParam()) {
      bench.set_mo(bench.now + bench.cell, true);
      bench.run_until(bench.now + from_us(50));
      bench.select_by_mo();
    } else {
      ASSERT_TRUE(bench.hand_over());
    }
  }
  void leave() {
    bench.finish();
    if (GetParam()) bench.set_mo(bench.now, true);
    bench.run_until(bench.now + from_us(40));
  }
  unsigned first_id() const { return GetParam() ? 1 : 0; }

  BissBBench bench;
};

// 0x5F has the CRC 0000 with 0x13, 1111 on the line (by hand, with the rule of docs/theory.md,
// CRC).
TEST_P(BissBAccess, Read_AnswersBehindTheStopBit) {
  auto& slave = bench.add(with_registers());
  slave.reg_write(0x67, 0x5F);
  enter();
  // The slave sends nothing while the master sends; its start bit shows one clock after the cell of
  // the stop bit.
  EXPECT_EQ(bench.send(biss_b_header(first_id(), 0x67, false)), std::string(17, '0'));
  EXPECT_EQ(bench.send(std::string(13, 'c')),
            "0"
            "1"
            "01011111"
            "111");
  EXPECT_TRUE(bench.finish());  // the last CRC bit; this edge brings the stop bit
  EXPECT_FALSE(bench.chain.slo());
  EXPECT_EQ(slave.access().counters().reads, 1U);
  bench.run_until(bench.now + from_us(32) - 1);
  EXPECT_FALSE(bench.chain.slo());
  if (GetParam()) bench.set_mo(bench.now, true);
  bench.run_until(bench.now + 1);
  EXPECT_TRUE(bench.chain.slo());
  EXPECT_TRUE(slave.idle());
}

// Each bit of the master comes back one clock later. 0x06: CRC 1010, inverted 0101.
TEST_P(BissBAccess, Write_IsEchoedOneClockLater) {
  auto& slave = bench.add(with_registers());
  enter();
  bench.send(biss_b_header(first_id(), 0x60, true));
  EXPECT_EQ(bench.send("1"
                       "00000110"
                       "0101"
                       "0"),
            "00"
            "1"
            "00000110"
            "010");
  EXPECT_TRUE(bench.finish());  // the last CRC bit
  EXPECT_EQ(slave.reg_read(0x60), 0x06);
  EXPECT_EQ(slave.access().counters().writes, 1U);
  leave();
  EXPECT_TRUE(bench.chain.slo());
}

TEST_P(BissBAccess, SequentialRead_CountsTheAddressUpAndWraps) {
  auto& slave = bench.add(with_registers());
  for (unsigned a = 0; a < 128; ++a)
    slave.reg_write(static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(a ^ 0x5A));
  enter();
  bench.send(biss_b_header(first_id(), 0x70, false) + "c");
  for (unsigned i = 0; i < 64; ++i) {
    const unsigned address = (0x70 + i) % 128;
    EXPECT_EQ(bench.send(std::string(14, 'c')), byte_frame(address ^ 0x5A, "0")) << i;
  }
  EXPECT_EQ(slave.access().counters().reads, 64U);
}

TEST_P(BissBAccess, SequentialWrite_OfSixtyFourBytes) {
  auto& slave = bench.add(with_registers());
  enter();
  bench.send(biss_b_header(first_id(), 0x60, true));
  for (unsigned i = 0; i < 64; ++i) bench.send(byte_frame(0xFF - i, "0"));
  leave();
  for (unsigned i = 0; i < 64; ++i) {
    EXPECT_EQ(slave.reg_read(static_cast<std::uint8_t>((0x60 + i) % 128)), 0xFF - i);
  }
  EXPECT_EQ(slave.access().counters().writes, 64U);
}

TEST_P(BissBAccess, ReadBusy_HoldsBackTheStartBit) {
  BissBSlaveConfig config = with_registers();
  config.access.read_busy.frames = 5;
  auto& slave = bench.add(config);
  slave.reg_write(0, 0x5F);
  enter();
  bench.send(biss_b_header(first_id(), 0, false));
  EXPECT_EQ(bench.send(std::string(19, 'c')),
            "000000"
            "1"
            "01011111"
            "1111");
  EXPECT_EQ(bench.send(std::string(7, 'c')),
            "000000"
            "1");  // and again for the next byte
}

TEST_P(BissBAccess, ReadBusy_IsAlsoATime) {
  BissBSlaveConfig config = with_registers();
  config.access.read_busy.time = from_us(100);
  auto& slave = bench.add(config);
  slave.reg_write(0, 0x5F);
  enter();
  bench.send(biss_b_header(first_id(), 0, false));
  const Time begin = bench.now;
  unsigned clocks = 0;
  while (!bench.clock(50) && clocks < 1000) ++clocks;
  EXPECT_GE(bench.now - begin, from_us(100));
  EXPECT_LE(bench.now - begin, from_us(100) + 3 * bench.cell);
}

// Any clock of Table 36, with adaptive timeout.
TEST_P(BissBAccess, EveryRegisterClock_IsUnderstood) {
  for (const Time cell : {200 * kPsPerNs, 1600 * kPsPerNs, from_us(51.2), from_us(1024)}) {
    BissBBench each;
    BissBSlaveConfig config = with_registers();
    config.register_timeout = 0;
    auto& slave = each.add(config);
    slave.reg_write(0x12, 0xC4);
    each.cell = cell;
    if (GetParam()) {
      each.set_mo(0, true);
      each.run_until(from_us(2000));
      each.cell = 400 * kPsPerNs;
      each.select_by_mo();
      each.cell = cell;
    } else {
      ASSERT_TRUE(each.hand_over());
    }
    each.send(biss_b_header(first_id(), 0x12, false) + "c");
    EXPECT_EQ(each.send(std::string(13, 'c')), byte_frame(0xC4)) << cell;
    each.finish();
    each.run_until(each.now + 3 * cell / 2);
    EXPECT_TRUE(slave.idle());
  }
}

// --- what must not be answered ----------------------------------------------------------------

TEST_P(BissBAccess, EachInvertedHeaderBit_GivesNoAnswer) {
  for (std::size_t bit = 0; bit < 17; ++bit) {
    BissBBench each;
    auto& slave = each.add(with_registers());
    each.hand_over();
    std::string header = biss_b_header(0, 0x35, false);
    header[bit] ^= 1;
    each.send(header);
    EXPECT_EQ(each.send(std::string(40, 'c')), std::string(40, '0')) << bit;
    EXPECT_EQ(slave.access().counters().reads, 0U);
    EXPECT_EQ(slave.access().counters().header_errors, bit >= 1 && bit <= 15 ? 1U : 0U);
  }
}

TEST_P(BissBAccess, WrongCrcOfWrittenData_IsEchoedButNotWritten) {
  auto& slave = bench.add(with_registers());
  enter();
  bench.send(biss_b_header(first_id(), 0x60, true));
  EXPECT_EQ(bench.send("1"
                       "00000110"
                       "0100"
                       "00"),
            "00"
            "1"
            "00000110"
            "0100");
  EXPECT_EQ(slave.reg_read(0x60), 0);
  EXPECT_EQ(slave.access().counters().data_errors, 1U);
}

TEST_P(BissBAccess, OtherId_IsNotAnswered) {
  bench.add(with_registers());
  enter();
  bench.send(biss_b_header(first_id() + 1, 0, false));
  EXPECT_EQ(bench.send(std::string(40, 'c')), std::string(40, '0'));
}

TEST_P(BissBAccess, MissingRegister_NeverStarts) {
  BissBSlaveConfig config = with_registers();
  config.access.missing.set(0x50);
  auto& slave = bench.add(config);
  enter();
  bench.send(biss_b_header(first_id(), 0x50, false));
  EXPECT_EQ(bench.send(std::string(200, 'c')), std::string(200, '0'));
  leave();
  enter();
  bench.send(biss_b_header(first_id(), 0x50, true));
  EXPECT_EQ(bench.send("1"
                       "00000110"
                       "0101"
                       "0"),
            std::string(14, '0'));
  EXPECT_EQ(slave.reg_read(0x50), 0);
}

// A master whose cells are neither 25 nor 75 % high is not understood.
TEST_P(BissBAccess, HalfHighCellInTheHeader_IsAMistake) {
  auto& slave = bench.add(with_registers());
  enter();
  std::string header = biss_b_header(first_id(), 0, false);
  header[5] = 'c';
  bench.send(header);
  EXPECT_EQ(bench.send(std::string(40, 'c')), std::string(40, '0'));
  EXPECT_EQ(slave.access().counters().protocol_errors, 1U);
}

INSTANTIATE_TEST_SUITE_P(Entry, BissBAccess, testing::Bool(),
                         [](const auto& entry) { return entry.param ? "Mo" : "HandOver"; });

// IDs count from the last slave, several of one device in a row; with MO all are one higher.
TEST(BissBRegisters, Chain_AnswersById) {
  for (const bool by_mo : {false, true}) {
    BissBBench bench;
    BissBSlaveConfig configs[3] = {with_registers(), with_registers(), with_registers()};
    configs[1].access.ids = 2;  // a Hengstler ACURO
    configs[1].access.first_id = 1;
    configs[0].access.first_id = 3;
    BissBSlave* slaves[3];
    for (unsigned i = 0; i < 3; ++i) {
      slaves[i] = &bench.add(configs[i]);
      slaves[i]->registers().set(0x10, static_cast<std::uint8_t>(0x11 * (i + 1)));
      slaves[i]->registers().set(0x90, static_cast<std::uint8_t>(0xA0 + i));
    }
    const unsigned values[] = {0x33, 0x22, 0xA1, 0x11};
    if (by_mo) bench.set_mo(0, true);
    for (unsigned id = 0; id < 4; ++id) {
      bench.run_until(bench.now + from_us(50));
      if (by_mo) {
        bench.select_by_mo();
      } else {
        ASSERT_TRUE(bench.hand_over());
      }
      bench.send(biss_b_header(id + (by_mo ? 1 : 0), 0x10, false) + "c");
      EXPECT_EQ(bench.send(std::string(13, 'c')), byte_frame(values[id])) << id;
      bench.finish();
      if (by_mo) bench.set_mo(bench.now, true);
      bench.run_until(bench.now + from_us(40));
    }
  }
}

}  // namespace
}  // namespace mb4test
