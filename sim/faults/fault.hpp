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

namespace mb4::sim {

enum class FaultKind {
  kBitFlip,  // line: bits of the next frame
  kGlitch,
  kStuck,
  kJitter,
  kSilent,  // slave
  kBusy,
  kWrongCrc,
  kWrongId,
  kStuckWord,
  kStuckCounter,
  kSkippedWord,
  kSwappedWords,
  kUnplug,
  kAbort,           // host: an SPI frame ends early
  kClockFrequency,  // pin CLK
  kClockStop,
};

// Name of a fault as in the scenario: "bit-flip", ...
std::string_view to_string(FaultKind kind);
// True for a fault that has no duration: bit-flip, glitch, abort.
bool is_momentary(FaultKind kind);
// True for a fault of the clock, which acts on all lines.
bool is_of_clock(FaultKind kind);

struct FaultConfig {
  FaultKind kind = FaultKind::kGlitch;
  unsigned channel = 0;  // from 1 on, also for a slave's fault; 0: host and clock
  unsigned slave = 0;    // from 1 on, as in SCDATAx; 0: none
  bool on_ma = false;    // glitch, stuck, jitter: MA at the slaves instead of SL at the chip
  bool level = false;    // stuck
  Time width = 0;        // glitch, jitter, ps
  std::uint64_t hz = 0;  // clock-frequency
  // bit-flip: bits of the frame as in SlFaults. abort: one number of SCLK clocks. Empty: random.
  std::vector<unsigned> bits;
  unsigned frame_bits = 1;  // a random bit of bit-flip is below this number

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
  // Not 0: the fault waits for this frame and hits it alone, by SlFaults::frames().
  std::uint64_t frame = 0;
  std::string what;  // "glitch of 10 ns on SL of channel 1"
};

}  // namespace mb4::sim

#endif  // MB4SIM_FAULT_HPP_
