// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults and cable events that are added to a running simulation, as a text in the form of a
// scenario. sim/README.md lists the keys.
#ifndef MB4SIM_INJECTION_HPP_
#define MB4SIM_INJECTION_HPP_

#include <string>
#include <string_view>
#include <vector>

#include "sim/core/time.hpp"
#include "sim/faults/fault.hpp"
#include "sim/lines/line.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::sim {

struct Injection {
  struct Event {
    unsigned channel;
    LineEvent event;
  };
  std::vector<FaultConfig> faults;
  std::vector<Event> events;
};

// Reads [[fault]] tables, and [[channel]] tables that hold `number` and [[channel.event]] only. The
// times of the text count from `now`; those of the result count from power-on. `name` is used in
// messages. Throws ScenarioError.
Injection parse_injection(std::string_view text, const std::string& name, const Scenario& scenario,
                          Time now);

}  // namespace mb4::sim

#endif  // MB4SIM_INJECTION_HPP_
