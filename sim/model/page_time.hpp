// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The time of a bus page (rtl/common/enc_time.sv) in a Verilated model that is at rest.
#ifndef MB4SIM_MODEL_PAGE_TIME_HPP_
#define MB4SIM_MODEL_PAGE_TIME_HPP_

#include <cstdint>

namespace mb4::sim {

constexpr std::uint64_t time_of(std::uint32_t low, std::uint32_t high) {
  return std::uint64_t{high} << 32U | low;
}

// Sets the registers of enc_time forward: two words, and a flag that the low one has its highest
// value.
template <typename Word, typename Flag>
void pass_time(Word& low, Word& high, Flag& carry, std::uint64_t clocks) {
  const std::uint64_t after = time_of(low, high) + clocks;
  low = static_cast<Word>(after);
  high = static_cast<Word>(after >> 32U);
  carry = low == 0xFFFF'FFFFU ? 1 : 0;
}

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_PAGE_TIME_HPP_
