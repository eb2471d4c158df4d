// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The shift registers of several slaves as one row of bits. A shift moves no bit: it moves the
// place of the bit that leaves next. So its cost does not depend on the number of slaves.
#ifndef MB4SIM_BIT_ROW_HPP_
#define MB4SIM_BIT_ROW_HPP_

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "sim/lines/clocked/shift_register.hpp"

namespace mb4::sim {

class BitRow {
 public:
  using Bits = ShiftRegister::Bits;
  static constexpr std::size_t kRoom = 2048;

  // An empty row. It is full until restart().
  BitRow() = default;

  bool full() const { return end_ == kRoom; }
  // Number of bits that have left since restart().
  std::size_t shifts() const { return first_; }

  void restart() {
    words_.fill(0);
    first_ = end_ = 0;
  }
  // Makes the row full. No bit has left it.
  void stop() {
    first_ = 0;
    end_ = kRoom;
  }
  // Appends `count` bits. The bit that leaves first is the highest; those behind the last one are
  // 0.
  void append(Bits bits, std::size_t count) {
    assert(end_ + count < kRoom);
    std::uint64_t* word = &words_[end_ / 64];
    const std::size_t shift = end_ % 64;
    const Bits rest = shift == 0 ? 0 : bits << (128 - shift);
    bits >>= shift;
    word[0] |= static_cast<std::uint64_t>(bits >> 64U);
    word[1] |= static_cast<std::uint64_t>(bits);
    word[2] |= static_cast<std::uint64_t>(rest >> 64U);
    end_ += count;
  }
  // One bit leaves and `in` comes in at the end. Returns the bit that leaves next. The row must not
  // be full.
  bool shift(bool in) {
    words_[end_ / 64] |= std::uint64_t{in} << (63 - end_ % 64);
    ++end_;
    ++first_;
    return (words_[first_ / 64] >> (63 - first_ % 64) & 1U) != 0;
  }
  // `count` bits from place `place` behind the bit that leaves next, as in append().
  Bits bits(std::size_t place, std::size_t count) const {
    const std::size_t at = first_ + place;
    const std::uint64_t* word = &words_[at / 64];
    const std::size_t shift = at % 64;
    Bits found = (Bits{word[0]} << 64U | word[1]) << shift;
    if (shift != 0) found |= word[2] >> (64 - shift);
    return found >> (128 - count) << (128 - count);
  }

 private:
  std::size_t first_ = 0;    // place of the bit that leaves next
  std::size_t end_ = kRoom;  // place of the bit that comes in next
  std::array<std::uint64_t, kRoom / 64 + 2> words_{};
};

}  // namespace mb4::sim

#endif  // MB4SIM_BIT_ROW_HPP_
