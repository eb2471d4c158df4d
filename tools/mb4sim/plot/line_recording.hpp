// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Records the pins of a clocked line edge by edge, and finds where its frames begin and end.
#ifndef MB4SIM_TOOL_LINE_RECORDING_HPP_
#define MB4SIM_TOOL_LINE_RECORDING_HPP_

#include <vector>

#include "plot/wave.hpp"
#include "sim/core/time.hpp"
#include "sim/lines/clocked/clocked_line.hpp"

namespace mb4::tool {

// The edges of one frame on the line, not decoded.
struct FrameTrace {
  sim::Time begin = 0;            // first falling edge of MA
  sim::Time clock_end = 0;        // last edge of MA
  sim::Time last_falling = 0;     // last falling edge of MA
  sim::Time end = 0;              // SL is 1 again after the frame, or the next frame begins
  std::vector<sim::Time> rising;  // edges of MA
  bool rest = true;               // level of MA after the last edge

  sim::Time period() const { return rising.size() < 2 ? 0 : rising[1] - rising[0]; }
};

class LineRecording {
 public:
  // Records `line` from now on. Neither of the two may be moved.
  explicit LineRecording(sim::ClockedLine& line);
  LineRecording(const LineRecording&) = delete;
  LineRecording& operator=(const LineRecording&) = delete;

  void clear();
  const Wave& ma() const { return ma_; }
  const Wave& mo() const { return mo_; }
  const Wave& sl() const { return sl_; }
  // Frames that have been clocked to their end until `now`: a rest of MA of more than a period and
  // a half ends one.
  std::vector<FrameTrace> frames(sim::Time now) const;

 private:
  static void on_edge(sim::Time now, void* receiver, sim::ClockedLine::Signal signal, bool level);

  Wave ma_;
  Wave mo_{false, {}};
  Wave sl_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_LINE_RECORDING_HPP_
