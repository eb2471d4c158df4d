// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Bytes of a DSL message with their CRC, computed bit by bit as the law has it: x^16 + x^15 + x^12
// + x^7 + x^6 + x^4 + x^3 + 1, the low byte inverted.
#ifndef MB4_TESTS_UNIT_DSL_MESSAGE_BYTES_HPP_
#define MB4_TESTS_UNIT_DSL_MESSAGE_BYTES_HPP_

#include <cstdint>
#include <vector>

namespace mb4::sim::dsl_test {

using Bytes = std::vector<std::uint8_t>;

inline Bytes with_crc(Bytes bytes) {
  unsigned rest = 0;
  for (const std::uint8_t byte : bytes) {
    for (unsigned i = 8; i-- > 0;) {
      const unsigned out = (rest >> 15U ^ byte >> i) & 1U;
      rest = (rest << 1U & 0xFFFFU) ^ (out != 0 ? 0x90D9U : 0U);
    }
  }
  bytes.push_back(static_cast<std::uint8_t>(rest >> 8U));
  bytes.push_back(static_cast<std::uint8_t>(rest ^ 0xFFU));
  return bytes;
}

}  // namespace mb4::sim::dsl_test

#endif  // MB4_TESTS_UNIT_DSL_MESSAGE_BYTES_HPP_
