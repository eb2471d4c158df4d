// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Tests the reference itself with examples calculated by hand (words and CRC: datasheet pages
// 23 to 26; rule of the CRC: docs/theory.md).
#include "tests/reference/reference.hpp"

#include <gtest/gtest.h>

namespace {

using mb4test::Protocol;
using mb4test::Reference;
using mb4test::Registers;

// Data channel `x` with this register 0xC0, polynomial code and no start value.
void set_channel(Registers& registers, unsigned x, std::uint8_t c0, std::uint8_t c1) {
  registers.slave[4 * x] = c0;
  registers.slave[4 * x + 1] = c1;
}

// 28 bits 1010101011110011011110111111 have the CRC6 0x27 on the line.
TEST(Reference, ActuatorSlot_IsStopBitDataAndInvertedCrc) {
  Registers registers;
  registers.actnsens = 0x02;
  registers.singlebank = true;
  set_channel(registers, 1, 0x80 | 0x40 | 27, 0x06);
  Reference reference;
  const std::uint8_t bytes[] = {0xBF, 0x37, 0xAF, 0x0A};
  for (unsigned i = 0; i < 4; ++i) reference.write(8 + i, bytes[i]);
  const std::string data = "1010101011110011011110111111";
  EXPECT_EQ(reference.actuator_slot(registers, 1), "0" + data + "100111");
  EXPECT_EQ(Reference::frame_bits(registers, 1), 35U);
  registers.slave[4] &= 0x7F;  // LSTOP2 = 0
  EXPECT_EQ(reference.actuator_slot(registers, 1), data + "100111");
}

TEST(Reference, Mo_CarriesZerosForSensorsInTheOrderOfChannels) {
  Registers registers;
  registers.actnsens = 0x05;
  registers.singlebank = true;
  set_channel(registers, 0, 0x80 | 0x40 | 3, 0);
  set_channel(registers, 1, 0x40 | 4, 0x03);  // sensor: 5 + 3 bits
  set_channel(registers, 2, 0x40 | 3, 0);
  Reference reference;
  reference.write(0, 0x0A);
  reference.write(16, 0x05);
  EXPECT_EQ(reference.mo_bits(registers, 1),
            "01010"
            "00000000"
            "0101");
}

// With two banks the host's words go out after the next switch.
TEST(Reference, Actuator_TakesTheBankOnTheBissSide) {
  Registers registers;
  registers.actnsens = 0x01;
  set_channel(registers, 0, 0x40 | 3, 0);
  Reference reference;
  reference.write(0, 0x0F);
  EXPECT_EQ(reference.actuator_slot(registers, 0), "0000");
  reference.frame(registers, {{"00000", ""}});
  EXPECT_EQ(reference.actuator_slot(registers, 0), "1111");
  // The actuator's slot on SL changes nothing that the host sees.
  reference.frame(registers, {{"01111", ""}});
  EXPECT_EQ(reference.svalid_lo(), 0);
  EXPECT_EQ(reference.scdata(0), 0x0F);
}

TEST(Reference, SsiGray_IsDecodedWithoutCds) {
  const char* const codes[] = {"000", "001", "011", "010", "110", "111", "101", "100"};
  Registers registers;
  registers.protocol = {Protocol::kSsi, Protocol::kUnused};
  set_channel(registers, 0, 0x80 | 0x40 | 2, 0);
  Reference reference;
  for (unsigned value = 0; value < 8; ++value) {
    reference.frame(registers, {{codes[value], ""}});
    EXPECT_EQ(reference.scdata(0), value);
    EXPECT_EQ(reference.svalid_lo(), 0x02);
    EXPECT_FALSE(reference.cds(1));
  }
}

// GRAYSx does nothing on a BiSS sensor (decision 29).
TEST(Reference, BissB_HasNoCdsAndNoGray) {
  Registers registers;
  registers.protocol = {Protocol::kBissB, Protocol::kUnused};
  set_channel(registers, 0, 0x80 | 0x40 | 2, 0);
  Reference reference;
  reference.frame(registers, {{"110", ""}});
  EXPECT_EQ(reference.scdata(0), 6);
  EXPECT_FALSE(reference.cds(1));
}

}  // namespace
