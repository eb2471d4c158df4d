// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// CRC of single-cycle data: its calculation, and the encoding of a polynomial into SELCRCSx and
// SCRCLENx or SCRCPOLYx (datasheet tables 13 to 16, pages 24 and 25). SCDATAx holds a CRC as
// crc() returns it, not inverted.

#ifndef MB4_CRC_HPP_
#define MB4_CRC_HPP_

#include <cstdint>

#include "enc/crc.hpp"

namespace mb4 {

using enc::crc;
using enc::crc_width_bits;
using enc::CrcShift;

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

}  // namespace mb4

#endif  // MB4_CRC_HPP_
