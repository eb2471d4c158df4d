// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A BiSS C slave in a few lines, written from the edge table of the protocol, and the bits that it
// sends. So the tests of a master's blocks do not depend on the simulator's slave model.
#ifndef TESTS_BLOCK_BISS_EDGE_SLAVE_HPP_
#define TESTS_BLOCK_BISS_EDGE_SLAVE_HPP_

#include <cstdint>
#include <string>

namespace mb4test {

// CRC of a bit string, most significant bit first; `polynomial` with its highest power.
inline std::uint32_t crc_of(const std::string& bits, std::uint32_t polynomial,
                            std::uint32_t start = 0) {
  unsigned width = 0;
  while ((polynomial >> (width + 1)) != 0) ++width;
  const std::uint32_t mask = (1U << width) - 1U;
  std::uint32_t remainder = start & mask;
  for (const char bit : bits) {
    const bool top = ((remainder >> (width - 1)) & 1U) != 0;
    remainder = (remainder << 1) & mask;
    if (top != (bit == '1')) remainder ^= polynomial & mask;
  }
  return remainder;
}

inline std::string bits_of(std::uint64_t value, unsigned width) {
  std::string text;
  for (unsigned i = width; i-- > 0;) text += ((value >> i) & 1U) != 0 ? '1' : '0';
  return text;
}

// The word of one slave as it appears on the line: data, then the inverted CRC.
inline std::string line_word(std::uint64_t data, unsigned data_bits, std::uint32_t polynomial,
                             std::uint32_t start = 0) {
  std::string text = bits_of(data, data_bits);
  if (polynomial == 0) return text;
  unsigned width = 0;
  while ((polynomial >> (width + 1)) != 0) ++width;
  return text + bits_of(~crc_of(text, polynomial, start) & ((1U << width) - 1U), width);
}

// A slave that answers rising edge after rising edge (BiSS C frame, edge by edge).
struct Slave {
  std::string payload;        // CDS, then all data and CRC bits
  unsigned busy = 0;          // processing clocks
  std::uint64_t timeout = 0;  // in sixteenths of a clock
  unsigned rises = 0;
  bool in_frame = false;
  bool out = true;
  std::uint64_t last_edge = 0;
  int cdm_level = -1;  // MA when the timeout ended, -1: not yet

  void edge(bool ma, std::uint64_t now) {
    last_edge = now;
    if (!in_frame) {
      if (!ma) {
        in_frame = true;
        rises = 0;
      }
      return;
    }
    if (!ma) return;
    ++rises;
    if (rises == 2) out = false;
    if (rises == 3 + busy) out = true;
    if (rises > 3 + busy) {
      const std::size_t index = rises - 4 - busy;
      out = index < payload.size() && payload[index] == '1';
    }
  }
  void step(bool ma, std::uint64_t now) {
    if (in_frame && now - last_edge >= timeout) {
      in_frame = false;
      out = true;
      cdm_level = ma ? 1 : 0;
    }
  }
};

}  // namespace mb4test

#endif  // TESTS_BLOCK_BISS_EDGE_SLAVE_HPP_
