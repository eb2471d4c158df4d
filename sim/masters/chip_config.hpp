// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The clocks and parameters of a master: the part [chip] of a scenario.
#ifndef MB4SIM_CHIP_CONFIG_HPP_
#define MB4SIM_CHIP_CONFIG_HPP_

#include <cstdint>

#include "sim/core/scenario_error.hpp"

namespace mb4::sim {

struct ChipConfig {
  std::uint64_t f_clk_hz = 20'000'000;  // pin CLK; 0 = not connected, the pin stays 0
  std::uint64_t f_osc_hz = 20'000'000;  // internal oscillator
  // The parameters of the master. The package of its RTL names the bits.
  unsigned quirks = 0;
  // [chip] features, in bits of the master. 0 is its default.
  std::uint32_t features = 0;
  TableSource source;

  // The frequency that the chip is meant to run from: pin CLK if it is connected, else the
  // oscillator.
  std::uint64_t system_hz() const { return f_clk_hz != 0 ? f_clk_hz : f_osc_hz; }
};

}  // namespace mb4::sim

#endif  // MB4SIM_CHIP_CONFIG_HPP_
