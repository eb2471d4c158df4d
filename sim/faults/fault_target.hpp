// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What faults can reach of a simulation.
#ifndef MB4SIM_FAULT_TARGET_HPP_
#define MB4SIM_FAULT_TARGET_HPP_

#include <cstdint>
#include <optional>

#include "sim/core/time.hpp"

namespace mb4::sim {

class Line;
class Slave;

class FaultTarget {
 public:
  virtual Time now() const = 0;
  // Line and slave exist: a scenario cannot ask for a fault elsewhere.
  virtual Line& line(unsigned channel) = 0;
  virtual Slave& slave(unsigned number) = 0;
  // Number of wires of each line.
  virtual unsigned wires() const = 0;
  // The next transfer of the host ends after `bits` (1 or more) clocks.
  virtual void abort_transfer(std::uint64_t bits) = 0;
  // Frequency of the master's clock from `now` on; 0: it stops; nothing: as the scenario says.
  virtual void set_clock(Time now, std::optional<std::uint64_t> hz) = 0;

 protected:
  ~FaultTarget() = default;
};

}  // namespace mb4::sim

#endif  // MB4SIM_FAULT_TARGET_HPP_
