// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The data channel of a BiSS slave: a shift register between SLI and SLO with the length of the
// channel. Its own bits leave first, then the bits that came in.
#ifndef MB4SIM_SHIFT_REGISTER_HPP_
#define MB4SIM_SHIFT_REGISTER_HPP_

#include <cassert>
#include <cstddef>
#include <cstdint>

#include "sim/lines/crc.hpp"

namespace mb4::sim {

class ShiftRegister {
 public:
  // A channel has at most a stop bit, 64 bits of data and a CRC of 16 bits.
  static constexpr std::size_t kMaxBits = 128;
  // The bit that leaves first is the highest.
  __extension__ using Bits = unsigned __int128;

  // `bits` is 1 to kMaxBits.
  explicit ShiftRegister(std::size_t bits) : size_(bits), in_(place(bits - 1)) {
    assert(bits >= 1 && bits <= kMaxBits);
  }

  // Fills the register with the low `data_bits` bits of `word`, MSB first, and their inverted CRC.
  // If the register is longer by one bit, a stop bit (0) comes first. `wrong_crc` inverts the last
  // bit of the CRC.
  void load(std::uint64_t word, unsigned data_bits, const Crc& crc, bool wrong_crc = false) {
    bits_ = 0;
    std::size_t i = size_ - data_bits - crc.width();
    for (unsigned bit = data_bits; bit-- > 0; ++i) bits_ |= (word >> bit) & 1U ? place(i) : 0;
    const std::uint32_t check = crc.line_bits(word, data_bits) ^ (wrong_crc ? 1U : 0U);
    for (unsigned bit = crc.width(); bit-- > 0; ++i) bits_ |= (check >> bit) & 1U ? place(i) : 0;
    shifts_ = 0;
  }
  // The bit that leaves next.
  bool out() const { return (static_cast<std::uint64_t>(bits_ >> 64U) >> 63U) != 0; }
  void shift(bool in) {
    bits_ <<= 1U;
    if (in) bits_ |= in_;
    ++shifts_;
  }

  // The same as `shifts` calls of shift(). `bits` is what is then in the register.
  void set_shifted(Bits bits, std::size_t shifts) {
    bits_ = bits;
    shifts_ += shifts;
  }

  std::size_t size() const { return size_; }
  Bits bits() const { return bits_; }
  // Bit `i` in the order in which the bits leave.
  bool at(std::size_t i) const { return (bits_ & place(i)) != 0; }
  // True when all of its bits came in at SLI.
  bool filled() const { return shifts_ >= size_; }
  // True from load() to the first shift.
  bool loaded() const { return shifts_ == 0; }
  // The first `count` (at least 1) bits that leave; the others are 0.
  static constexpr Bits first(Bits bits, std::size_t count) {
    return bits & ~Bits{0} << (kMaxBits - count);
  }

 private:
  static constexpr Bits place(std::size_t i) { return Bits{1} << (kMaxBits - 1 - i); }

  Bits bits_ = 0;
  std::size_t size_;
  Bits in_;                 // where the bit from SLI comes in
  std::size_t shifts_ = 0;  // since load()
};

}  // namespace mb4::sim

#endif  // MB4SIM_SHIFT_REGISTER_HPP_
