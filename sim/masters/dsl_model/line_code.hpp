// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The line code and the check sums of DSL as the master needs them: what it sends in
// M_PAR, what it makes of a received word, CRC16 and CRC5. The encoder has a line code of its own
// (sim/lines/dsl/), so that one judges the other.
//
// A word of ten bits stands in the order of the line: its first bit (a) is bit 9.
#ifndef MB4SIM_DSL_MODEL_LINE_CODE_HPP_
#define MB4SIM_DSL_MODEL_LINE_CODE_HPP_

#include <cstdint>
#include <span>

namespace mb4::sim::dsl_model {

// The word of `byte` in M_PAR. `disparity` is the counter of the equaliser; the block of six bits
// is added to it, the one of four is not.
unsigned encode_parameter(unsigned byte, int& disparity);

// How a word that no table has is judged.
enum class CodeCheck {
  kPublished,  // four or five equal bits are an error, other words read as FFh
  kStrict,     // every word that is none of the 464 legal ones is an error
};

struct Word {
  std::uint8_t byte = 0;
  bool error = false;        // of the code
  bool special = false;      // a special character
  bool only_strict = false;  // the error is one that the published check does not see

  // The special characters that an encoder reports its own faults with.
  bool is(std::uint8_t character) const { return special && !error && byte == character; }
  // K28.0 to K28.7.
  bool is_k28() const { return special && !error && (byte & 0x1FU) == 28; }
};
inline constexpr std::uint8_t kMarker1 = 0xFD;  // K29.7: acceleration, safe channel 1
inline constexpr std::uint8_t kMarker2 = 0xFB;  // K27.7: safe channel 2

// Where a word stands decides whether K28.1, K28.2, K28.5 and K28.6 get their upper three bits,
// which the tables of data invert: with the strict check everywhere but in the acceleration, where
// a single wrong bit of D7.x could otherwise pass CRC5; with the published one in the second safe
// channel only.
enum class Channel { kPlain, kAcceleration, kSecond };

// `line`: ten bits.
Word decode(unsigned line, CodeCheck check, Channel channel = Channel::kPlain);

// CRC16 with its last byte inverted, over whole bytes.
std::uint16_t crc16(std::span<const std::uint8_t> bytes);
// CRC5 of 11 bits, as it stands in the word: inverted.
unsigned crc5(unsigned bits);
// The word of a second difference, and back. A word is good if its CRC is.
std::uint16_t acceleration_word(int acceleration);
bool acceleration_is_good(std::uint16_t word);
int acceleration_of(std::uint16_t word);

}  // namespace mb4::sim::dsl_model

#endif  // MB4SIM_DSL_MODEL_LINE_CODE_HPP_
