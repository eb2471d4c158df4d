// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// CRC of single-cycle data: calculation, and the encoding of a polynomial into SELCRCSx and
// SCRCLENx or SCRCPOLYx (datasheet tables 13 to 16, pages 24 and 25).

#ifndef MB4_CRC_HPP_
#define MB4_CRC_HPP_

#include <cstdint>

namespace mb4 {

// The code of a polynomial in the chip's registers.
struct CrcCode {
  // False: the chip cannot calculate this polynomial; the other members are 0.
  bool valid = false;
  // SELCRCSx: false = `code` is SCRCLENx (predefined), true = `code` is SCRCPOLYx.
  bool by_polynomial = false;
  // Seven bits.
  std::uint8_t code = 0;
  // Number of CRC bits on the line, 0..16.
  std::uint8_t width_bits = 0;
};

// Degree of a polynomial written in full, 0x43 -> 6. 0 and 1 give 0.
[[nodiscard]] constexpr std::uint8_t crc_width_bits(std::uint32_t polynomial) {
  std::uint8_t degree = 0;
  while ((polynomial >> 1) != 0) {
    polynomial >>= 1;
    ++degree;
  }
  return degree;
}

// Encodes `polynomial`, written with its highest and lowest bit: 0x43 is x^6 + x + 1; 0 is no CRC.
// The length selects a predefined polynomial (3 to 8 and 16 bits). The register stores any other
// polynomial of degree 1..7 whose lowest bit is 1. All others are not valid.
[[nodiscard]] constexpr CrcCode encode_crc(std::uint32_t polynomial) {
  // Table 14 without the highest bit of 3 to 8 bits: 0xB, 0x13, 0x25, 0x43, 0x89, 0x12F.
  constexpr std::uint8_t kPredefined[] = {0x03, 0x03, 0x05, 0x03, 0x09, 0x2F};
  CrcCode code{true, false, crc_width_bits(polynomial), crc_width_bits(polynomial)};
  const unsigned index = code.width_bits - 3U;
  if (polynomial == 0 || polynomial == 0x190D9 ||
      (index < sizeof kPredefined && polynomial == (8U << index | kPredefined[index]))) {
    return code;
  }
  // SCRCPOLYx holds bits 7..1; bit 0 is always 1, so an even polynomial cannot be expressed.
  if (polynomial < 0x3 || polynomial > 0xFF || (polynomial & 1U) == 0) {
    return {};
  }
  code.by_polynomial = true;
  code.code = static_cast<std::uint8_t>(polynomial >> 1);
  return code;
}

// Calculates one CRC bit by bit, most significant bit first, as BiSS defines it. The result is not
// inverted, as in SCDATAx; the line carries the inverse.
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

}  // namespace mb4

#endif  // MB4_CRC_HPP_
