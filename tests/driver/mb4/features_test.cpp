// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Cores with fewer features: a Config that asks for something absent is refused, with the member.

#include "mb4/config/features.hpp"

#include <gtest/gtest.h>

#include "mb4_page_regs.hpp"
#include "tests/driver/mb4/encoder26.hpp"

namespace {
namespace features_test {

using mb4::Config;
using mb4::ConfigField;
using mb4::Features;
using mb4test::encoder26;

// One BiSS C encoder with CRC 0x43 fits every core.
static_assert(mb4::validate(encoder26(), mb4::kFullCore).ok());
static_assert(mb4::validate(encoder26(), mb4::kDriveCore).ok());
static_assert(mb4::validate(encoder26(), mb4::kSingleCore).ok());
static_assert(mb4::validate(encoder26(), mb4::kReaderCore).ok());

template <typename Change>
Config changed(Change change) {
  Config config = encoder26();
  change(config);
  return config;
}

void expect_refused(const Config& config, const Features& core, ConfigField field,
                    unsigned number) {
  EXPECT_TRUE(mb4::validate(config).ok());
  const mb4::ErrorInfo info = mb4::validate(config, core).info();
  EXPECT_EQ(info.code, mb4::Error::kInvalidConfig);
  EXPECT_EQ(info.field, field) << to_string(info.field);
  EXPECT_EQ(info.number, number);
  EXPECT_TRUE(mb4::validate(config, mb4::kFullCore).ok());
}

TEST(Features, WhatNoCoreCanDo_IsNamedFirst) {
  const Config wrong = changed([](Config& c) { c.slaves[0].data_bits = 65; });
  EXPECT_EQ(mb4::validate(wrong, mb4::kFullCore).info().field, ConfigField::kDataBits);
}

TEST(Features, WhatTheCoreLacks_IsNamed) {
  const Config biss_b = changed([](Config& c) { c.channels[0].protocol = mb4::Protocol::kBissB; });
  expect_refused(biss_b, mb4::kSingleCore, ConfigField::kChannelProtocol, 1);
  const Config ssi = changed([](Config& c) {
    c.channels[0].protocol = mb4::Protocol::kSsi;
    c.slaves[0].crc_polynomial = 0;
  });
  expect_refused(ssi, mb4::kReaderCore, ConfigField::kChannelProtocol, 1);
  const Config channel2 = changed([](Config& c) {
    c.channels[1].protocol = mb4::Protocol::kBissC;
    c.slaves[4] = c.slaves[0];
  });
  expect_refused(channel2, mb4::kSingleCore, ConfigField::kChannelProtocol, 2);
  EXPECT_TRUE(mb4::validate(channel2, mb4::kDriveCore).ok());
  const Config slave3 = changed([](Config& c) { c.slaves[2] = c.slaves[0]; });
  expect_refused(slave3, mb4::kDriveCore, ConfigField::kSlaveEnabled, 3);
  // SCDATA5 is on channel 1 here, and a core with two slaves on a line has it on line 2 only.
  const Config slave5 = changed([](Config& c) { c.slaves[4] = c.slaves[0]; });
  expect_refused(slave5, mb4::kDriveCore, ConfigField::kSlaveEnabled, 5);
  const Config slave7 = changed([](Config& c) {
    c.channels[1].protocol = mb4::Protocol::kBissC;
    c.slaves[6] = c.slaves[0];
  });
  expect_refused(slave7, mb4::kDriveCore, ConfigField::kSlaveEnabled, 7);
  const Config crc = changed([](Config& c) { c.slaves[0].crc_polynomial = 0x25; });
  expect_refused(crc, mb4::kReaderCore, ConfigField::kCrcPolynomial, 1);
  EXPECT_TRUE(mb4::validate(crc, mb4::kSingleCore).ok());
  const Config crc16 = changed([](Config& c) { c.slaves[0].crc_polynomial = 0x190D9; });
  EXPECT_TRUE(mb4::validate(crc16, mb4::kReaderCore).ok());
  const Config no_crc = changed([](Config& c) { c.slaves[0].crc_polynomial = 0; });
  EXPECT_TRUE(mb4::validate(no_crc, mb4::kReaderCore).ok());
  const Config crc6 = changed([](Config& c) { c.slaves[0].crc_polynomial = 0x43; });
  EXPECT_TRUE(mb4::validate(crc6, mb4::kReaderCore).ok());
  expect_refused(changed([](Config& c) { c.mo = true; }), mb4::kSingleCore, ConfigField::kMo, 0);
  Features no_gray;
  no_gray.gray = false;
  Config gray = ssi;
  gray.slaves[0].gray = true;
  expect_refused(gray, no_gray, ConfigField::kGray, 1);
  Features one_bank;
  one_bank.banks = 1;
  expect_refused(encoder26(), one_bank, ConfigField::kSingleBank, 0);
  EXPECT_TRUE(mb4::validate(changed([](Config& c) { c.single_bank = true; }), one_bank).ok());
}

// The presets of the RTL, and their byte at 0x7F: bit 7, and bits 6 to 0 of the word FEATURES.
TEST(Features, ByteOfAPreset_TellsWhatThePresetHas) {
  namespace page = mb4::page;
  static_assert(mb4::kFeaturesAddress == page::kFeaturesByte);
  const struct {
    Features core;
    unsigned word;
  } presets[] = {{mb4::kDriveCore, page::kFeaturesDrive},
                 {mb4::kSingleCore, page::kFeaturesSingle},
                 {mb4::kReaderCore, page::kFeaturesReader}};
  for (const auto& preset : presets) {
    const Features told =
        mb4::features_of(static_cast<std::uint8_t>(0x80U | (preset.word & 0x7FU)));
    EXPECT_EQ(told.lines, preset.core.lines);
    EXPECT_EQ(told.slaves == 1, preset.core.slaves == 1);
    EXPECT_EQ(told.biss_b, preset.core.biss_b);
    EXPECT_EQ(told.ssi, preset.core.ssi);
    EXPECT_EQ(told.mo, preset.core.mo);
    EXPECT_EQ(told.control, preset.core.control);
    EXPECT_EQ(told.free_crc, preset.core.free_crc);
    EXPECT_EQ(preset.word >> 12U, preset.core.slaves);
    EXPECT_EQ((preset.word & page::GRAY::kMask) != 0, preset.core.gray);
    EXPECT_EQ((preset.word & page::TWO_BANKS::kMask) != 0, preset.core.banks == 2);
  }
  // A full core reads 0. Each bit alone.
  EXPECT_EQ(mb4::features_of(0x00).lines, 2U);
  EXPECT_TRUE(mb4::features_of(0x00).biss_b);
  EXPECT_TRUE(mb4::features_of(0x80 | page::BISS_B::kMask).biss_b);
  EXPECT_FALSE(mb4::features_of(0x80 | page::SSI::kMask).biss_b);
  EXPECT_TRUE(mb4::features_of(0x80 | page::SSI::kMask).ssi);
  EXPECT_TRUE(mb4::features_of(0x80 | page::MO::kMask).mo);
  EXPECT_TRUE(mb4::features_of(0x80 | page::CONTROL::kMask).control);
  EXPECT_TRUE(mb4::features_of(0x80 | page::FREE_CRC::kMask).free_crc);
  EXPECT_EQ(mb4::features_of(0x80 | page::TWO_LINES::kMask).lines, 2U);
  EXPECT_EQ(mb4::features_of(0x80 | page::SLAVES_ON_LINE::kMask).slaves, 8U);
}

}  // namespace features_test
}  // namespace
