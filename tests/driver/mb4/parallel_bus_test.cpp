// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// SPI frames as bus cycles: table 3 on one side, pages 9 and 17 on the other.

#include "mb4/parallel_bus.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "mb4/opcodes.hpp"
#include "tests/driver/mb4/strict_bus.hpp"

namespace {
namespace parallel_bus_test {

using mb4test::Bytes;
using mb4test::hex;

// Notes the cycles; a read answers with its address inverted. The cycle `broken` fails.
struct Port {
  bool write(std::uint8_t address, std::uint8_t value) {
    cycles += 'W';
    cycles += hex({address, value});
    return count++ != broken;
  }
  bool read(std::uint8_t address, std::uint8_t& value) {
    cycles += 'R';
    cycles += hex({address});
    value = static_cast<std::uint8_t>(~address);
    return count++ != broken;
  }

  std::string cycles;
  std::size_t count = 0;
  std::size_t broken = SIZE_MAX;
};

struct Transferred {
  bool done;
  std::string cycles;
  std::string miso;
};

Transferred transfer(const Bytes& tx, std::size_t miso_bytes, std::size_t broken = SIZE_MAX) {
  Port port;
  port.broken = broken;
  mb4::ParallelBus<Port> bus(port);
  Bytes rx(miso_bytes, 0xAA);
  const bool done = bus.transfer({tx.data(), tx.size()}, {rx.data(), rx.size()});
  return {done, port.cycles, hex(rx)};
}

TEST(ParallelBus, EachOpcode_BecomesItsCycles) {
  EXPECT_EQ(transfer({0x02, 0xE6, 1, 2}, 0).cycles, "WE6 01 WE7 02 ");
  EXPECT_EQ(transfer({0x03, 0xE6, 0, 0}, 4).cycles, "RE6 RE7 ");
  EXPECT_EQ(transfer({0x03, 0xE6, 0, 0}, 4).miso, "00 00 19 18 ");
  EXPECT_EQ(transfer({0x05, 0, 0}, 3).cycles, "RF0 RF1 ");
  EXPECT_EQ(transfer({0x05, 0, 0}, 3).miso, "00 0F 0E ");
  EXPECT_EQ(transfer({0x07, 0x80, 0x03}, 0).cycles, "WF4 80 WF5 03 ");
  EXPECT_EQ(transfer({0x09, 0, 0}, 3).cycles, "R00 R01 ");
  EXPECT_EQ(transfer({0x0B, 7}, 0).cycles, "W00 07 ");
}

TEST(ParallelBus, MisoNotWanted_CyclesAreMade) {
  EXPECT_EQ(transfer({0x05, 0, 0}, 0).cycles, "RF0 RF1 ");
}

TEST(ParallelBus, AddressBehindFF_Wraps) {
  EXPECT_EQ(transfer({0x02, 0xFF, 1, 2}, 0).cycles, "WFF 01 W00 02 ");
}

// As on SPI: nothing happens, and MISO is 0.
TEST(ParallelBus, UnknownOrIncompleteFrame_MakesNoCycle) {
  for (const Bytes& tx : {Bytes{0x04, 0x00, 0x00}, Bytes{0x02}, Bytes{0x03}, Bytes{}}) {
    const Transferred result = transfer(tx, tx.size());
    EXPECT_TRUE(result.done);
    EXPECT_EQ(result.cycles, "");
    EXPECT_EQ(result.miso, hex(mb4test::zeros(tx.size())));
  }
}

TEST(ParallelBus, FailedCycle_EndsTheFrame) {
  const Transferred written = transfer({0x02, 0xE6, 1, 2, 3}, 0, 1);
  EXPECT_FALSE(written.done);
  EXPECT_EQ(written.cycles, "WE6 01 WE7 02 ");
  const Transferred read = transfer({0x05, 0, 0}, 3, 0);
  EXPECT_FALSE(read.done);
  EXPECT_EQ(read.cycles, "RF0 ");
}

TEST(ParallelBus, FailedCycleBelowTheDriver_IsTransport) {
  Port port;
  port.broken = 0;
  mb4::ParallelBus<Port> bus(port);
  mb4::Opcodes<mb4::ParallelBus<Port>> opcodes(bus);
  std::uint8_t byte = 0;
  EXPECT_EQ(opcodes.read_status({&byte, 1}).error(), mb4::Error::kTransport);
}

}  // namespace parallel_bus_test
}  // namespace
