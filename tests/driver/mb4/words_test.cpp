// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// SPI frames as accesses to words (decision 45), the page at 0x100, snapshots, and the port of a
// processor that has the chip in its memory.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>

#include "mb4/opcodes.hpp"
#include "mb4/words/memory_bus.hpp"
#include "mb4/words/page.hpp"
#include "mb4/words/port.hpp"
#include "mb4/words/snapshots.hpp"
#include "tests/driver/mb4/strict_bus.hpp"

namespace {
namespace words_test {

using mb4::Error;
using mb4test::Bytes;
using mb4test::hex;
namespace page = mb4::page;

// Notes the accesses. A word that was not written reads its byte addresses inverted. The access
// `broken` fails.
struct Port {
  bool write(std::uint32_t offset, std::uint32_t value, std::uint8_t strobes) {
    char text[40];
    std::snprintf(text, sizeof text, "W%03X %08X/%X ", unsigned{offset}, unsigned{value}, strobes);
    accesses += text;
    return count++ != broken;
  }
  bool read(std::uint32_t offset, std::uint32_t& value) {
    char text[20];
    std::snprintf(text, sizeof text, "R%03X ", unsigned{offset});
    accesses += text;
    const auto found = words.find(offset);
    value = found != words.end() ? found->second : ~(0x03020100U + 0x01010101U * (offset & 0xFFU));
    return count++ != broken;
  }

  std::map<std::uint32_t, std::uint32_t> words;
  std::string accesses;
  std::size_t count = 0;
  std::size_t broken = SIZE_MAX;
};

struct Transferred {
  bool done;
  std::string accesses;
  std::string miso;
};

Transferred transfer(const Bytes& tx, std::size_t miso_bytes, std::size_t broken = SIZE_MAX) {
  Port port;
  port.broken = broken;
  mb4::MemoryBus<Port> bus(port);
  Bytes rx(miso_bytes, 0xAA);
  const bool done = bus.transfer({tx.data(), tx.size()}, {rx.data(), rx.size()});
  return {done, port.accesses, hex(rx)};
}

TEST(MemoryBus, EachOpcode_BecomesItsWords) {
  EXPECT_EQ(transfer({0x02, 0xE6, 1, 2, 3}, 0).accesses, "W0E4 02010000/C W0E8 00000003/1 ");
  EXPECT_EQ(transfer({0x03, 0xE6, 0, 0, 0}, 5).accesses, "R0E4 R0E8 ");
  EXPECT_EQ(transfer({0x03, 0xE6, 0, 0, 0}, 5).miso, "00 00 19 18 17 ");
  EXPECT_EQ(transfer({0x05, 0, 0}, 3).accesses, "R0F0 ");
  EXPECT_EQ(transfer({0x05, 0, 0}, 3).miso, "00 0F 0E ");
  EXPECT_EQ(transfer({0x07, 0x80, 0x01}, 0).accesses, "W0F4 00000180/3 ");
  EXPECT_EQ(transfer({0x09, 0, 0, 0, 0, 0}, 6).accesses, "R000 R004 ");
  EXPECT_EQ(transfer({0x09, 0, 0, 0, 0, 0}, 6).miso, "00 FF FE FD FC FB ");
  EXPECT_EQ(transfer({0x0B, 1, 2, 3, 4, 5}, 0).accesses, "W000 04030201/F W004 00000005/1 ");
}

TEST(MemoryBus, UnknownOpcodeOrNoData_DoesNothing) {
  for (const Bytes& tx :
       {Bytes{}, Bytes{0x02}, Bytes{0x03, 0x10}, Bytes{0x07}, Bytes{0x55, 1, 2}}) {
    const Transferred got = transfer(tx, tx.size());
    EXPECT_TRUE(got.done);
    EXPECT_EQ(got.accesses, "");
  }
}

// A read whose answer nobody wants makes the same accesses.
TEST(MemoryBus, ReadWithoutMiso_StoresNothing) {
  const Transferred got = transfer({0x03, 0xE6, 0, 0, 0}, 0);
  EXPECT_TRUE(got.done);
  EXPECT_EQ(got.accesses, "R0E4 R0E8 ");
  EXPECT_EQ(got.miso, "");
}

TEST(MemoryBus, AddressesWrap) {
  EXPECT_EQ(transfer({0x02, 0xFE, 1, 2, 3}, 0).accesses, "W0FC 02010000/C W000 00000003/1 ");
}

// The core has acted on 0xF4 before anything else reaches it.
TEST(MemoryBus, FirstAccessAfterAnInstruction_WaitsForTheCore) {
  Port port;
  mb4::MemoryBus<Port> bus(port);
  mb4::Opcodes<mb4::MemoryBus<Port>> opcodes(bus);
  std::array<std::uint8_t, 1> byte{0x01};
  ASSERT_TRUE(opcodes.write_instruction(byte).ok());
  EXPECT_EQ(port.accesses, "W0F4 00000001/1 ");
  ASSERT_TRUE(opcodes.read_status(byte).ok());
  EXPECT_EQ(port.accesses, "W0F4 00000001/1 R114 R0F0 ");
  ASSERT_TRUE(opcodes.read_status(byte).ok());
  EXPECT_EQ(port.accesses, "W0F4 00000001/1 R114 R0F0 R0F0 ");
  // 0xF5 alone is no instruction; 0xF4 within a longer write is one.
  port.accesses.clear();
  byte = {0x11};
  ASSERT_TRUE(opcodes.write_registers(0xF5, byte).ok());
  std::array<std::uint8_t, 4> four{};
  ASSERT_TRUE(opcodes.write_registers(0xF1, four).ok());
  ASSERT_TRUE(opcodes.write_instruction(byte).ok());
  EXPECT_EQ(port.accesses,
            "R114 W0F4 00001100/2 W0F0 00000000/E W0F4 00000000/1 R114 W0F4 00000011/1 ");
}

TEST(MemoryBus, StatusAfterSvalidIsCleared_WaitsForTheCore) {
  Port port;
  mb4::MemoryBus<Port> bus(port);
  mb4::Opcodes<mb4::MemoryBus<Port>> opcodes(bus);
  std::array<std::uint8_t, 1> byte{0xFD};
  ASSERT_TRUE(opcodes.write_registers(0xF1, byte).ok());
  ASSERT_TRUE(opcodes.write_registers(0xE6, byte).ok());
  ASSERT_TRUE(opcodes.read_status(byte).ok());
  EXPECT_EQ(port.accesses, "W0F0 0000FD00/2 W0E4 00FD0000/4 R114 R0F0 ");
}

// Data are in the memory when they are read, not only when the status tells of them.
TEST(MemoryBus, DataAfterAStatus_WaitForTheCore) {
  Port port;
  mb4::MemoryBus<Port> bus(port);
  mb4::Opcodes<mb4::MemoryBus<Port>> opcodes(bus);
  std::array<std::uint8_t, 1> byte{};
  ASSERT_TRUE(opcodes.read_status(byte).ok());
  ASSERT_TRUE(opcodes.read_status(byte).ok());
  ASSERT_TRUE(opcodes.read_registers(0xC0, byte).ok());
  EXPECT_EQ(port.accesses, "R0F0 R0F0 R0C0 ");
  for (const unsigned address : {0x00U, 0x3FU, 0x80U, 0xBFU}) {
    ASSERT_TRUE(opcodes.read_status(byte).ok());
    port.accesses.clear();
    ASSERT_TRUE(opcodes.read_registers(static_cast<std::uint8_t>(address), byte).ok());
    EXPECT_EQ(port.accesses.substr(0, 5), "R114 ");
    port.accesses.clear();
    ASSERT_TRUE(opcodes.read_registers0(byte).ok());
    EXPECT_EQ(port.accesses, "R000 ");
  }
}

TEST(MemoryBus, FailedAccess_EndsTheTransfer) {
  EXPECT_FALSE(transfer({0x02, 0xE3, 1, 2, 3}, 0, 0).done);
  EXPECT_EQ(transfer({0x02, 0xE3, 1, 2, 3}, 0, 0).accesses, "W0E0 01000000/8 ");
  EXPECT_FALSE(transfer({0x03, 0xE3, 0, 0}, 4, 1).done);
  // The wait for the core, and the access after it.
  for (const std::size_t broken : {1U, 2U}) {
    Port port;
    port.broken = broken;
    mb4::MemoryBus<Port> bus(port);
    mb4::Opcodes<mb4::MemoryBus<Port>> opcodes(bus);
    std::array<std::uint8_t, 1> byte{};
    ASSERT_TRUE(opcodes.write_instruction(byte).ok());
    EXPECT_EQ(opcodes.read_status(byte).error(), Error::kTransport);
    // It waits again only if the wait has failed.
    port.accesses.clear();
    ASSERT_TRUE(opcodes.read_status(byte).ok());
    EXPECT_EQ(port.accesses, broken == 1 ? "R114 R0F0 " : "R0F0 ");
  }
}

// Expected: the table of the page in docs/buses.md.
TEST(Page, Words_AreDecoded) {
  Port port;
  port.words = {{0x100, 0x454E4301}, {0x104, 0x01020300}, {0x108, 0x83FF},     {0x10C, 0x13},
                {0x114, 0x89ABCDEF}, {0x118, 0x01234567}, {0x168, 0x11223344}, {0x16C, 0x55667788},
                {0x170, 0x5},        {0x174, 77},         {0x178, 0xFFFFFFFE}, {0x17C, 0x9}};
  mb4::Page<Port> words(port);
  const auto identity = words.probe();
  ASSERT_TRUE(identity.ok());
  EXPECT_EQ(identity->major, 1);
  EXPECT_EQ(identity->minor, 2);
  EXPECT_EQ(identity->patch, 3);
  EXPECT_EQ(page::SLAVES::get(identity->features), 8U);
  EXPECT_EQ(words.time().value_or(0), 0x0123456789ABCDEFU);
  port.accesses.clear();
  const auto snapshot = words.snapshot(4);
  ASSERT_TRUE(snapshot.ok());
  EXPECT_EQ(port.accesses, "R168 R16C R170 R174 R178 R17C ");
  EXPECT_EQ(snapshot->word, 0x5566778811223344U);
  EXPECT_TRUE(snapshot->valid);
  EXPECT_FALSE(snapshot->cds);
  EXPECT_TRUE(snapshot->bank_failed);
  EXPECT_EQ(snapshot->frame, 77U);
  EXPECT_EQ(snapshot->latched, 0x9FFFFFFFEU);
  port.accesses.clear();
  EXPECT_EQ(words.take_events().value_or(0),
            page::LOST::kMask | page::ERROR::kMask | page::FRAME::kMask);
  EXPECT_EQ(port.accesses, "R10C W10C 00000013/F ");
  port.words[0x10C] = 0;
  port.accesses.clear();
  EXPECT_EQ(words.take_events().value_or(1), 0);
  ASSERT_TRUE(words.enable(page::FRAME::kMask).ok());
  EXPECT_EQ(port.accesses, "R10C W110 00000001/F ");
}

TEST(Page, WrongUseAndFailedAccess_AreErrors) {
  Port port;
  mb4::Page<Port> words(port);
  EXPECT_EQ(words.snapshot(0).error(), Error::kInvalidArgument);
  EXPECT_EQ(words.snapshot(9).error(), Error::kInvalidArgument);
  EXPECT_EQ(port.accesses, "");
  EXPECT_EQ(words.probe().error(), Error::kNotDetected);
  port.words[0x100] = 0x454E4302;  // another master
  EXPECT_EQ(words.probe().error(), Error::kNotDetected);
  port.words[0x100] = 0x454E4301;
  port.words[0x10C] = 1;
  const auto fails = [&](std::size_t accesses, auto call) {
    for (std::size_t broken = 0; broken < accesses; ++broken) {
      port.count = 0;
      port.broken = broken;
      EXPECT_EQ(call().error(), Error::kTransport) << broken;
    }
    port.broken = SIZE_MAX;
    EXPECT_TRUE(call().ok());
  };
  fails(3, [&] { return words.probe(); });
  fails(2, [&] { return words.time(); });
  fails(6, [&] { return words.snapshot(1); });
  fails(1, [&] { return words.enable(1); });
  fails(2, [&] { return words.take_events(); });
}

mb4::Config two_slaves() {
  mb4::Config config;
  config.ma_hz = 5'000'000;
  config.channels[0].protocol = mb4::Protocol::kBissC;
  for (const unsigned slave : {0U, 1U}) {
    config.slaves[slave].enabled = true;
    config.slaves[slave].data_bits = 12;
    config.slaves[slave].flags = mb4::Flags::kErrorWarning;
    config.slaves[slave].crc_polynomial = 0;
  }
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = 2000;
  return config;
}

class SnapshotsTest : public testing::Test {
 protected:
  void show(unsigned slave, std::uint32_t word, std::uint32_t flags, std::uint32_t frame) {
    const std::uint32_t group = page::snapshot_address(slave);
    port.words[group] = word;
    port.words[group + 4] = 0;
    port.words[group + 8] = flags;
    port.words[group + 12] = frame;
    port.words[group + 16] = 1000 * frame;
    port.words[group + 20] = 0;
  }
  void SetUp() override {
    port.words[0x10C] = 1;
    show(1, 0x123, 1, 10);
    show(2, 0x123, 1, 10);
  }
  Port port;
  mb4::Page<Port> words{port};
  mb4::Snapshots<Port> snapshots{words};
};

TEST_F(SnapshotsTest, EachFrame_IsReadOnce) {
  ASSERT_TRUE(snapshots.begin(two_slaves()).ok());
  EXPECT_EQ(snapshots.poll(1).error(), Error::kNoData);  // of before
  show(1, 0xABC | 3, 1, 11);
  const auto timed = snapshots.poll(1);
  ASSERT_TRUE(timed.ok());
  EXPECT_EQ(timed->reading.position, 0xABCU >> 2 | 0U);
  EXPECT_EQ(timed->reading.slave, 1);
  EXPECT_FALSE(timed->reading.slave_error);
  EXPECT_EQ(timed->latched, 11'000U);
  EXPECT_EQ(timed->frame, 11U);
  EXPECT_EQ(timed->missed, 0U);
  EXPECT_EQ(snapshots.poll(1).error(), Error::kNoData);
  EXPECT_EQ(snapshots.poll(2).error(), Error::kNoData);
  show(1, 0xFF1, 1, 14);
  const auto later = snapshots.poll(1);
  EXPECT_EQ(later.error(), Error::kSlaveError);
  EXPECT_EQ(later.reading().missed, 2U);
  EXPECT_TRUE(later.reading().reading.slave_error);
  EXPECT_FALSE(later.reading().reading.slave_warning);
}

TEST_F(SnapshotsTest, BadWord_IsToldOnceAndOldOneNever) {
  ASSERT_TRUE(snapshots.begin(two_slaves()).ok());
  show(1, 0x003, 0, 11);
  EXPECT_EQ(snapshots.poll(1).error(), Error::kCrc);
  EXPECT_EQ(snapshots.poll(1).error(), Error::kNoData);
  // The other bank still has the word of an older frame.
  show(1, 0x003, 1, 10);
  EXPECT_EQ(snapshots.poll(1).error(), Error::kNoData);
  // A bit above the data, in the same byte, is 1.
  show(1, 0x1003, 1, 12);
  EXPECT_EQ(snapshots.poll(1).error(), Error::kCorrupted);
  EXPECT_EQ(snapshots.poll(1).error(), Error::kNoData);
}

TEST_F(SnapshotsTest, Numbers_Wrap) {
  show(1, 0, 1, 0xFFFF'FFFF);
  ASSERT_TRUE(snapshots.begin(two_slaves()).ok());
  show(1, 0x003, 1, 0);
  const auto timed = snapshots.poll(1);
  ASSERT_TRUE(timed.ok());
  EXPECT_EQ(timed->missed, 0U);
}

TEST_F(SnapshotsTest, WrongUse_IsRefused) {
  EXPECT_EQ(snapshots.poll(1).error(), Error::kInvalidArgument);  // before begin()
  mb4::Config config = two_slaves();
  config.single_bank = true;
  config.frame_start = mb4::FrameStart::kWaitForLine;
  config.frame_period_clk = 0;
  EXPECT_EQ(snapshots.begin(config).error(), Error::kInvalidConfig);
  EXPECT_EQ(snapshots.begin(config).info().field, mb4::ConfigField::kSingleBank);
  config = two_slaves();
  config.slaves[0].data_bits = 65;
  EXPECT_EQ(snapshots.begin(config).error(), Error::kInvalidConfig);
  EXPECT_EQ(port.accesses, "");
  ASSERT_TRUE(snapshots.begin(two_slaves()).ok());
  for (const unsigned slave : {0U, 3U, 9U}) {
    EXPECT_EQ(snapshots.poll(static_cast<std::uint8_t>(slave)).error(), Error::kInvalidArgument);
  }
  port.count = 0;
  port.broken = 3;
  EXPECT_EQ(snapshots.poll(1).error(), Error::kTransport);
  for (std::size_t broken = 0; broken < 14; ++broken) {
    port.count = 0;
    port.broken = broken;
    EXPECT_EQ(snapshots.begin(two_slaves()).error(), Error::kTransport) << broken;
  }
}

// A byte is written only where its strobe is 1.
TEST(MappedPort, EveryStrobe_WritesItsBytes) {
  alignas(4) std::array<std::uint8_t, 16> memory{};
  mb4::MappedPort port(reinterpret_cast<std::uintptr_t>(memory.data()));
  for (unsigned strobes = 1; strobes < 16; ++strobes) {
    memory.fill(0xEE);
    ASSERT_TRUE(port.write(8, 0x44332211, static_cast<std::uint8_t>(strobes)));
    for (unsigned i = 0; i < memory.size(); ++i) {
      const bool written = i >= 8 && i < 12 && ((strobes >> (i - 8)) & 1U) != 0;
      EXPECT_EQ(memory[i], written ? 0x11 * (i - 7) : 0xEE) << strobes << " " << i;
    }
  }
  std::uint32_t value = 0;
  memory = {1, 2, 3, 4, 5, 6, 7, 8};
  ASSERT_TRUE(port.read(4, value));
  EXPECT_EQ(value, 0x08070605U);
}

}  // namespace words_test
}  // namespace
