// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The words of DSL for a picture: line code, check sum and test pattern from the published facts.
// Neither the encoder's nor the master's code is used, so that a picture can contradict both.
//
// A word of ten bits stands in the order of the line: its first bit is bit 9.
#ifndef MB4SIM_TOOL_DSL_WORDS_HPP_
#define MB4SIM_TOOL_DSL_WORDS_HPP_

#include <cstdint>
#include <optional>
#include <span>

namespace mb4::tool {

inline constexpr unsigned kDslAnswerBits = 61;
// The answer of the training; the first bit is bit 60.
inline constexpr std::uint64_t kDslPattern =
    0b0100110011'0010000001'0001010111'0111111011'0011001101'0'0010011001;
inline constexpr std::uint8_t kDslMarker = 0xFD;  // K29.7: the encoder has no second difference

struct DslWord {
  std::uint8_t byte = 0;
  bool error = true;  // none of the 464 legal words
  bool special = false;
};

DslWord dsl_word(unsigned word);
// The byte of M_PAR, whose two blocks the equaliser may have inverted each. Nothing: no such block.
std::optional<std::uint8_t> dsl_parameter(unsigned word);
// CRC16 of a message over these bytes, as it is sent.
std::uint16_t dsl_check(std::span<const std::uint8_t> bytes);
// The second difference of two words with a right CRC5.
std::optional<int> dsl_second_difference(unsigned high, unsigned low);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_DSL_WORDS_HPP_
