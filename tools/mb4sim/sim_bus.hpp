// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver's bus and clock on top of a simulator.
#ifndef MB4SIM_TOOL_SIM_BUS_HPP_
#define MB4SIM_TOOL_SIM_BUS_HPP_

#include <cstdint>
#include <span>

#include "mb4/span.hpp"
#include "mb4sim/simulator.hpp"

namespace mb4::tool {

class SimBus {
 public:
  explicit SimBus(sim::Simulator& simulator) : simulator_(simulator) {}

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    simulator_.spi().transfer(std::span(tx.data(), tx.size()), std::span(rx.data(), rx.size()));
    return true;
  }

 private:
  sim::Simulator& simulator_;
};

// Looking at the clock takes time, as it does on a processor: a driver that waits by the clock
// alone would wait for ever otherwise.
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

#endif  // MB4SIM_TOOL_SIM_BUS_HPP_
