// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a mistyped word was meant to be.
#include "sim/core/suggestion.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using mb4::sim::nearest;

const std::vector<std::string> kKnown{"ssi", "biss-b", "biss-c", "data_bits", "data", "f_clk_hz"};

TEST(Suggestion, OneMistake_IsFound) {
  EXPECT_EQ(nearest("ssi", kKnown), "ssi");
  EXPECT_EQ(nearest("sssi", kKnown), "ssi");
  EXPECT_EQ(nearest("si", kKnown), "ssi");
  EXPECT_EQ(nearest("sxi", kKnown), "ssi");
  EXPECT_EQ(nearest("sis", kKnown), "ssi") << "neighbours swapped are one mistake, not two";
  EXPECT_EQ(nearest("SSI", kKnown), "ssi");
}

TEST(Suggestion, LongWords_MayHaveMoreMistakes) {
  EXPECT_EQ(nearest("f_ckl_zh", kKnown), "f_clk_hz");
  EXPECT_EQ(nearest("dataBits", kKnown), "data_bits");
}

TEST(Suggestion, BeginningOfAName_IsEnough) {
  EXPECT_EQ(nearest("biss", kKnown), "biss-b");
  EXPECT_EQ(nearest("data_b", kKnown), "data_bits");
}

TEST(Suggestion, AnotherWord_IsNotGuessed) {
  EXPECT_EQ(nearest("uvw", kKnown), "");
  EXPECT_EQ(nearest("iss", {"spi", "axi"}), "");
  EXPECT_EQ(nearest("position", kKnown), "");
}

}  // namespace
