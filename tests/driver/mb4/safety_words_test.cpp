// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The words of BiSS Safety from the results of a read.

#include <gtest/gtest.h>

#include <cstdint>

#include "mb4/safety.hpp"
#include "tests/driver/mb4/encoder26.hpp"

namespace {
namespace safety_words_test {

using mb4::Error;
using State = mb4::SafetyWordRead::State;

TEST(SafetyWord, EachResult_HasItsState) {
  for (std::uint8_t i = 1; i <= static_cast<std::uint8_t>(Error::kNoWord); ++i) {
    const Error error = static_cast<Error>(i);
    const bool bad = error == Error::kCrc || error == Error::kCorrupted;
    const mb4::SafetyWordRead word = mb4::safety_word(mb4::Result<mb4::Reading>(error));
    EXPECT_EQ(word.state, bad ? State::kBadCrc : State::kMissing) << mb4::to_string(error);
    EXPECT_EQ(word.data, 0U);
  }
  mb4::Reading reading;
  reading.raw = mb4test::kRaw;
  reading.crc = mb4test::kCrc6;
  EXPECT_EQ(mb4::safety_word(mb4::Result<mb4::Reading>(reading)).state, State::kMissing);
  reading.crc_stored = true;
  const mb4::SafetyWordRead word = mb4::safety_word(mb4::Result<mb4::Reading>(reading));
  EXPECT_EQ(word.state, State::kHere);
  EXPECT_EQ(word.data, mb4test::kRaw);
  EXPECT_EQ(word.crc, mb4test::kCrc6);
  // The check looks at nE itself.
  reading.slave_error = true;
  EXPECT_EQ(mb4::safety_word({reading, Error::kSlaveError}).state, State::kHere);
}

// The driver looks at bits 1 and 0 for nE and nW.
TEST(SafetyFits, FlagsElsewhere_AreUnsupported) {
  mb4::Config config = mb4test::encoder26();
  config.spi_check = mb4::SpiCheck::kCrc;
  config.slaves[1] = config.slaves[0];
  config.slaves[1].flags = mb4::Flags::kNone;
  mb4::SafetyConfig words;
  words.control = {28, 26, 2, 1, 0, 0x43, 0};
  words.safety = words.control;
  EXPECT_TRUE(mb4::safety_fits(config, 1, 2, words).ok());
  for (const bool error : {false, true}) {
    mb4::SafetyConfig moved = words;
    (error ? moved.control.error_place : moved.control.warning_place) = 27;
    const mb4::ErrorInfo misfit = mb4::safety_fits(config, 1, 2, moved).info();
    EXPECT_EQ(misfit.code, Error::kUnsupported);
    EXPECT_EQ(misfit.field, mb4::ConfigField::kFlags);
    EXPECT_EQ(misfit.number, 1);
  }
  // Without flags in the configuration they may be anywhere.
  words.safety.error_place = 27;
  EXPECT_TRUE(mb4::safety_fits(config, 1, 2, words).ok());
}

}  // namespace safety_words_test
}  // namespace
