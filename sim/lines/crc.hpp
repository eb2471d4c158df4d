// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Cyclic redundancy check of a BiSS data channel, which the other protocols use too. Bits go in MSB
// first. The start value is loaded directly: it is the datasheet's 16-bit register, of which the
// low bits count. The line carries the inverted CRC.
#ifndef MB4SIM_CRC_HPP_
#define MB4SIM_CRC_HPP_

#include <cstdint>

namespace mb4::sim {

struct Crc {
  std::uint32_t polynomial = 0;  // full polynomial, 0x43 = x^6 + x + 1; 0 = no CRC
  std::uint32_t start = 0;       // only the low width() bits count

  // Degree of the polynomial, 0 to 16; 0 without CRC.
  unsigned width() const;
  // Returns the CRC of the low `bits` (1 to 64) bits of `data`, not inverted. 0 without a CRC.
  std::uint32_t compute(std::uint64_t data, unsigned bits) const;
  // Returns what the line carries after the data: the inverted CRC, width() bits.
  std::uint32_t line_bits(std::uint64_t data, unsigned bits) const;
};

}  // namespace mb4::sim

#endif  // MB4SIM_CRC_HPP_
