// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Vectors of structs at ports of the axi_* modules, and accesses to the page.
#ifndef TESTS_BLOCK_AXI_AXI_BUS_HPP_
#define TESTS_BLOCK_AXI_AXI_BUS_HPP_

#include <cstdint>

namespace mb4test {

// Bits `lsb` on of a port of more than 64 bits.
template <typename Wide>
void set_bits(Wide& port, unsigned lsb, unsigned width, std::uint64_t value) {
  for (unsigned bit = 0; bit < width; ++bit) {
    const std::uint32_t mask = 1U << (lsb + bit) % 32;
    std::uint32_t& word = port[(lsb + bit) / 32];
    word = (value >> bit & 1U) != 0 ? word | mask : word & ~mask;
  }
}
template <typename Wide>
std::uint64_t get_bits(const Wide& port, unsigned lsb, unsigned width) {
  std::uint64_t value = 0;
  for (unsigned bit = 0; bit < width; ++bit) {
    value |= std::uint64_t{port[(lsb + bit) / 32] >> (lsb + bit) % 32 & 1U} << bit;
  }
  return value;
}

// axi_pkg::bus_t.
constexpr std::uint64_t page_read(unsigned address) {
  return std::uint64_t{1} << 41U | std::uint64_t{address} << 32U;
}
constexpr std::uint64_t page_write(unsigned address, std::uint32_t data) {
  return std::uint64_t{1} << 40U | std::uint64_t{address} << 32U | data;
}
// A block whose words are in the page: bus_i, data_o.
template <typename Block>
std::uint32_t read_page(Block& block, unsigned address) {
  block.model.bus_i = page_read(address);
  block.model.eval();
  const std::uint32_t data = block.model.data_o;
  block.clock();
  block.model.bus_i = 0;
  return data;
}
template <typename Block>
void write_page(Block& block, unsigned address, std::uint32_t data) {
  block.model.bus_i = page_write(address, data);
  block.clock();
  block.model.bus_i = 0;
}

}  // namespace mb4test

#endif  // TESTS_BLOCK_AXI_AXI_BUS_HPP_
