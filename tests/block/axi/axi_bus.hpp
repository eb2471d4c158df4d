// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Accesses to the page of the axi_* modules.
#ifndef TESTS_BLOCK_AXI_AXI_BUS_HPP_
#define TESTS_BLOCK_AXI_AXI_BUS_HPP_

#include <cstdint>

#include "places.hpp"

namespace mb4test {

constexpr std::uint64_t page_read(unsigned address) {
  namespace at = places::axi_pkg::bus_t;
  return at::kRd(1) | at::kAddr(address);
}
constexpr std::uint64_t page_write(unsigned address, std::uint32_t data) {
  namespace at = places::axi_pkg::bus_t;
  return at::kWr(1) | at::kAddr(address) | at::kData(data);
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
