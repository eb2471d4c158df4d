// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Conditions in a slave during a register access: busy times, missing and protected registers,
// banks, and the faults that a test can order.
#include <gtest/gtest.h>

#include "tests/unit/lines/registers/control_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

using Result = ControlBench::Result;
using Bytes = std::vector<std::uint8_t>;

BissCSlaveConfig plain() { return constant_slave(8, 0xA7, 0x43); }

TEST(ControlAccess, ReadBusyFrames_HoldTheStartBitBack) {
  for (const unsigned busy : {0U, 1U, 5U}) {
    ControlBench bench;
    BissCSlaveConfig config = plain();
    config.control.read_busy.frames = busy;
    bench.add(config).reg_write(0x44, 0x5F);
    bench.zeros();
    bench.send(access_header(0, 0x44) + "10");
    const std::string cds = bench.send(std::string(1 + busy, '1') + std::string(13, '0'));
    EXPECT_EQ(cds, std::string(1 + busy, '0') + "1" + data_with_crc(0x5F));
  }
}

TEST(ControlAccess, BusyOver14Frames_IsNoAbort) {
  ControlBench bench;
  BissCSlaveConfig config = plain();
  config.control.read_busy.frames = 40;
  config.control.write_busy.frames = 33;
  BissCSlave& slave = bench.add(config);
  bench.wait_limit = 41;
  EXPECT_EQ(bench.write(0, 0x48, {1, 2, 3}), Result::kOk);
  EXPECT_EQ(slave.reg_read(0x4A), 3);
  Bytes data(2);
  EXPECT_EQ(bench.read(0, 0x49, data), Result::kOk);
  EXPECT_EQ(data, (Bytes{2, 3}));
  bench.wait_limit = 40;
  EXPECT_EQ(bench.read(0, 0x49, data), Result::kNoStart);
  bench.wait_limit = 34;
  EXPECT_EQ(bench.write(0, 0x49, {7}), Result::kOk);
}

TEST(ControlAccess, BusyTime_IsSimulatedTime) {
  ControlBench bench;
  BissCSlaveConfig config = plain();
  config.control.read_busy.time = 100 * kPsPerUs;
  bench.add(config);
  bench.zeros();
  bench.send(access_header(0, 0x44) + "10");
  bench.exchange(true);
  const Time asked = bench.now;
  while (!bench.exchange_after_cds([](bool cds) { return !cds; })) {
  }
  EXPECT_GE(bench.now - asked, 100 * kPsPerUs);
  EXPECT_LE(bench.now - asked, 115 * kPsPerUs);  // two frames of 5 us on top at most
}

// After a write the device stores it: the next access has to wait.
TEST(ControlAccess, StoreBusy_HoldsBackTheNextAccessOnly) {
  ControlBench bench;
  BissCSlaveConfig config = plain();
  config.control.store_busy.frames = 3;
  bench.add(config);
  bench.wait_limit = 1;
  EXPECT_EQ(bench.write(0, 0x48, {1}), Result::kOk);
  EXPECT_EQ(bench.write(0, 0x48, {1, 2}), Result::kNoStart);
  bench.wait_limit = 4;
  EXPECT_EQ(bench.write(0, 0x48, {1, 2, 3}), Result::kOk);
  bench.wait_limit = 3;
  EXPECT_EQ(bench.write(0, 0x48, {1, 2}), Result::kNoStart);
}

TEST(ControlAccess, BusyForever_NeverStarts) {
  ControlBench bench;
  BissCSlaveConfig config = plain();
  config.control.write_busy.frames = BusyTime::kForever;
  BissCSlave& slave = bench.add(config);
  bench.wait_limit = 500;
  EXPECT_EQ(bench.write(0, 0x48, {1}), Result::kNoStart);
  Bytes data(1);
  EXPECT_EQ(bench.read(0, 0x48, data), Result::kOk);
  EXPECT_EQ(slave.reg_read(0x48), 0);
}

TEST(ControlAccess, MasterThatStopsRepeatingS_GetsNoAnswer) {
  ControlBench bench;
  BissCSlaveConfig config = plain();
  config.control.read_busy.frames = 4;
  BissCSlave& slave = bench.add(config);
  bench.zeros();
  bench.send(access_header(0, 0x44) + "1011");
  EXPECT_EQ(bench.send("0111111"), "0000000");
  EXPECT_EQ(slave.control()->counters().protocol_errors, 1U);
}

TEST(ControlAccess, MissingRegister_IsEchoedButNeverStarts) {
  ControlBench bench;
  BissCSlaveConfig config = plain();
  config.control.missing.set(0x48);
  BissCSlave& slave = bench.add(config);
  Bytes data(1);
  EXPECT_EQ(bench.read(0, 0x48, data), Result::kNoStart);
  EXPECT_EQ(bench.write(0, 0x48, {1}), Result::kNoStart);
  EXPECT_EQ(bench.write(0, 0x47, {1, 2}), Result::kNoStart);  // the second one
  EXPECT_EQ(slave.reg_read(0x47), 1);
  EXPECT_EQ(slave.reg_read(0x48), 0);
  EXPECT_EQ(bench.read(0, 0x49, data), Result::kOk);
}

TEST(ControlAccess, ProtectedRegister_TakesNoValue) {
  ControlBench bench;
  BissCSlaveConfig config = plain();
  config.control.write_protected.set(0x44);
  BissCSlave& slave = bench.add(config);
  slave.reg_write(0x44, 0x12);
  EXPECT_EQ(bench.write(0, 0x44, {0x34, 0x56}), Result::kOk);
  EXPECT_EQ(slave.reg_read(0x44), 0x12);
  EXPECT_EQ(slave.reg_read(0x45), 0x56);
}

TEST(ControlAccess, Banks_AppearInTheLowerHalfOfTheWindow) {
  ControlBench bench;
  BissCSlaveConfig config = plain();
  config.control.banks[5].fill(0x55);
  BissCSlave& slave = bench.add(config);
  slave.reg_write(0x07, 0x70);
  Bytes data(1);
  ASSERT_EQ(bench.read(0, 0x07, data), Result::kOk);
  EXPECT_EQ(data[0], 0x70);
  ASSERT_EQ(bench.write(0, 0x40, {5}), Result::kOk);
  ASSERT_EQ(bench.read(0, 0x07, data), Result::kOk);
  EXPECT_EQ(data[0], 0x55);
  ASSERT_EQ(bench.write(0, 0x07, {0x56}), Result::kOk);
  EXPECT_EQ(slave.registers().banks().at(5)[7], 0x56);
  EXPECT_EQ(slave.reg_read(0x07), 0x70);
  // Above the banks nothing changes; a bank that is not there has no registers.
  ASSERT_EQ(bench.write(0, 0x7F, {0x01, 0x02}), Result::kOk);
  EXPECT_EQ(slave.registers().banks().at(5)[0], 0x02);
  ASSERT_EQ(bench.write(0, 0x40, {6}), Result::kOk);
  EXPECT_EQ(bench.read(0, 0x07, data), Result::kNoStart);
  ASSERT_EQ(bench.write(0, 0x40, {0}), Result::kOk);
  EXPECT_EQ(bench.read(0, 0x07, data), Result::kOk);
}

TEST(ControlAccess, WithoutBanks_BankSelectIsAnOrdinaryRegister) {
  ControlBench bench;
  BissCSlave& slave = bench.add(plain());
  slave.reg_write(0x07, 0x70);
  ASSERT_EQ(bench.write(0, 0x40, {5}), Result::kOk);
  Bytes data(1);
  ASSERT_EQ(bench.read(0, 0x07, data), Result::kOk);
  EXPECT_EQ(data[0], 0x70);
}

TEST(ControlAccess, SilentSlave_LocksItsIdOnly) {
  ControlBench bench;
  BissCSlave& slave = bench.add(plain());
  slave.control()->faults().set_silent(true);
  Bytes data(1);
  EXPECT_EQ(bench.read(0, 0x44, data), Result::kNoEcho);
  EXPECT_EQ(bench.idl, "10000000");
  EXPECT_EQ(bench.command(0x80, 1), "00000000");
  EXPECT_TRUE(slave.control()->control_active());
  slave.control()->faults().set_silent(false);
  EXPECT_EQ(bench.read(0, 0x44, data), Result::kOk);
}

TEST(ControlAccess, WrongDataCrc_IsSentWhileOrdered) {
  ControlBench bench;
  BissCSlave& slave = bench.add(plain());
  slave.control()->faults().set_wrong_data_crc(true);
  Bytes data(1);
  EXPECT_EQ(bench.read(0, 0x44, data), Result::kBadData);
  EXPECT_EQ(bench.write(0, 0x44, {1}), Result::kOk);
  slave.control()->faults().set_wrong_data_crc(false);
  EXPECT_EQ(bench.read(0, 0x44, data), Result::kOk);
}

// Each slot of a whole write in turn: the slave takes the inverted bit.
TEST(ControlAccess, FlippedCdm_NeverWritesSomethingElse) {
  for (unsigned slot = 0; slot <= 32; ++slot) {
    ControlBench bench;
    BissCSlave& slave = bench.add(plain());
    slave.control()->faults().flip_cdm_in_slot(slot);
    const Result result = bench.write(0, 0x60, {0x06});
    EXPECT_FALSE(slave.control()->faults().pending()) << slot;
    // P and the end mark come after the byte.
    EXPECT_EQ(result == Result::kOk, slot >= 31) << slot;
    for (unsigned a = 0; a < 128; ++a) {
      const unsigned value = result == Result::kOk && a == 0x60 ? 0x06 : 0;
      EXPECT_EQ(slave.reg_read(static_cast<std::uint8_t>(a)), value) << slot << " " << a;
    }
    EXPECT_EQ(bench.write(0, 0x60, {0x06}), Result::kOk) << slot;  // the next one works
  }
}

TEST(ControlAccess, FlippedCds_InvertsThatBitOnce) {
  ControlBench bench;
  BissCSlave& slave = bench.add(plain());
  slave.reg_write(0x67, 0x5F);
  const std::string good =
      std::string("0") + "1000000000000000" + "101" + data_with_crc(0x5F) + "0";
  for (unsigned slot = 1; slot <= 32; ++slot) {
    slave.control()->faults().flip_cds_in_slot(slot);
    std::string expected = good;
    expected[slot] ^= 1;
    for (const std::string& answer : {expected, good}) {
      bench.zeros();
      EXPECT_EQ(bench.send(start_and(0x8CE54000)), answer) << slot;
    }
  }
}

TEST(ControlAccess, FlippedCdmOfFrame_CountsFramesFromNow) {
  ControlBench bench;
  BissCSlave& slave = bench.add(plain());
  bench.zeros();
  slave.control()->faults().flip_cdm_of_frame(3);
  bench.send("000");
  EXPECT_EQ(slave.control()->counters().starts, 1U);
  EXPECT_FALSE(slave.last_cdm());  // on the line it was 0
}

}  // namespace
}  // namespace mb4test
