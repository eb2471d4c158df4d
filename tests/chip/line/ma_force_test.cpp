// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// MA force bits (page 33, Tables 50..53; CHSEL: page 27, Table 23). The guard at the MA pins ends
// the simulation if a pulse is too short.
#include <gtest/gtest.h>

#include <string>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace reg = mb4::regs;
namespace sim = mb4::sim;

const char kEncoder[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF";

// Table 50..53 by hand: what a line shows with the force bits `bits` (0xF5 bits 7..4) and CHSEL.
bool expected_level(unsigned line, unsigned bits, unsigned chsel) {
  if (chsel == 0) chsel = 1;
  const bool selected = ((chsel >> (line - 1)) & 1U) != 0;
  const bool forced = selected ? (bits & 0x1U) != 0 : (bits & 0x4U) != 0;
  const bool level = selected ? (bits & 0x2U) != 0 : (bits & 0x8U) != 0;
  return forced ? level : true;
}

void expect_good_frame(Chip& chip) {
  chip.configure_slave1(28, reg::kScrclenCrc6, 0x01);
  chip.advance_us(100);
  chip.instruct(reg::kInstrCdm0);
  ASSERT_TRUE(chip.wait_eot());
  EXPECT_EQ(chip.read(reg::kAddrSvalidLo) & reg::SVALID<1>::kMask, reg::SVALID<1>::kMask);
  EXPECT_EQ(chip.read(reg::kAddrScdata, 4), (std::vector<std::uint8_t>{0xBF, 0x37, 0xAF, 0x0A}));
}

// All 16 values of the bits for each CHSEL, with and without a frame before.
TEST(MaForce, EveryCombination_HasTheLevelsOfTheTables) {
  for (const bool frame_before : {false, true}) {
    Chip chip(one_slave(kEncoder));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x04);
    if (frame_before) {
      chip.instruct(reg::kInstrCdm0);
      ASSERT_TRUE(chip.wait_eot());
      chip.advance_us(20);
    }
    for (unsigned chsel = 0; chsel < 4; ++chsel) {
      chip.write(reg::kAddrChsel, {static_cast<std::uint8_t>(chsel)});
      for (unsigned bits = 0; bits < 16; ++bits) {
        chip.write(reg::kAddrIface, {static_cast<std::uint8_t>(bits << 4U)});
        chip.advance_us(2);
        const std::string what =
            "CHSEL " + std::to_string(chsel) + ", bits " + std::to_string(bits);
        EXPECT_EQ(chip.simulator.pin(sim::Pin::kMa1), expected_level(1, bits, chsel)) << what;
        EXPECT_EQ(chip.simulator.pin(sim::Pin::kMa2), expected_level(2, bits, chsel)) << what;
      }
    }
    chip.write(reg::kAddrIface, {0});
    chip.write(reg::kAddrChsel, {0});
    chip.advance_us(20);
    expect_good_frame(chip);
  }
}

// A host that toggles as fast as it can: MA follows with half a period at least.
TEST(MaForce, FasterThanThePeriod_CutsNothingShort) {
  for (const unsigned freqs : {0x00U, 0x01U, 0x09U, 0x0FU, 0x11U, 0x1FU}) {
    Chip chip(one_slave(kEncoder));
    chip.configure_slave1(28, reg::kScrclenCrc6, static_cast<std::uint8_t>(freqs));
    chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
    for (unsigned i = 0; i < 300; ++i) {
      static const std::uint8_t kBytes[] = {0x10, 0x30, 0x00, 0xC0, 0x40, 0x50, 0xF0};
      ASSERT_NO_THROW(chip.write(reg::kAddrIface, {kBytes[(i * i + i / 7) % 7]}))
          << "FREQS " << freqs;
      chip.simulator.advance((i % 13) * 37 * sim::kPsPerNs);
    }
    chip.write(reg::kAddrIface, {0});
    chip.advance_us(50);
    EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1));
    EXPECT_GT(ma_check(chip.simulator.line_end(1)).pulses(), 2U);
  }
}

// A forced line carries no frame: the frame ends with BREAK only.
TEST(MaForce, ForcedLine_CarriesNoFrame) {
  for (const unsigned level : {0x00U, 0x20U}) {
    Chip chip(one_slave(kEncoder));
    chip.configure_slave1(28, reg::kScrclenCrc6, 0x01);
    chip.write(reg::kAddrIface, {static_cast<std::uint8_t>(reg::kMafsForced | level)});
    chip.advance_us(20);
    chip.instruct(reg::kInstrCdm0);
    for (unsigned i = 0; i < 400; ++i) {
      chip.simulator.advance(333 * sim::kPsPerNs);
      ASSERT_EQ(chip.simulator.pin(sim::Pin::kMa1), level != 0);
    }
    EXPECT_FALSE(chip.simulator.pin(sim::Pin::kEot));
    chip.instruct(reg::kBreakAbort);
    chip.write(reg::kAddrIface, {0});
    expect_good_frame(chip);
  }
}

}  // namespace
