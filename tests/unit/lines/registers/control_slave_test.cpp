// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Register access: iC-MB4 Rev D2 pages 27, 28; bits of a control frame and golden vectors from TI
// TIDEP0022, tables 7 and 11. The master is the one of control_bench.hpp.
#include "sim/lines/registers/control_slave.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/lines/registers/control_bench.hpp"
#include "tests/unit/lines/registers/preset_slave.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

using Result = ControlBench::Result;
using Bytes = std::vector<std::uint8_t>;

constexpr const char* kZeros14 = "00000000000000";

// Table 7 of TIDEP0022: the frame from CTS on, bit 31 first; table 11: the answer.
struct TiRead {
  std::uint32_t frame;
  std::uint8_t answer;
};
class TiReads : public testing::TestWithParam<TiRead> {};

TEST_P(TiReads, Frame_IsAnsweredBitForBit) {
  ControlBench bench;
  add_preset(bench, "wachendorff-wdgf58m");
  bench.zeros();
  // Slot 0 is S; slots 1 to 32 are the 32 bits.
  const std::string cds = bench.send(start_and(GetParam().frame));
  EXPECT_EQ(cds, std::string("01000000000000000101") + data_with_crc(GetParam().answer) + "0");
}

INSTANTIATE_TEST_SUITE_P(Table11, TiReads,
                         testing::Values(TiRead{0x889B4000, 0x00}, TiRead{0x88BD4000, 0xD9},
                                         TiRead{0x88D74000, 0x01}, TiRead{0x88F14000, 0x32},
                                         TiRead{0x8C174000, 0x0B}, TiRead{0x8CE54000, 0x5F},
                                         TiRead{0x8D014000, 0x00}, TiRead{0x8F0B4000, 0x46},
                                         TiRead{0x8F2D4000, 0x3A}, TiRead{0x8F474000, 0xC0},
                                         TiRead{0x8F614000, 0x0C}, TiRead{0x8F934000, 0x00},
                                         TiRead{0x8FB54000, 0x01}));

TEST(ControlSlave, ReadExample_IsAnsweredSlotBySlot) {
  ControlBench bench;
  BissCSlave& slave = bench.add_slave();
  slave.reg_write(0x67, 0x5F);
  bench.zeros();
  EXPECT_EQ(bench.send("1"
                       "1000110011100101010000000000000"
                       "0"),
            "0"
            "1000000000000000"
            "101"
            "010111111111"
            "0");
  EXPECT_EQ(slave.control()->counters().reads, 1U);
  EXPECT_EQ(slave.control()->counters().protocol_errors, 0U);
}

// TIDEP0022 prints 0x8C13C194 for "write to 0x60": its header CRC is wrong.
TEST(ControlSlave, PrintedWriteFrame_IsNotAnswered) {
  ControlBench bench;
  BissCSlave& slave = bench.add_slave();
  slave.reg_write(0x60, 0x0B);
  bench.zeros();
  EXPECT_EQ(bench.send(start_and(0x8C13C194)), std::string("0") + binary(0x80000000, 32));
  EXPECT_EQ(slave.reg_read(0x60), 0x0B);
  EXPECT_EQ(slave.control()->counters().header_errors, 1U);
}

TEST(ControlSlave, WriteExample_IsEchoedAndStored) {
  ControlBench bench;
  BissCSlave& slave = bench.add_slave();
  bench.zeros();
  EXPECT_EQ(bench.send(start_and(0x8C16C194)),
            "0"
            "1000000000000000"
            "011"
            "000001100101"
            "0");
  EXPECT_EQ(slave.reg_read(0x60), 0x06);
  EXPECT_EQ(slave.control()->counters().writes, 1U);
}

// 14 zeros come before a start bit (page 30 of the datasheet: CDMTIMEOUT); 13 are not enough.
TEST(ControlSlave, StartAfter13Zeros_IsIgnored) {
  ControlBench bench;
  BissCSlave& slave = bench.add_slave();
  bench.send(std::string("1") + std::string(13, '0') + start_and(0x88BD4000));
  EXPECT_EQ(slave.control()->counters().starts, 0U);
  bench.send("1");  // one zero less than needed after the frame's own end: still idle
  bench.zeros(14);
  EXPECT_EQ(bench.send(start_and(0x88BD4000)).substr(1, 8), "10000000");
}

TEST(ControlSlave, FourteenZerosInside_EndTheControlFrame) {
  for (const unsigned after : {1U, 4U, 9U, 12U}) {
    ControlBench bench;
    BissCSlave& slave = bench.add_slave();
    slave.reg_write(0x7F, 0x3C);
    bench.zeros();
    bench.send((std::string("11") + binary(0x3FF, 10)).substr(0, after) + kZeros14);
    EXPECT_EQ(slave.control()->counters().starts, 1U);
    const std::string cds =
        bench.send(access_header(0, 0x7F) + std::string("101") + std::string(14, '0'));
    EXPECT_EQ(cds.substr(17), std::string("101") + data_with_crc(0x3C) + "0") << after;
    EXPECT_EQ(slave.control()->counters().starts, 2U);
  }
}

TEST(ControlSlave, MaHeldLowUntilNextFrame_ChangesNothing) {
  for (const bool hold : {false, true}) {
    ControlBench bench;
    bench.hold_cdm = hold;
    BissCSlave& slave = bench.add_slave();
    EXPECT_EQ(bench.write(0, 0x48, {0xFF, 0x81}), Result::kOk);
    EXPECT_EQ(slave.reg_read(0x48), 0xFF);
    EXPECT_EQ(slave.reg_read(0x49), 0x81);
    Bytes data(2);
    EXPECT_EQ(bench.read(0, 0x48, data), Result::kOk);
    EXPECT_EQ(data, (Bytes{0xFF, 0x81}));
  }
}

TEST(ControlSlave, Sequential64Bytes_AreReadAndWritten) {
  ControlBench bench;
  BissCSlave& slave = bench.add_slave();
  Bytes out(64);
  for (unsigned i = 0; i < 64; ++i) out[i] = static_cast<std::uint8_t>(i * 37 + 5);
  ASSERT_EQ(bench.write(0, 0x20, out), Result::kOk);
  for (unsigned i = 0; i < 64; ++i) {
    EXPECT_EQ(slave.reg_read(static_cast<std::uint8_t>(0x20 + i)), out[i]);
  }
  Bytes in(64);
  ASSERT_EQ(bench.read(0, 0x20, in), Result::kOk);
  EXPECT_EQ(in, out);
  EXPECT_EQ(slave.control()->counters().starts, 2U);
  EXPECT_EQ(slave.control()->counters().protocol_errors, 0U);
}

TEST(ControlSlave, SequentialPast0x7F_GoesOnAt0x00) {
  ControlBench bench;
  BissCSlave& slave = bench.add_slave();
  ASSERT_EQ(bench.write(0, 0x7E, {1, 2, 3, 4}), Result::kOk);
  EXPECT_EQ(slave.reg_read(0x7E), 1);
  EXPECT_EQ(slave.reg_read(0x7F), 2);
  EXPECT_EQ(slave.reg_read(0x00), 3);
  EXPECT_EQ(slave.reg_read(0x01), 4);
  EXPECT_EQ(slave.reg_read(0x80), 0);
}

TEST(ControlSlave, WrongDataCrc_IsEchoedButNotStored) {
  ControlBench bench;
  BissCSlave& slave = bench.add_slave();
  bench.zeros();
  const std::string wrong = "000001100100";
  EXPECT_EQ(bench.send(access_header(0, 0x60) + "011" + wrong + "00").substr(20), wrong + "0");
  EXPECT_EQ(slave.reg_read(0x60), 0);
  EXPECT_EQ(slave.control()->counters().data_errors, 1U);
}

TEST(ControlSlave, OtherId_IsNotEchoed) {
  ControlBench bench;
  bench.add_slave();
  for (unsigned id = 1; id < 8; ++id) {
    Bytes data(1);
    EXPECT_EQ(bench.read(id, 0x44, data), Result::kNoEcho);
  }
}

// The slave locks IDs from the far end on (datasheet page 27: IDL figure is missing; BiSS C).
class Chains : public testing::TestWithParam<unsigned> {};

TEST_P(Chains, EachSlave_LocksItsOwnIdAndAnswersToIt) {
  const unsigned n = GetParam();
  ControlBench bench;
  std::vector<BissCSlave*> slaves;
  for (unsigned i = 0; i < n; ++i) {
    slaves.push_back(&bench.add_slave());
    slaves.back()->reg_write(0x44, static_cast<std::uint8_t>(0x50 + i));
  }
  for (unsigned id = 0; id < 8; ++id) {
    Bytes data(1);
    const Result result = bench.read(id, 0x44, data);
    EXPECT_EQ(bench.idl, std::string(n, '1') + std::string(8 - n, '0'));
    if (id >= n) {
      EXPECT_EQ(result, Result::kNoEcho) << id;
      continue;
    }
    const unsigned index = n - 1 - id;  // ID 0 is the last slave
    ASSERT_EQ(result, Result::kOk) << id;
    EXPECT_EQ(data[0], 0x50 + index);
    EXPECT_EQ(slaves[index]->control()->ids(), 1U << id);
    ASSERT_EQ(bench.write(id, 0x50, {static_cast<std::uint8_t>(id + 1)}), Result::kOk);
    EXPECT_EQ(slaves[index]->reg_read(0x50), id + 1);
  }
  for (unsigned i = 0; i < n; ++i) EXPECT_EQ(slaves[i]->control()->counters().writes, 1U);
}

INSTANTIATE_TEST_SUITE_P(Slaves, Chains, testing::Range(1U, 9U));

TEST(ControlSlave, SeveralIds_LockARowAndWidenTheAddress) {
  ControlBench bench;
  BissCSlave& near = bench.add_slave();
  BissCSlaveConfig wide = constant_slave(8, 0, 0);
  wide.control.ids = 2;  // as Hengstler ACURO
  BissCSlave& far = bench.add(wide);
  near.reg_write(0x10, 0x11);
  far.reg_write(0x10, 0x22);
  far.reg_write(0x90, 0x33);
  Bytes data(1);
  for (const auto& [id, value] : {std::pair{0U, 0x22}, {1U, 0x33}, {2U, 0x11}}) {
    ASSERT_EQ(bench.read(id, 0x10, data), Result::kOk);
    EXPECT_EQ(bench.idl, "11100000");
    EXPECT_EQ(data[0], value);
  }
  EXPECT_EQ(bench.read(3, 0x10, data), Result::kNoEcho);
}

TEST(ControlSlave, NoControl_SendsZeroAndForwardsTheOthers) {
  ControlBench bench;
  BissCSlaveConfig deaf = constant_slave(8, 0, 0);
  deaf.control.present = false;
  BissCSlave& near = bench.add(deaf);
  BissCSlave& far = bench.add_slave();
  far.reg_write(0x44, 0x77);
  EXPECT_EQ(near.control(), nullptr);
  Bytes data(1);
  EXPECT_EQ(bench.read(0, 0x44, data), Result::kOk);
  EXPECT_EQ(data[0], 0x77);
  EXPECT_EQ(bench.idl, "10000000");
}

TEST(ControlSlave, RandomAccesses_LeaveWhatWasWritten) {
  ControlBench bench;
  std::vector<BissCSlave*> slaves;
  for (unsigned i = 0; i < 3; ++i) slaves.push_back(&bench.add_slave());
  std::vector<Bytes> expected(3, Bytes(128));
  std::mt19937 random(5);
  const auto draw = [&](unsigned limit) { return static_cast<unsigned>(random() % limit); };
  for (int round = 0; round < 60; ++round) {
    const unsigned id = draw(3);
    const unsigned address = draw(128);
    Bytes data(1 + draw(5));
    Bytes& memory = expected[2 - id];
    if (draw(2) == 0) {
      for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(draw(256));
      ASSERT_EQ(bench.write(id, address, data), Result::kOk);
      for (unsigned i = 0; i < data.size(); ++i) memory[(address + i) % 128] = data[i];
    } else {
      ASSERT_EQ(bench.read(id, address, data), Result::kOk);
      for (unsigned i = 0; i < data.size(); ++i) EXPECT_EQ(data[i], memory[(address + i) % 128]);
    }
  }
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned a = 0; a < 128; ++a) {
      EXPECT_EQ(slaves[i]->reg_read(static_cast<std::uint8_t>(a)), expected[i][a]);
    }
    EXPECT_EQ(slaves[i]->control()->counters().protocol_errors, 0U);
  }
}

}  // namespace
}  // namespace mb4test
