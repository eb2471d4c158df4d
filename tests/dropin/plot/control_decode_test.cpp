// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Control frames from worked examples (headers and CRCs of the protocol's documents), some with
// mistakes added.
#include "plot/control_decode.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mb4test {

using namespace mb4::tool;

namespace {

// Slots from 0 on, as strings of bits; 14 zeros are put in front.
std::vector<ControlBits> bits_of(const std::string& cdm, const std::string& cds,
                                 std::size_t zeros = 14) {
  std::vector<ControlBits> bits(zeros, ControlBits{false, false});
  std::string a;
  std::string b;
  for (const char c : cdm) a += c == ' ' ? "" : std::string(1, c);
  for (const char c : cds) b += c == ' ' ? "" : std::string(1, c);
  a.resize(std::max(a.size(), b.size()) + 2, '0');
  b.resize(a.size(), '0');
  for (std::size_t i = 0; i < a.size(); ++i) bits.push_back({a[i] == '1', b[i] == '1'});
  return bits;
}

constexpr const char* kReadCdm = "1 1000 1100111 0010 101 000000000000 0 0";
constexpr const char* kReadCds = "0 10000000 00000000 10 1 01011111 1111 0";
constexpr const char* kWriteCdm = "1 1000 1100000 1011 011 00000110 0101 0 0";
constexpr const char* kWriteCds = "0 10000000 00000000 01 1 00000110 0101 0";

TEST(ControlDecode, WorkedReadAndWrite_AreUnderstood) {
  const ControlFrame read = decode_control(bits_of(kReadCdm, kReadCds));
  EXPECT_EQ(read.text, "read ID 0, 0x67: 0x5F");
  EXPECT_TRUE(read.good);
  EXPECT_EQ(read.slots, 33U);
  const ControlFrame write = decode_control(bits_of(kWriteCdm, kWriteCds));
  EXPECT_EQ(write.text, "write ID 0, 0x60: 0x06");
  EXPECT_TRUE(write.good);
}

TEST(ControlDecode, FewerThan14Zeros_IsNoControlFrame) {
  EXPECT_EQ(decode_control(bits_of(kReadCdm, kReadCds, 13)).slots, 0U);
}

// Every bit of header and data that a check covers: CDM slots 1 to 17, CDS slots 17 to 32.
TEST(ControlDecode, EveryInvertedBit_IsNoticed) {
  for (const bool write : {false, true}) {
    const auto good = write ? bits_of(kWriteCdm, kWriteCds) : bits_of(kReadCdm, kReadCds);
    for (std::size_t slot = 1; slot <= 17; ++slot) {
      auto bits = good;
      bits[14 + slot].cdm = !bits[14 + slot].cdm;
      EXPECT_FALSE(decode_control(bits).good) << "CDM slot " << slot;
    }
    for (std::size_t slot = 17; slot <= 31; ++slot) {
      auto bits = good;
      bits[14 + slot].cds = !bits[14 + slot].cds;
      EXPECT_FALSE(decode_control(bits).good) << "CDS slot " << slot;
    }
  }
}

TEST(ControlDecode, BusySlave_ItsAnswerComesLater) {
  const ControlFrame frame = decode_control(bits_of("1 1000 1100111 0010 101 11 000000000000 0 0",
                                                    "0 10000000 00000000 10 00 1 01011111 1111 0"));
  EXPECT_EQ(frame.text, "read ID 0, 0x67: 0x5F");
  EXPECT_TRUE(frame.good);
  EXPECT_EQ(frame.slots, 35U);
}

TEST(ControlDecode, TwoRegisters_AreOneFrame) {
  const ControlFrame frame =
      decode_control(bits_of("1 1000 1100111 0010 101 000000000000 0 1 000000000000 0 0",
                             "0 10000000 00000000 10 1 01011111 1111 0 1 10100101 0100 0"));
  EXPECT_EQ(frame.text, "read ID 0, 0x67: 0x5F 0xA5");
  EXPECT_TRUE(frame.good);
}

TEST(ControlDecode, NoAnswerAndNoConfirmation_AreNotGood) {
  EXPECT_FALSE(decode_control(bits_of(kReadCdm, "0 10000000 00000000 10")).good);
  const ControlFrame silent = decode_control(bits_of(kReadCdm, "0"));
  EXPECT_FALSE(silent.good);
  EXPECT_EQ(silent.text, "read ID 0, 0x67: not confirmed");
}

TEST(ControlDecode, Commands_HaveTheirHeaders) {
  const ControlFrame all =
      decode_control(bits_of("1 0 00000000 10 1001 1 0 0000000000", "0 10000000"));
  EXPECT_EQ(all.text, "command 2 to all");
  EXPECT_TRUE(all.good);
  const ControlFrame two =
      decode_control(bits_of("1 0 11000000 00 1101 00000000 1 0", "0 11000000 00000000 11000000"));
  EXPECT_EQ(two.text, "command 0 to IDs 0,1, acknowledge tested");
  EXPECT_TRUE(two.good);
  EXPECT_FALSE(
      decode_control(bits_of("1 0 11000000 00 1101 00000000 0 0", "0 11000000 00000000 10000000"))
          .good);
}

}  // namespace
}  // namespace mb4test
