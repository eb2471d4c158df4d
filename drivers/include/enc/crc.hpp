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

namespace detail {

// Shifts `steps` (0..32) bits of a CRC that stands in the highest bits of the word.
constexpr std::uint32_t crc_steps(std::uint32_t crc, std::uint32_t polynomial, std::uint8_t steps) {
  for (; steps > 0; --steps) {
    crc = (crc >> 31U) != 0 ? crc << 1U ^ polynomial : crc << 1U;
  }
  return crc;
}

}  // namespace detail

// CRC of the low `data_bits` (0..64) bits of `data`. `polynomial` in full, degree 1..16, otherwise
// the result is 0.
[[nodiscard]] constexpr std::uint16_t crc(std::uint32_t polynomial, std::uint16_t start,
                                          std::uint64_t data, std::uint8_t data_bits) {
  const std::uint8_t width = crc_width_bits(polynomial);
  if (width == 0 || width > 16) {
    return 0;
  }
  const auto align = static_cast<std::uint8_t>(32U - width);
  const std::uint32_t high_polynomial = polynomial << align;
  std::uint32_t crc = std::uint32_t{start} << align;
  if (data_bits > 32) {
    const auto bits = static_cast<std::uint8_t>(data_bits - 32U);
    crc ^= static_cast<std::uint32_t>(data >> 32U) << (32U - bits);
    crc = detail::crc_steps(crc, high_polynomial, bits);
    data_bits = 32;
  }
  if (data_bits > 0) {
    crc ^= static_cast<std::uint32_t>(data) << (32U - data_bits);
  }
  return static_cast<std::uint16_t>(detail::crc_steps(crc, high_polynomial, data_bits) >> align);
}

}  // namespace enc

#endif  // ENC_CRC_HPP_
