// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults that a scenario asks for ([[fault]]), and the record of those that have happened.
#ifndef MB4SIM_FAULT_HPP_
#define MB4SIM_FAULT_HPP_

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/time.hpp"
#include "sim/lines/slave_fault.hpp"

namespace mb4::sim {

// Where a fault acts. This decides which of FaultConfig::channel and ::slave it has.
enum class FaultPlace { kLine, kSlave, kHost, kClock };

struct FaultConfig;
struct FaultLimits;
struct FaultScene;
class TomlReader;

// A kind of fault.
struct FaultType {
  std::string_view name;  // value of `kind` in the scenario
  FaultPlace place;
  bool momentary;  // it has no duration
  // The fault that the slave itself has. Null if something else has it: unplug is one of the cable.
  const SlaveFault* of_slave;
  // Reads the keys that only this kind has. Throws ScenarioError.
  void (*read)(TomlReader& reader, const FaultLimits& limits, FaultConfig& fault);
  // Makes the fault begin. Returns what it is, for the record, whose times are set.
  std::string (*begin)(const FaultScene& scene);
  // Makes the fault end. Null if it is momentary.
  void (*end)(const FaultScene& scene);
  bool by_frame = false;  // a named frame can be its time
};

struct FaultConfig {
  const FaultType* kind = nullptr;  // of fault_types(); must be set
  unsigned channel = 0;             // from 1 on, also for a slave's fault; 0: host and clock
  unsigned slave = 0;               // from 1 on; 0: none
  unsigned wire = 0;                // glitch, stuck, jitter: of the wires of the line
  std::string_view wire_title;
  bool level = false;    // stuck
  Time width = 0;        // glitch, jitter, ps
  std::uint64_t hz = 0;  // clock-frequency
  // bit-flip: bits of the frame as in Line::flip(). abort: one number of SCLK clocks. Empty:
  // random.
  std::vector<unsigned> bits;
  // bit-flip: this frame is hit, by Line::flip_frames(), and the fault happens when it comes; 0:
  // the next one.
  std::uint64_t frame = 0;
  unsigned frame_bits = 1;   // a random bit of bit-flip is below this number
  unsigned answer_bits = 0;  // ... and so is each named one; 0: no such limit is known

  std::vector<Time> at;    // times since power-on, ps; empty: random times
  double per_s = 0;        // random: average number in a second
  Time from = 0;           // random: no fault before this time
  Time to = kNever;        // random: no fault after this time
  Time duration = kNever;  // ps; kNever: to the end

  unsigned scenario_line = 0;  // line number of the table in the scenario file; 0: no file
};

// A fault that has happened. Times are in ps since power-on.
struct FaultRecord {
  std::size_t config = 0;  // index into Scenario::faults
  Time begin = 0;
  Time end = kNever;  // of a fault with a duration: kNever until it is over
  // Not 0: the fault waits for this frame and hits it alone; frames count as in
  // Line::flip_frames().
  std::uint64_t frame = 0;
  std::string what;  // "channel 1: ..."
};

}  // namespace mb4::sim

#endif  // MB4SIM_FAULT_HPP_
