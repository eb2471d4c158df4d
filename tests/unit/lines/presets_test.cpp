// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Presets as a master sees them: over the line, by register access.
#include "sim/lines/presets.hpp"

#include <gtest/gtest.h>

#include "tests/unit/lines/registers/control_bench.hpp"
#include "tests/unit/lines/registers/preset_slave.hpp"

namespace mb4test {

using namespace mb4::sim;

namespace {

using Result = ControlBench::Result;
using Bytes = std::vector<std::uint8_t>;

Bytes read_of(std::string_view preset, unsigned address, unsigned count) {
  ControlBench bench;
  add_preset(bench, preset);
  Bytes data(count);
  EXPECT_EQ(bench.read(0, address, data), Result::kOk) << preset;
  return data;
}

TEST(Presets, WithoutControl_AnswerNothing) {
  for (const char* name : {"resolute-18", "resolute-26", "resolute-32", "resolute-36", "lma10"}) {
    ControlBench bench;
    BissCSlave& slave = add_preset(bench, name);
    EXPECT_EQ(slave.control(), nullptr);
    Bytes data(1);
    EXPECT_EQ(bench.read(0, 0x44, data), Result::kNoEcho) << name;
    EXPECT_EQ(bench.idl, "00000000") << name;
  }
}

TEST(Presets, PublishedIdentification_IsRead) {
  EXPECT_EQ(read_of("lika-sma1", 0x42, 2), (Bytes{0x28, 0x14}));
  EXPECT_EQ(read_of("lika-sma1", 0x55, 1), (Bytes{0x06}));
  EXPECT_EQ(read_of("lika-sma1", 0x78, 4), (Bytes{'S', 'M', 'A', '1'}));
  EXPECT_EQ(read_of("wachendorff-wdgf58m", 0x44, 4), (Bytes{0x00, 0xD9, 0x01, 0x32}));
  EXPECT_EQ(read_of("wachendorff-wdgf58m", 0x78, 8),
            (Bytes{0x46, 0x3A, 0xC0, 0x0C, 0x00, 0x01, 0x57, 0x41}));
}

TEST(Presets, IcMr_Has32Banks) {
  ControlBench bench;
  add_preset(bench, "ic-mr");
  Bytes data(1);
  ASSERT_EQ(bench.write(0, 0x40, {31}), Result::kOk);
  EXPECT_EQ(bench.read(0, 0x00, data), Result::kOk);
  ASSERT_EQ(bench.write(0, 0x40, {32}), Result::kOk);
  EXPECT_EQ(bench.read(0, 0x00, data), Result::kNoStart);
}

// A bus scan: ID, EDS bank, common page, page of the data channel.
TEST(Presets, EdsSensor_DescribesItself) {
  ControlBench bench;
  BissCSlave& slave = add_preset(bench, "eds-sensor");
  Bytes window(15);
  ASSERT_EQ(bench.read(0, 0x78, window), Result::kOk);  // goes on at 0x00
  EXPECT_EQ(Bytes(window.begin(), window.begin() + 8),
            (Bytes{'M', 'B', '4', 'S', 'I', 'M', 'M', '4'}));
  Bytes eds(1);
  ASSERT_EQ(bench.read(0, 0x41, eds), Result::kOk);
  ASSERT_EQ(bench.write(0, 0x40, eds), Result::kOk);
  Bytes page(0x40);
  ASSERT_EQ(bench.read(0, 0x00, page), Result::kOk);
  EXPECT_EQ(page[0x10], 1);
  EXPECT_EQ(page[0x11], 1);
  EXPECT_EQ(page[0x15], slave.data_bits());
  EXPECT_EQ(page[0x17], slave.config().crc.polynomial);
  ASSERT_EQ(bench.write(0, 0x40, {page[0x14]}), Result::kOk);
  ASSERT_EQ(bench.read(0, 0x00, page), Result::kOk);
  EXPECT_EQ(page[0x1F], slave.config().crc.polynomial);
  // The identification cannot be overwritten.
  ASSERT_EQ(bench.write(0, 0x78, {'X'}), Result::kOk);
  EXPECT_EQ(slave.reg_read(0x78), 'M');
}

}  // namespace
}  // namespace mb4test
