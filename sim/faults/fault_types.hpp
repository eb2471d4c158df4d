// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The list of all kinds of fault, and what their functions are given. The faults that a slave
// itself has come from sim/lines (slave_fault.hpp and the protocols).
#ifndef MB4SIM_FAULT_TYPES_HPP_
#define MB4SIM_FAULT_TYPES_HPP_

#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/random.hpp"
#include "sim/core/time.hpp"
#include "sim/core/wire_faults.hpp"
#include "sim/faults/fault.hpp"
#include "sim/faults/fault_target.hpp"
#include "sim/lines/line.hpp"

namespace mb4::sim {

// One [[fault]] table at work.
struct FaultScene {
  const FaultConfig& config;
  FaultTarget& target;
  Random& random;  // of this table
  // Faults of each wire of the line without those of any table.
  const std::vector<WireFaults>& was;
  Time now;
  FaultRecord& record;  // of the fault that begins or ends
  FlipWatch hit;        // to be told when a named frame has come
};

// What a fault may be at most, from the master.
struct FaultLimits {
  std::int64_t min_clk_hz;
  std::int64_t max_clk_hz;
  std::span<const WireName> wires;  // of its lines
};

// In the order in which they are listed to the user. A pointer into it holds for ever.
std::span<const FaultType> fault_types();

}  // namespace mb4::sim

#endif  // MB4SIM_FAULT_TYPES_HPP_
