// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What the host does in a clock, as the modules of mb4/regs see it.
#ifndef TESTS_BLOCK_MB4_HOST_PORT_HPP_
#define TESTS_BLOCK_MB4_HOST_PORT_HPP_

#include <cstdint>

#include "places.hpp"

namespace mb4test {

constexpr std::uint32_t host_writes(unsigned address, unsigned byte, bool enable = true) {
  namespace at = places::mb4_pkg::host_t;
  return static_cast<std::uint32_t>(at::kWrEn(enable) | at::kWrAddr(address) | at::kWrData(byte));
}
constexpr std::uint32_t host_reads(unsigned address) {
  namespace at = places::mb4_pkg::host_t;
  return static_cast<std::uint32_t>(at::kRdEn(1) | at::kRdAddr(address));
}

}  // namespace mb4test

#endif  // TESTS_BLOCK_MB4_HOST_PORT_HPP_
