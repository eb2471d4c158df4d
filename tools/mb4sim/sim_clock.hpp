// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The clock of a driver on top of a simulator.
#ifndef MB4SIM_TOOL_SIM_CLOCK_HPP_
#define MB4SIM_TOOL_SIM_CLOCK_HPP_

#include <cstdint>

#include "mb4sim/simulator.hpp"

namespace mb4::tool {

// Each reading of the clock takes simulated time, as on a processor. Otherwise a driver that only
// reads the clock while it waits would wait for ever.
class SimClock {
 public:
  explicit SimClock(sim::Simulator& simulator) : simulator_(simulator) {}

  std::uint32_t now_us() {
    simulator_.advance(100 * sim::kPsPerNs);
    return static_cast<std::uint32_t>(simulator_.now() / sim::kPsPerUs);
  }

 private:
  sim::Simulator& simulator_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_SIM_CLOCK_HPP_
