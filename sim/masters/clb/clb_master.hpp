// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_clb as a master of a scenario.
#ifndef MB4SIM_CLB_MASTER_HPP_
#define MB4SIM_CLB_MASTER_HPP_

#include <cstdint>

#include "sim/masters/master.hpp"

namespace mb4::sim {

extern const Master kClbMaster;

// Clocks of half a period of MA that a scenario can have.
inline constexpr std::uint64_t kClbShortestHalf = 4;  // with less no word is promised
inline constexpr std::uint64_t kClbLongestHalf = 2048;
// The half period that is nearest to a frequency.
constexpr std::uint64_t clb_half(std::uint64_t clk_hz, std::uint64_t ma_hz) {
  return (clk_hz + ma_hz) / (2 * ma_hz);
}

}  // namespace mb4::sim

#endif  // MB4SIM_CLB_MASTER_HPP_
