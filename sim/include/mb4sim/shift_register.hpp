// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The data channel of a BiSS slave: a shift register of the channel's own length between SLI and
// SLO. Its own bits leave first, then what came in.
#ifndef MB4SIM_SHIFT_REGISTER_HPP_
#define MB4SIM_SHIFT_REGISTER_HPP_

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mb4sim/crc.hpp"

namespace mb4::sim {

class ShiftRegister {
 public:
  // At least one bit.
  explicit ShiftRegister(std::size_t bits) : bits_(bits, 0) {}

  // Fills it with the low `data_bits` bits of `word`, MSB first, and their inverted CRC, behind a
  // stop bit (0) if it is longer by that one bit. `wrong_crc`: the last bit of the CRC is wrong.
  void load(std::uint64_t word, unsigned data_bits, const Crc& crc, bool wrong_crc = false) {
    std::size_t i = 0;
    if (bits_.size() > data_bits + crc.width()) bits_[i++] = 0;
    for (unsigned bit = data_bits; bit-- > 0;) bits_[i++] = (word >> bit) & 1U ? 1 : 0;
    const std::uint32_t check = crc.line_bits(word, data_bits) ^ (wrong_crc ? 1U : 0U);
    for (unsigned bit = crc.width(); bit-- > 0;) bits_[i++] = (check >> bit) & 1U ? 1 : 0;
    head_ = 0;
    shifts_ = 0;
  }
  // The bit that leaves now.
  bool out() const { return bits_[head_] != 0; }
  void shift(bool in) {
    bits_[head_] = in ? 1 : 0;
    if (++head_ == bits_.size()) head_ = 0;
    ++shifts_;
  }

  std::size_t size() const { return bits_.size(); }
  // Bit `i` in the order in which they leave.
  bool at(std::size_t i) const { return bits_[(head_ + i) % bits_.size()] != 0; }
  // Everything that it holds came in at SLI.
  bool filled() const { return shifts_ >= bits_.size(); }

 private:
  std::vector<std::uint8_t> bits_;
  std::size_t head_ = 0;
  std::size_t shifts_ = 0;  // since load()
};

}  // namespace mb4::sim

#endif  // MB4SIM_SHIFT_REGISTER_HPP_
