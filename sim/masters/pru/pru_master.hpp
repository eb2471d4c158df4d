// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_pru as a master of a scenario.
#ifndef MB4SIM_PRU_MASTER_HPP_
#define MB4SIM_PRU_MASTER_HPP_

#include <cstdint>

#include "sim/masters/master.hpp"

namespace mb4::sim {

extern const Master kPruMaster;

// The two values of ClockHz. Each has a model of its own.
inline constexpr std::uint64_t kPruSlowHz = 80'000'000;
inline constexpr std::uint64_t kPruFastHz = 200'000'000;

// Bits of ChipConfig::quirks, as in pru_pkg::quirks_t.
inline constexpr unsigned kPruExtra10 = 1U << 0U;
inline constexpr unsigned kPruFirstLow = 1U << 1U;
inline constexpr unsigned kPruSmaWrap = 1U << 2U;

// MA frequencies that register FREQUENCY can have.
constexpr bool pru_has_frequency(std::uint64_t mhz) {
  return mhz == 1 || mhz == 2 || mhz == 5 || mhz == 10;
}

}  // namespace mb4::sim

#endif  // MB4SIM_PRU_MASTER_HPP_
