// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The place of a field in a packed struct of the RTL. The build makes places.hpp of the packages
// (tests/support/struct_places.py), one namespace for each struct, for example
// mb4_pkg::host_t::kWrAddr. A field of a struct inside has the names of both: kRegsBanksHost.
// kAllBits is the width of the whole struct.
#ifndef TESTS_SUPPORT_PLACE_HPP_
#define TESTS_SUPPORT_PLACE_HPP_

#include <cstdint>

namespace mb4test {

struct Place {
  unsigned lsb;
  unsigned width;

  // The bits of `value` in this place, of a struct with up to 64 bits.
  constexpr std::uint64_t operator()(std::uint64_t value) const { return (value & mask()) << lsb; }
  // The value in this place of a struct with up to 64 bits.
  constexpr std::uint64_t of(std::uint64_t bits) const { return bits >> lsb & mask(); }
  // The same place in element `number` of a vector of such structs, `struct_width` bits each.
  constexpr Place in(unsigned number, unsigned struct_width) const {
    return {lsb + number * struct_width, width};
  }
  // The value in this place of a struct of any length: the 32-bit words of a Verilated port.
  template <typename Words>
  std::uint64_t get(const Words& words) const {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < width; ++i)
      value |= std::uint64_t{words[(lsb + i) / 32] >> (lsb + i) % 32 & 1U} << i;
    return value;
  }
  // Sets this place of a struct of any length.
  template <typename Words>
  void set(Words& words, std::uint64_t value) const {
    for (unsigned i = 0; i < width; ++i) {
      auto& word = words[(lsb + i) / 32];
      const std::uint32_t bit = 1U << (lsb + i) % 32;
      word = (value >> i & 1U) != 0 ? word | bit : word & ~bit;
    }
  }

 private:
  constexpr std::uint64_t mask() const {
    return width >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1;
  }
};

}  // namespace mb4test

#endif  // TESTS_SUPPORT_PLACE_HPP_
