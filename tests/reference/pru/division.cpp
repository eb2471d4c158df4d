// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "tests/reference/pru/division.hpp"

namespace pru_judge {

std::string remainder(const std::string& bits, const std::string& divisor) {
  std::string rest = bits + std::string(divisor.size() - 1, '0');
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (rest[i] == '0') continue;
    for (std::size_t k = 0; k < divisor.size(); ++k) {
      rest[i + k] = rest[i + k] == divisor[k] ? '0' : '1';
    }
  }
  return rest.substr(bits.size());
}

std::string inverted(const std::string& bits) {
  std::string out = bits;
  for (char& bit : out) bit = bit == '0' ? '1' : '0';
  return out;
}

std::uint64_t number(const std::string& bits) {
  std::uint64_t value = 0;
  for (const char bit : bits) value = value * 2 + (bit == '1' ? 1 : 0);
  return value;
}

std::string position_crc(const std::string& bits) { return inverted(remainder(bits, "1000011")); }

std::string control_crc(const std::string& bits) { return inverted(remainder(bits, "10011")); }

}  // namespace pru_judge
