// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// CRC of single-cycle data: calculation, and the encoding of a polynomial into SELCRCSx and
// SCRCLENx or SCRCPOLYx (datasheet tables 13 to 16, pages 24 and 25).

#ifndef MB4_CRC_HPP_
#define MB4_CRC_HPP_

#include <cstdint>

namespace mb4 {

// How the chip is told a polynomial.
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

// `polynomial` in full, highest and lowest bit included: 0x43 is x^6 + x + 1; 0 is no CRC.
// The predefined ones (3 to 8 and 16 bits) are selected by length; any other one of degree 1..7
// with lowest bit 1 is stored individually. Everything else is not valid.
[[nodiscard]] constexpr CrcCode encode_crc(std::uint32_t polynomial) {
  switch (polynomial) {
    case 0:
      return {true, false, 0x00, 0};
    case 0xB:
      return {true, false, 0x03, 3};
    case 0x13:
      return {true, false, 0x04, 4};
    case 0x25:
      return {true, false, 0x05, 5};
    case 0x43:
      return {true, false, 0x06, 6};
    case 0x89:
      return {true, false, 0x07, 7};
    case 0x12F:
      return {true, false, 0x08, 8};
    case 0x190D9:
      return {true, false, 0x10, 16};
    default:
      break;
  }
  // SCRCPOLYx holds bits 7..1; bit 0 is always 1, so an even polynomial cannot be expressed.
  if (polynomial < 0x3 || polynomial > 0xFF || (polynomial & 1U) == 0) {
    return {};
  }
  return {true, true, static_cast<std::uint8_t>(polynomial >> 1), crc_width_bits(polynomial)};
}

// CRC of the low `data_bits` (0..64) bits of `data`, most significant first, as BiSS defines it:
// not inverted, as stored in SCDATAx (the line carries the inverse). `polynomial` in full, degree
// 1..16, otherwise the result is 0. Of `start` only as many low bits count as the CRC is wide.
[[nodiscard]] constexpr std::uint16_t crc(std::uint32_t polynomial, std::uint16_t start,
                                          std::uint64_t data, std::uint8_t data_bits) {
  const std::uint8_t width_bits = crc_width_bits(polynomial);
  if (width_bits == 0) {
    return 0;
  }
  const std::uint32_t mask = (std::uint32_t{1} << width_bits) - 1;
  std::uint32_t remainder = start & mask;
  for (std::uint8_t bit = data_bits; bit > 0; --bit) {
    const std::uint32_t data_bit = static_cast<std::uint32_t>(data >> (bit - 1)) & 1U;
    const std::uint32_t top_bit = (remainder >> (width_bits - 1)) & 1U;
    remainder = (remainder << 1) & mask;
    if (data_bit != top_bit) {
      remainder ^= polynomial & mask;
    }
  }
  return static_cast<std::uint16_t>(remainder);
}

}  // namespace mb4

#endif  // MB4_CRC_HPP_
