// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reports for each fault of a scenario how chip and driver detected it.
#ifndef MB4SIM_TOOL_FAULT_REPORT_HPP_
#define MB4SIM_TOOL_FAULT_REPORT_HPP_

#include <cstdint>
#include <string>
#include <vector>

#include "session.hpp"
#include "sim/core/time.hpp"
#include "sim/faults/fault.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

// One line for each record from number `from` (0 = first) on: "  fault 3 at 250.000 us: glitch
// ...".
std::string fault_lines(const std::vector<sim::FaultRecord>& records, std::size_t from);

// The same on standard error; with `json` notes as print_note() writes them.
void print_faults(bool json, const std::vector<sim::FaultRecord>& records, std::size_t from = 0);

// The frames of a fault are those that end after the fault begins, up to the first frame that
// begins after the fault ends. The first of them with a bad result on the fault's channel decides;
// for faults of host and clock any channel counts. If this frame delivered a wrong word as good,
// the fault was missed; else it was detected. If there is no such frame, the fault had no effect. A
// fault of a named frame happens when this comes; one whose frame never comes is told as that. What
// Session::told_between() knows of a named frame has detected it, and Session::late_frames() more
// frames may tell of a fault. A wrong-id fault is detected by a register access.
class FaultReport {
 public:
  enum class Fate { kOpen, kNoEffect, kDetected, kMissed };
  struct Entry {
    Fate fate = Fate::kOpen;
    std::string by;           // "frame 3, slave 1: CRC error"; empty: not detected
    std::string error;        // "CRC error"
    bool id_checked = false;  // wrong-id: a register access has been tried
    unsigned late = 0;        // frames since it was over
  };

  // Both outlive the report.
  FaultReport(const sim::Scenario& scenario, const std::vector<sim::FaultRecord>& records);

  // A frame that the session has read. Makes the register access that a fault of an ID needs.
  void add(const SessionFrame& frame, Session& session);
  // True if no register access was refused or answered by the wrong slave.
  bool ids_good() const { return ids_good_; }
  std::uint64_t count(Fate fate) const;
  // The end of the run: faults without a result had no effect.
  void finish();

  // One line for each fault since the last call.
  std::string new_lines();
  // The counts and, for each kind of fault, the errors that detected it. Empty without faults in
  // the scenario.
  std::string summary() const;
  // A JSON array; a fault whose frame has not come has no number.
  std::string json() const;
  bool any() const { return !scenario_.faults.empty(); }

 private:
  void add_new();
  // Faults of a named frame that has not come.
  std::vector<const sim::FaultConfig*> not_reached() const;
  void frame(const SessionFrame& frame, Session& session);
  // The slave of a wrong-id fault that no register access has checked yet, or 0.
  unsigned unchecked_id() const;
  // Takes the result of a register access to this slave: an error, or empty.
  void id_checked(unsigned slave, const std::string& error);

  const sim::Scenario& scenario_;
  const std::vector<sim::FaultRecord>& records_;
  std::vector<Entry> entries_;  // as records_
  std::size_t first_open_ = 0;
  std::size_t printed_ = 0;
  bool ids_good_ = true;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_FAULT_REPORT_HPP_
