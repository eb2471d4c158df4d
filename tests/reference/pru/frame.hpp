// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One frame, read from the recorded edges of MA and SL, without memory of other frames but the
// average: R-P6 to R-P8, R-P11, R-P12, R-P13, R-P15, R-P16.
#ifndef TESTS_REFERENCE_PRU_FRAME_HPP_
#define TESTS_REFERENCE_PRU_FRAME_HPP_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/reference/pru/average.hpp"
#include "tests/reference/pru/sampling.hpp"
#include "tests/reference/pru/trace.hpp"

namespace pru_judge {

// How a frame ended.
enum class FrameKind {
  kSlLow,          // SL = 0 before the frame: no MA
  kNoAcknowledge,  // no byte other than 0xFF
  kDropped,        // too many zeros after the acknowledge
  kRead,
};

// What the recorder has of a frame. MA and SL at the pins of the master.
struct FrameRecord {
  Time start = 0;  // instant of the presence test: the trigger, or the end of the 40 us after RUN
  Time end = 0;    // the memory changed, or later, but before MA moves for the next frame
  const Trace& ma;
  const Trace& sl;
  // The instant at which the memory changed, if it shall be checked.
  std::optional<Time> updated{};
};

struct FrameSettings {
  Rate rate{};
  SamplePhase phase{};
  unsigned position_bits = 1;
  unsigned check_bits = 0;  // nE, nW and CRC
  unsigned limit = 40;      // zeros after the acknowledge that are allowed
  bool first_low = false;
  bool sma_wrap = false;
  bool averages = false;  // the average is on in this frame
  Average average{};

  // Bits after CDS.
  unsigned bits() const { return position_bits + check_bits; }
  // Clocks after rising edge 2: acknowledge, START, CDS and bits (facts 1.3 item 1).
  unsigned search_periods() const { return 3 + bits(); }
};

struct FrameReading {
  FrameKind kind = FrameKind::kSlLow;
  Time rising_edge_1 = 0;
  std::uint8_t raw = 0;    // byte with the acknowledge; 0xFF without
  unsigned byte = 0;       // its number: the line delay in periods
  unsigned own_place = 0;  // 0..15 after its oldest sample
  unsigned used_place = 0;
  unsigned zeros = 0;  // after the acknowledge
  bool cds = false;
  std::string bits;      // after CDS
  Time start_bit = 0;    // instant of the sample of START
  Time last_sample = 0;  // R-P10 counts OVERHEAD from here
};

// Rising edge 1 of a frame that begins at `start`: the first rising edge after a falling one, so
// that MA that has rested at 0 may rise before. None: MA has no such edge.
std::optional<Time> rising_edge_1(const std::vector<Edge>& ma);

// Reads a frame with MA, whose rising edge 1 is known.
FrameReading read_frame(const FrameSettings& settings, const Trace& sl, Time rising_edge_1);

}  // namespace pru_judge

#endif  // TESTS_REFERENCE_PRU_FRAME_HPP_
