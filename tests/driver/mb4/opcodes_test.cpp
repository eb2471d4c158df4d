// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The six opcodes, table 3 and pages 17 to 19.

#include "mb4/opcodes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "tests/driver/mb4/strict_bus.hpp"

namespace {
namespace opcodes_test {

using mb4::Error;
using mb4test::Bytes;
using mb4test::join;
using mb4test::StrictBus;
using mb4test::zeros;

// Page 18: opcode 0x02, address, data.
TEST(Opcodes, WriteRegisters_SendsAddressAndData) {
  StrictBus bus;
  bus.expect_write({0x02, 0xED, 0x01});
  mb4::Opcodes<StrictBus> opcodes(bus);
  const std::array<std::uint8_t, 1> data{0x01};
  EXPECT_TRUE(opcodes.write_registers(0xED, data).ok());
}

// Page 18: opcode 0x03, address, then data at once; received byte i + 2 is data byte i.
TEST(Opcodes, ReadRegisters_DataFollowsAddressWithoutDummy) {
  StrictBus bus;
  bus.expect_read({0x03, 0xEA, 0x00, 0x00}, {0x00, 0x00, 0x20, 0x84});
  mb4::Opcodes<StrictBus> opcodes(bus);
  std::array<std::uint8_t, 2> data{};
  EXPECT_TRUE(opcodes.read_registers(0xEA, data).ok());
  EXPECT_EQ(data[0], 0x20);
  EXPECT_EQ(data[1], 0x84);
}

// Page 18: opcode 0x05, no address; received byte i + 1 is data byte i.
TEST(Opcodes, ReadStatus_DataFollowsOpcode) {
  StrictBus bus;
  bus.expect_read({0x05, 0x00, 0x00}, {0x00, 0xFB, 0x02});
  mb4::Opcodes<StrictBus> opcodes(bus);
  std::array<std::uint8_t, 2> data{};
  EXPECT_TRUE(opcodes.read_status(data).ok());
  EXPECT_EQ(data[0], 0xFB);
  EXPECT_EQ(data[1], 0x02);
}

// Page 18: opcode 0x07, data from 0xF4.
TEST(Opcodes, WriteInstruction_SendsDataAfterOpcode) {
  StrictBus bus;
  bus.expect_write({0x07, 0x04, 0x01});
  mb4::Opcodes<StrictBus> opcodes(bus);
  const std::array<std::uint8_t, 2> data{0x04, 0x01};
  EXPECT_TRUE(opcodes.write_instruction(data).ok());
}

// Page 19: opcode 0x09, data from 0x00.
TEST(Opcodes, ReadRegisters0_DataFollowsOpcode) {
  StrictBus bus;
  bus.expect_read({0x09, 0x00, 0x00, 0x00}, {0x00, 0x11, 0x22, 0x33});
  mb4::Opcodes<StrictBus> opcodes(bus);
  std::array<std::uint8_t, 3> data{};
  EXPECT_TRUE(opcodes.read_registers0(data).ok());
  EXPECT_EQ(data, (std::array<std::uint8_t, 3>{0x11, 0x22, 0x33}));
}

// Page 19: opcode 0x0B, data to 0x00.
TEST(Opcodes, WriteRegisters0_SendsDataAfterOpcode) {
  StrictBus bus;
  bus.expect_write({0x0B, 0x5A, 0xA5});
  mb4::Opcodes<StrictBus> opcodes(bus);
  const std::array<std::uint8_t, 2> data{0x5A, 0xA5};
  EXPECT_TRUE(opcodes.write_registers0(data).ok());
}

TEST(Opcodes, LongestBurst_IsOneTransfer) {
  StrictBus bus;
  bus.expect_read(join({{0x09}, zeros(64)}), zeros(65));
  mb4::Opcodes<StrictBus> opcodes(bus);
  std::array<std::uint8_t, mb4::kMaxBurstBytes> data{};
  EXPECT_TRUE(opcodes.read_registers0(data).ok());
}

TEST(Opcodes, EmptyOrTooLongBurst_IsInvalidArgumentWithoutTransfer) {
  StrictBus bus;
  mb4::Opcodes<StrictBus> opcodes(bus);
  std::array<std::uint8_t, mb4::kMaxBurstBytes + 1> data{};
  EXPECT_EQ(opcodes.read_registers0(data).error(), Error::kInvalidArgument);
  EXPECT_EQ(opcodes.write_registers0(data).error(), Error::kInvalidArgument);
  EXPECT_EQ(opcodes.read_status({}).error(), Error::kInvalidArgument);
  EXPECT_EQ(opcodes.write_instruction({}).error(), Error::kInvalidArgument);
}

TEST(Opcodes, BurstPastLastAddress_IsInvalidArgumentWithoutTransfer) {
  StrictBus bus;
  mb4::Opcodes<StrictBus> opcodes(bus);
  std::array<std::uint8_t, 17> data{};  // 0xF0 + 17 = 0x101, 0xF4 + 13 = 0x101
  EXPECT_EQ(opcodes.read_registers(0xF0, data).error(), Error::kInvalidArgument);
  EXPECT_EQ(opcodes.write_registers(0xF0, data).error(), Error::kInvalidArgument);
  EXPECT_EQ(opcodes.read_status(data).error(), Error::kInvalidArgument);
  EXPECT_EQ(opcodes.write_instruction(mb4::Span<std::uint8_t>(data).first(13)).error(),
            Error::kInvalidArgument);
}

TEST(Opcodes, BurstUpToLastAddress_IsAccepted) {
  StrictBus bus;
  bus.expect_write(join({{0x02, 0xF0}, zeros(16)}));
  mb4::Opcodes<StrictBus> opcodes(bus);
  const std::array<std::uint8_t, 16> data{};
  EXPECT_TRUE(opcodes.write_registers(0xF0, data).ok());
}

TEST(Opcodes, FailedRead_LeavesCallersBufferAlone) {
  StrictBus bus;
  bus.expect_read({0x09, 0x00}, {0xFF, 0xFF}).fail_at(0);
  mb4::Opcodes<StrictBus> opcodes(bus);
  std::array<std::uint8_t, 1> data{0x77};
  EXPECT_EQ(opcodes.read_registers0(data).error(), Error::kTransport);
  EXPECT_EQ(data[0], 0x77);
}

TEST(Opcodes, FailedWrite_IsTransport) {
  StrictBus bus;
  bus.expect_write({0x02, 0x80, 0x00}).fail_at(0);
  mb4::Opcodes<StrictBus> opcodes(bus);
  const std::array<std::uint8_t, 1> data{};
  EXPECT_EQ(opcodes.write_registers(0x80, data).error(), Error::kTransport);
}

// A plain function and a context make a bus too.
struct CContext {
  Bytes seen;
  bool rx_was_null = false;
};

bool c_transfer(void* context, const std::uint8_t* tx, std::uint8_t* rx, std::size_t size) {
  auto* const c = static_cast<CContext*>(context);
  c->seen.assign(tx, tx + size);
  c->rx_was_null = rx == nullptr;
  if (rx != nullptr) {
    rx[size - 1] = 0x84;
  }
  return true;
}

TEST(FunctionBus, ReadAndWrite_ReachTheFunction) {
  CContext context;
  mb4::FunctionBus bus(c_transfer, &context);
  mb4::Opcodes<mb4::FunctionBus> opcodes(bus);
  std::array<std::uint8_t, 1> data{0x01};
  EXPECT_TRUE(opcodes.write_registers(0xED, data).ok());
  EXPECT_EQ(context.seen, (Bytes{0x02, 0xED, 0x01}));
  EXPECT_TRUE(context.rx_was_null);
  EXPECT_TRUE(opcodes.read_registers(0xEB, data).ok());
  EXPECT_EQ(context.seen, (Bytes{0x03, 0xEB, 0x00}));
  EXPECT_FALSE(context.rx_was_null);
  EXPECT_EQ(data[0], 0x84);
}

std::uint32_t c_now_us(void* context) { return (*static_cast<std::uint32_t*>(context))++; }

TEST(FunctionClock, Call_ReachesTheFunction) {
  std::uint32_t time_us = 41;
  mb4::FunctionClock clock(c_now_us, &time_us);
  EXPECT_EQ(clock.now_us(), 41U);
  EXPECT_EQ(clock.now_us(), 42U);
}

}  // namespace opcodes_test
}  // namespace
