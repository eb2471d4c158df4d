// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BiSS commands in slaves: iC-MB4 Rev D2 page 29; slots and effects as in docs/choices.md.
#include <gtest/gtest.h>

#include "tests/unit/lines/registers/control_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

using Result = ControlBench::Result;
using Bytes = std::vector<std::uint8_t>;

constexpr unsigned kSlaveBits = 8 + 6;
constexpr const char* kNoIda = "00000000";

// Three slaves, slave 1 (ID 2) sends 0x11, slave 2 0x22, slave 3 (ID 0) 0x33.
struct ThreeSlaves : ControlBench {
  BissCSlave& near = add(constant_slave(8, 0x11, 0x43));
  BissCSlave& middle = add(constant_slave(8, 0x22, 0x43));
  BissCSlave& far = add(constant_slave(8, 0x33, 0x43));

  // Data bits of the next frame, 42 of them.
  std::string data() {
    set_line_bits(3 * kSlaveBits);
    exchange(false);
    return last_frame.substr(4);
  }
};

std::string word(unsigned value) {
  return binary(value, 8) + binary(Crc{0x43, 0}.line_bits(value, 8), 6);
}
std::string padded(std::string bits) {
  bits.resize(3 * kSlaveBits + 1, '0');
  return bits;
}

TEST(ControlCommand, Headers_AreTheComputedOnes) {
  // The values were worked out by hand: nCRC after CTS, IDS and CMD.
  EXPECT_EQ(command_header(0x00, 0), "1000000000001111");
  EXPECT_EQ(command_header(0x00, 1), "1000000000011100");
  EXPECT_EQ(command_header(0x00, 2), "1000000000101001");
  EXPECT_EQ(command_header(0x80, 0), "1010000000000010");
  EXPECT_EQ(command_header(0x40, 0), "1001000000000000");
  EXPECT_EQ(command_header(0xC0, 0), "1011000000001101");
  EXPECT_EQ(command_header(0x01, 0), "1000000001000011");
  EXPECT_EQ(command_header(0x80, 1), "1010000000010001");
}

TEST(ControlCommand, Broadcast00_SwitchesAllDataChannelsOff) {
  ThreeSlaves bench;
  ASSERT_EQ(bench.data(), padded(word(0x11) + word(0x22) + word(0x33)));
  EXPECT_EQ(bench.command(0x00, 0), kNoIda);  // a broadcast is not acknowledged
  EXPECT_EQ(bench.data(), padded(""));
  EXPECT_FALSE(bench.near.control()->data_active());
  EXPECT_EQ(bench.near.control()->counters().commands, 1U);
  EXPECT_EQ(bench.near.control()->last_command().ids, 0);
  // The master can still reach registers, with frames without data.
  bench.set_line_bits(0);
  EXPECT_EQ(bench.write(1, 0x48, {0x99}), Result::kOk);
  EXPECT_EQ(bench.middle.reg_read(0x48), 0x99);
}

TEST(ControlCommand, Addressed00_SwitchesThatDataChannelOn) {
  ThreeSlaves bench;
  bench.command(0x00, 0);
  EXPECT_EQ(bench.command(0x40, 0), "01000000");
  EXPECT_EQ(bench.data(), padded(word(0x22)));
  EXPECT_EQ(bench.command(0x80, 0), "10000000");
  EXPECT_EQ(bench.data(), padded(word(0x22) + word(0x33)));
  EXPECT_EQ(bench.command(0x20, 0), "00100000");
  EXPECT_EQ(bench.data(), padded(word(0x11) + word(0x22) + word(0x33)));
}

TEST(ControlCommand, SeveralIds_AreAcknowledgedAndFollowTogether) {
  ThreeSlaves bench;
  bench.command(0x00, 0);
  EXPECT_EQ(bench.command(0xA0, 0), "10100000");
  EXPECT_EQ(bench.data(), padded(word(0x11) + word(0x33)));
}

TEST(ControlCommand, MissingId_IsNotAcknowledged) {
  ThreeSlaves bench;
  EXPECT_EQ(bench.command(0x10, 3), kNoIda);
  EXPECT_EQ(bench.command(0x90, 3), "10000000");
  EXPECT_EQ(bench.near.control()->counters().commands, 0U);
  EXPECT_EQ(bench.far.control()->counters().commands, 1U);
  EXPECT_EQ(bench.far.control()->last_command().code, 3);
  EXPECT_EQ(bench.far.control()->last_command().ids, 0x90);
}

TEST(ControlCommand, EffectComesWithP_NotBefore) {
  ThreeSlaves bench;
  bench.set_line_bits(3 * kSlaveBits);
  bench.zeros();
  bench.send(command_header(0x00, 0) + "1");
  EXPECT_TRUE(bench.far.control()->data_active());
  bench.exchange(false);  // P
  EXPECT_EQ(bench.last_frame.substr(4), padded(word(0x11) + word(0x22) + word(0x33)));
  EXPECT_FALSE(bench.far.control()->data_active());
}

TEST(ControlCommand, Addressed01_TakesASlaveOutAndTheNextGetsItsId) {
  ThreeSlaves bench;
  bench.far.reg_write(0x44, 0x33);
  bench.middle.reg_write(0x44, 0x22);
  EXPECT_EQ(bench.command(0x80, 1), "10000000");  // IDA is still sent completely
  EXPECT_FALSE(bench.far.control()->control_active());
  Bytes data(1);
  ASSERT_EQ(bench.read(0, 0x44, data), Result::kOk);
  EXPECT_EQ(data[0], 0x22);
  EXPECT_EQ(bench.idl, "11000000");
  EXPECT_EQ(bench.data(), padded(word(0x11) + word(0x22) + word(0x33)));
  EXPECT_EQ(bench.command(0x00, 1), kNoIda);
  ASSERT_EQ(bench.read(0, 0x44, data), Result::kOk);
  EXPECT_EQ(data[0], 0x33);
  EXPECT_EQ(bench.idl, "11100000");
}

TEST(ControlCommand, Code10_MovesBusCouplers) {
  ThreeSlaves bench;
  bench.command(0x40, 2);
  EXPECT_TRUE(bench.middle.control()->coupler_on_line());
  EXPECT_FALSE(bench.near.control()->coupler_on_line());
  bench.command(0x00, 2);
  EXPECT_FALSE(bench.middle.control()->coupler_on_line());
}

// With a test of IDA, EX comes in slot 24 and P in 25. The zeros in between are no abort: with ID 1
// there are 20 of them.
TEST(ControlCommand, TestedExecution_WaitsForLateEx) {
  ThreeSlaves bench;
  bench.command(0x00, 0);
  bench.zeros();
  bench.send(command_header(0x40, 0));
  EXPECT_EQ(bench.send("0"), "0");  // slot 16
  EXPECT_EQ(bench.send("0000000"), "0100000");
  EXPECT_EQ(bench.send("1"), "0");  // slot 24: IDA7 and EX
  EXPECT_FALSE(bench.middle.control()->data_active());
  bench.exchange(false);  // P
  EXPECT_TRUE(bench.middle.control()->data_active());
  EXPECT_EQ(bench.data(), padded(word(0x22)));
  for (BissCSlave* slave : {&bench.near, &bench.middle, &bench.far}) {
    EXPECT_EQ(slave->control()->counters().starts, 2U);  // no EX taken for a start bit
    EXPECT_EQ(slave->control()->counters().aborts, 0U);
  }
}

TEST(ControlCommand, TestedAndRefused_HasNoEffect) {
  ThreeSlaves bench;
  bench.zeros();
  bench.send(command_header(0x80, 1) + "000000000" + "0");
  EXPECT_TRUE(bench.far.control()->control_active());
  EXPECT_EQ(bench.far.control()->counters().commands, 0U);
  Bytes data(1);
  EXPECT_EQ(bench.read(0, 0x44, data), Result::kOk);
}

TEST(ControlCommand, WrongHeaderCrc_HasNoEffect) {
  ThreeSlaves bench;
  bench.zeros();
  bench.send(
      "1000000000001110"
      "1"
      "0");
  EXPECT_TRUE(bench.far.control()->data_active());
  EXPECT_EQ(bench.far.control()->counters().header_errors, 1U);
}

}  // namespace
}  // namespace mb4test
