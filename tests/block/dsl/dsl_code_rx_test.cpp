// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Each of the 1024 words against the code of the model, by both checks and in each place of an
// answer.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vdsl_code_rx.h"
#include "places.hpp"
#include "sim/masters/dsl_model/line_code.hpp"
#include "tests/support/model_context.hpp"

namespace {

using namespace mb4::sim::dsl_model;

Word word_of(unsigned port) {
  using namespace mb4test::places::dsl_pkg::word_t;
  return {.byte = static_cast<std::uint8_t>(kData.of(port)),
          .error = kError.of(port) != 0,
          .special = kSpecial.of(port) != 0,
          .only_strict = kOnlyStrict.of(port) != 0};
}

TEST(DslCodeRxBlock, EachWord_IsThatOfTheModel) {
  mb4test::Block<Vdsl_code_rx> block;
  auto& m = block.model;
  unsigned legal = 0;
  unsigned flagged = 0;
  for (const CodeCheck check : {CodeCheck::kPublished, CodeCheck::kStrict}) {
    for (const Channel channel : {Channel::kPlain, Channel::kAcceleration, Channel::kSecond}) {
      for (unsigned line = 0; line < 1024; ++line) {
        SCOPED_TRACE(testing::Message()
                     << "word " << line << " channel " << static_cast<int>(channel));
        m.line_i = static_cast<std::uint16_t>(line);
        m.strict_i = check == CodeCheck::kStrict;
        m.raw_i = channel == Channel::kAcceleration;
        m.second_i = channel == Channel::kSecond;
        block.clock();
        const Word expected = decode(line, check, channel);
        const Word seen = word_of(m.word_o);
        ASSERT_EQ(seen.byte, expected.byte);
        ASSERT_EQ(seen.error, expected.error);
        ASSERT_EQ(seen.special, expected.special);
        ASSERT_EQ(seen.only_strict, expected.only_strict);
        if (channel != Channel::kPlain) continue;
        if (m.strict_i != 0) legal += seen.error ? 0 : 1;
        if (m.strict_i == 0) flagged += seen.error ? 1 : 0;
      }
    }
  }
  // The published counts.
  EXPECT_EQ(legal, 464U);
  EXPECT_EQ(flagged, 184U);
}

}  // namespace
