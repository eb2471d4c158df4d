// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Arithmetic on positions: sign, Gray code, turns. The contracts: enc/position.hpp.

#ifndef MB4_POSITION_HPP_
#define MB4_POSITION_HPP_

#include <cstdint>

#include "enc/position.hpp"
#include "mb4/error.hpp"
#include "mb4/result.hpp"

namespace mb4 {

using enc::binary_to_gray;
using enc::gray_to_binary;
using enc::kMaxPositionBits;
using enc::low_bits;
using enc::to_signed;
using enc::Turns;

using PositionTracker = enc::PositionTracker<ErrorInfo>;

[[nodiscard]] constexpr Result<Turns> split_turns(std::uint64_t position, std::uint8_t multi_bits,
                                                  std::uint8_t single_bits) {
  return enc::split_turns<ErrorInfo>(position, multi_bits, single_bits);
}

}  // namespace mb4

#endif  // MB4_POSITION_HPP_
