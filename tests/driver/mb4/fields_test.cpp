// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Typed field access.

#include "mb4/fields.hpp"

#include <gtest/gtest.h>

#include "tests/driver/mb4/strict_bus.hpp"

namespace {
namespace fields_test {

using mb4::Error;
using mb4test::StrictBus;

mb4::Fields<StrictBus> fields_of(StrictBus& bus) {
  return mb4::Fields<StrictBus>(mb4::Opcodes<StrictBus>(bus));
}

// Table 36: FREQR is bits 7:5 of 0xE6; 0xA4 holds 5.
TEST(Fields, Get_ReturnsRightAlignedValue) {
  StrictBus bus;
  bus.expect_read({0x03, 0xE6, 0x00}, {0x00, 0x00, 0xA4});
  const mb4::Result<std::uint8_t> value = fields_of(bus).get<mb4::regs::FREQR>();
  ASSERT_TRUE(value.ok());
  EXPECT_EQ(*value, 5);
}

// Table 8: CFGCH2 is bits 3:2 of 0xED; the neighbour CFGCH1 keeps its value.
TEST(Fields, Modify_KeepsNeighbours) {
  StrictBus bus;
  bus.expect_read({0x03, 0xED, 0x00}, {0x00, 0x00, 0x0D});
  bus.expect_write({0x02, 0xED, 0x09});
  EXPECT_TRUE(fields_of(bus).modify<mb4::regs::CFGCH2>(mb4::regs::Protocol::kSsi).ok());
}

// Table 35: FREQS is bits 4:0 of 0xE6.
TEST(Fields, ModifyConstant_KeepsNeighbours) {
  StrictBus bus;
  bus.expect_read({0x03, 0xE6, 0x00}, {0x00, 0x00, 0xA4});
  bus.expect_write({0x02, 0xE6, 0xBF});
  EXPECT_TRUE((fields_of(bus).modify<mb4::regs::FREQS, 0x1F>()).ok());
}

TEST(Fields, ModifyValueTooLarge_IsInvalidArgumentWithoutTransfer) {
  StrictBus bus;
  EXPECT_EQ(fields_of(bus).modify<mb4::regs::FREQS>(0x20).error(), Error::kInvalidArgument);
  EXPECT_EQ(fields_of(bus).modify<mb4::regs::FREQS>(-1).error(), Error::kInvalidArgument);
  EXPECT_EQ(fields_of(bus).modify<mb4::regs::FREQS>(0x104U).error(), Error::kInvalidArgument);
}

TEST(Fields, TransportFailure_IsReportedFromEachTransfer) {
  for (const std::size_t index : {0U, 1U}) {
    StrictBus bus;
    bus.expect_read({0x03, 0xE6, 0x00}, {0x00, 0x00, 0xA4});
    bus.expect_write({0x02, 0xE6, 0xA0});
    bus.fail_at(index);
    EXPECT_EQ((fields_of(bus).modify<mb4::regs::FREQS, 0>()).error(), Error::kTransport) << index;
  }
  StrictBus bus;
  bus.expect_read({0x03, 0xF8, 0x00}, {0x00, 0x00, 0x55}).fail_at(0);
  EXPECT_EQ(fields_of(bus).get<mb4::regs::SL1>().error(), Error::kTransport);
}

}  // namespace fields_test
}  // namespace
