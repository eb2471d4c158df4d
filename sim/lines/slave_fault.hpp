// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A fault that a scenario can ask of a slave. Those that slaves of several protocols can have stand
// here. A protocol keeps its own ones in its room and lists them in Protocol::faults.
#ifndef MB4SIM_SLAVE_FAULT_HPP_
#define MB4SIM_SLAVE_FAULT_HPP_

#include <string_view>

namespace mb4::sim {

struct SlaveFault {
  std::string_view name;     // value of `kind` in the scenario, and what tells two faults apart
  std::string_view happens;  // for the record; % stands for the slave: "wrong CRC from %"
  std::string_view refusal;  // said of a device that cannot have it; empty: any device can
  bool needs_next = false;   // it needs a slave behind
  bool in_accesses = false;  // no frame shows it, only an access to the slave's registers

  bool operator==(const SlaveFault& other) const { return name == other.name; }
};

namespace slave_fault {

// SLO is 1, whatever the slave sends.
inline constexpr SlaveFault kSilent{"silent", "% silent", ""};
// The acknowledge does not end.
inline constexpr SlaveFault kBusy{"busy", "% busy for ever", "this slave has no busy time"};
// The last bit of the CRC after the data is inverted.
inline constexpr SlaveFault kWrongCrc{"wrong-crc", "wrong CRC from %", "this slave sends no CRC"};

// In the order in which they are listed to the user, before those of the protocols.
inline constexpr const SlaveFault* kShared[] = {&kSilent, &kBusy, &kWrongCrc};

}  // namespace slave_fault

}  // namespace mb4::sim

#endif  // MB4SIM_SLAVE_FAULT_HPP_
