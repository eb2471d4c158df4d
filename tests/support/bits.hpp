// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Words as strings of '0' and '1', in the order in which they stand on a line, and numbers from the
// environment that set how long a random test runs.
#ifndef TESTS_SUPPORT_BITS_HPP_
#define TESTS_SUPPORT_BITS_HPP_

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/reference/reference.hpp"

namespace mb4test {

// MSB first.
inline std::string to_bits(std::uint64_t value, unsigned width) {
  std::string text;
  for (unsigned i = width; i-- > 0;) text += ((value >> i) & 1U) != 0 ? '1' : '0';
  return text;
}

// The number that `bits` (at most 64) spell, MSB first.
inline std::uint64_t from_bits(const std::string& bits) {
  std::uint64_t value = 0;
  for (const char bit : bits) value = value * 2 + (bit == '1' ? 1U : 0U);
  return value;
}

inline void invert(std::string& bits, std::size_t at) { bits[at] = bits[at] == '0' ? '1' : '0'; }

// One data channel as a slave sends it: data bits, MSB first, and the inverted CRC.
inline std::string word_on_line(std::uint64_t word, unsigned data_bits, mb4test::CrcChoice crc,
                                std::uint16_t start) {
  const std::string data = to_bits(word, data_bits);
  return data + to_bits(~std::uint64_t{mb4test::remainder(data, crc, start)}, crc.width);
}

// Whether data bits and CRC as received belong together.
inline bool crc_fits(const std::string& received, unsigned data_bits, mb4test::CrcChoice crc,
                     std::uint16_t start) {
  const std::string data = received.substr(0, data_bits);
  return received.substr(data_bits) ==
         to_bits(~std::uint64_t{mb4test::remainder(data, crc, start)}, crc.width);
}

// Value of an environment variable, `fallback` if it is not set.
inline std::uint64_t number_from(const char* variable, std::uint64_t fallback) {
  const char* text = std::getenv(variable);
  return text == nullptr ? fallback : std::strtoull(text, nullptr, 0);
}

// Folder or file `name` that a failed random run leaves behind: below MB4_FAILURES, or among the
// temporary files.
inline std::filesystem::path failure_path(const std::string& name) {
  const char* const chosen = std::getenv("MB4_FAILURES");
  return std::filesystem::path(chosen != nullptr ? chosen : testing::TempDir()) / name;
}

}  // namespace mb4test

#endif  // TESTS_SUPPORT_BITS_HPP_
