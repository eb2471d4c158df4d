// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/crc.hpp"

#include <bit>

namespace mb4::sim {

unsigned Crc::width() const {
  return polynomial == 0 ? 0U : static_cast<unsigned>(std::bit_width(polynomial)) - 1U;
}

std::uint32_t Crc::compute(std::uint64_t data, unsigned bits) const {
  const unsigned n = width();
  if (n == 0) return 0;
  const std::uint32_t mask = (1U << n) - 1U;
  std::uint32_t reg = start & mask;
  for (unsigned i = bits; i-- > 0;) {
    const auto bit = static_cast<std::uint32_t>(data >> i) & 1U;
    const std::uint32_t feedback = bit ^ (reg >> (n - 1U));
    reg = (reg << 1U) & mask;
    if (feedback != 0U) reg ^= polynomial & mask;
  }
  return reg;
}

std::uint32_t Crc::line_bits(std::uint64_t data, unsigned bits) const {
  const unsigned n = width();
  return n == 0 ? 0U : ~compute(data, bits) & ((1U << n) - 1U);
}

}  // namespace mb4::sim
