// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The CRC of data on a line. A polynomial is written in full, with its highest and its lowest bit:
// 0x43 is x^6 + x + 1.

#ifndef ENC_CRC_HPP_
#define ENC_CRC_HPP_

#include <cstdint>

namespace enc {

// Degree of a polynomial written in full, 0x43 -> 6. 0 and 1 give 0.
[[nodiscard]] constexpr std::uint8_t crc_width_bits(std::uint32_t polynomial) {
  std::uint8_t degree = 0;
  while ((polynomial >> 1) != 0) {
    polynomial >>= 1;
    ++degree;
  }
  return degree;
}

// Calculates one CRC bit by bit, most significant bit first, as BiSS defines it. The result is not
// inverted; the line carries the inverse.
class CrcShift {
 public:
  // `polynomial` in full, degree 1..16. Only the low bits of `start` count, as many as the CRC has.
  constexpr CrcShift(std::uint32_t polynomial, std::uint16_t start)
      : polynomial_(polynomial),
        top_(std::uint32_t{1} << crc_width_bits(polynomial)),
        remainder_(start & (top_ - 1)) {}
  // The next data bit, 0 or 1.
  constexpr void shift(unsigned bit) {
    remainder_ <<= 1;
    if (((remainder_ & top_) != 0) != (bit != 0)) {
      remainder_ ^= polynomial_;
    }
    remainder_ &= top_ - 1;
  }
  [[nodiscard]] constexpr std::uint16_t value() const {
    return static_cast<std::uint16_t>(remainder_);
  }

 private:
  std::uint32_t polynomial_;
  std::uint32_t top_;
  std::uint32_t remainder_;
};

// CRC of the low `data_bits` (0..64) bits of `data`. `polynomial` in full, degree 1..16, otherwise
// the result is 0.
[[nodiscard]] constexpr std::uint16_t crc(std::uint32_t polynomial, std::uint16_t start,
                                          std::uint64_t data, std::uint8_t data_bits) {
  if (crc_width_bits(polynomial) == 0) {
    return 0;
  }
  CrcShift shift(polynomial, start);
  for (std::uint8_t bit = data_bits; bit > 0; --bit) {
    shift.shift(static_cast<unsigned>(data >> (bit - 1)) & 1U);
  }
  return shift.value();
}

}  // namespace enc

#endif  // ENC_CRC_HPP_
