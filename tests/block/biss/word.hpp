// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One data word as a line is told of it.
#ifndef TESTS_BLOCK_BISS_WORD_HPP_
#define TESTS_BLOCK_BISS_WORD_HPP_

#include <bit>
#include <cstdint>

#include "places.hpp"

namespace mb4test {

// The polynomials of Table 14; 0: no CRC.
inline constexpr std::uint32_t kPolynomials[] = {0, 0xB, 0x13, 0x25, 0x43, 0x89, 0x12F, 0x190D9};

struct Word {
  unsigned data_bits = 0;
  std::uint32_t polynomial = 0;
  std::uint16_t start = 0;
  bool store = false, gray = false, actuator = false, stop = false;

  unsigned crc_bits() const {
    return polynomial == 0 ? 0 : static_cast<unsigned>(std::bit_width(polynomial)) - 1;
  }
  std::uint64_t port() const {
    namespace at = places::biss_pkg::word_t;
    const unsigned crc = crc_bits();
    return at::kDataLast(data_bits - 1) | at::kCrcOn(crc != 0) |
           at::kCrcLast(crc == 0 ? 0 : crc - 1) | at::kCrcPoly(polynomial) | at::kCrcStart(start) |
           at::kCrcStore(store) | at::kGray(gray) | at::kActuator(actuator) | at::kStop(stop);
  }
};

}  // namespace mb4test

#endif  // TESTS_BLOCK_BISS_WORD_HPP_
