// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The kinds of fault: name, keys and effect of each. fault_types.cpp holds the only list of them.
#ifndef MB4SIM_FAULT_TYPES_HPP_
#define MB4SIM_FAULT_TYPES_HPP_

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sim/core/cable.hpp"
#include "sim/core/random.hpp"
#include "sim/core/time.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/faults/fault.hpp"
#include "sim/faults/fault_target.hpp"
#include "sim/lines/slave.hpp"

namespace mb4::sim {

// Where a fault acts. This decides which of FaultConfig::channel and ::slave it has.
enum class FaultPlace { kLine, kSlave, kHost, kClock };

// One [[fault]] table at work.
struct FaultScene {
  const FaultConfig& config;
  FaultTarget& target;
  Random& random;            // of this table
  const WireFaults& ma_was;  // faults of the cable without those of this table
  const WireFaults& sl_was;
  Time now;
  FaultRecord& record;  // of the fault that begins or ends
};

// What a fault may be at most, from the master.
struct FaultLimits {
  std::int64_t min_clk_hz;
  std::int64_t max_clk_hz;
};

struct FaultType {
  FaultKind kind;
  std::string_view name;  // value of `kind` in the scenario
  FaultPlace place;
  bool momentary;  // it has no duration
  // kSlave: the fault that the slave itself must be able to have.
  std::optional<SlaveFault> of_slave;
  // Reads the keys that only this kind has. Throws ScenarioError.
  void (*read)(TomlReader& reader, const FaultLimits& limits, FaultConfig& fault);
  // Makes the fault begin. Returns what it is, for the record, whose times are set.
  std::string (*begin)(const FaultScene& scene);
  // Makes the fault end. Null if it is momentary.
  void (*end)(const FaultScene& scene);
};

// In the order in which they are listed to the user.
std::span<const FaultType> fault_types();
const FaultType& fault_type(FaultKind kind);

}  // namespace mb4::sim

#endif  // MB4SIM_FAULT_TYPES_HPP_
