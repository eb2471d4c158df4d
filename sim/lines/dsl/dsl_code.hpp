// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The line code and the check sums of DSL as an encoder needs them: it sends the standard
// 8b/10b code with a running disparity, and reads M_PAR. The model of the master has a code of its
// own, so that one judges the other.
#ifndef MB4SIM_DSL_CODE_HPP_
#define MB4SIM_DSL_CODE_HPP_

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>

namespace mb4::sim::dsl {

// Sends words one after another. The first bit of a word is its bit 9.
class Coder {
 public:
  explicit Coder(bool positive) : positive_(positive) {}
  unsigned data(std::uint8_t byte);
  // The special character of this value: K28.x, K23.7, K27.7, K29.7, K30.7.
  unsigned special(std::uint8_t byte);

 private:
  bool positive_;  // the running disparity
};

// The byte of a word in M_PAR. Nothing if a block of it is in no table.
std::optional<std::uint8_t> parameter_of(unsigned word);

// CRC16 of a safe channel or a message, as it is sent.
std::uint16_t check_bytes(std::span<const std::uint8_t> bytes);
inline std::uint16_t check_safe(std::initializer_list<std::uint8_t> bytes) {
  return check_bytes({bytes.begin(), bytes.size()});
}
// A second difference of 11 bits with its CRC5, as it is sent.
std::uint16_t with_check(int acceleration);

}  // namespace mb4::sim::dsl

#endif  // MB4SIM_DSL_CODE_HPP_
