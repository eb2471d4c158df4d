// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Captures of a logic analyser: MA and SL of a line out of a VCD file, a session of sigrok (.sr) or
// a CSV file of sigrok or another program. sim/README.md describes what is read of each.
#ifndef MB4SIM_REPLAY_CAPTURE_HPP_
#define MB4SIM_REPLAY_CAPTURE_HPP_

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/time.hpp"
#include "sim/lines/replay/replay_recording.hpp"

namespace mb4::sim {

struct CaptureSignal {
  bool first = true;                         // level at the beginning
  std::vector<ReplayRecording::Edge> edges;  // each changes the level; ps since the beginning

  bool last() const { return edges.empty() ? first : edges.back().level; }
  // Times must not go back.
  void set(Time time, bool level);
  void invert();
};

struct CaptureNames {
  std::string ma;
  std::string sl;
};

struct Capture {
  CaptureSignal ma;
  CaptureSignal sl;
  Time end = 0;
};

// Each reads a file; `name` is that of the file, for messages. They throw RecordingError with the
// line, or the byte of an .sr file, and what is expected there.
Capture parse_vcd(std::string_view text, const std::string& name, const CaptureNames& signals);
Capture parse_csv(std::string_view text, const std::string& name, const CaptureNames& signals);
Capture parse_sr(std::string_view bytes, const std::string& name, const CaptureNames& signals);
// By the ending of the file's name.
Capture parse_capture(std::string_view bytes, const std::string& name, const CaptureNames& signals);

// The frames of a capture. One begins with a falling edge of MA after a rest, which is longer than
// a period of MA, or than `rest` if it is not 0. Left out: what has fewer than three rising edges
// of MA, or no edge of SL, or begins or ends with SL = 0, or is cut off by the end of the capture.
// Throws RecordingError if no frame remains.
ReplayRecording frames_of(const Capture& capture, Time rest, const std::string& name,
                          const CaptureNames& signals);

// Places in the files, for the parsers.
[[noreturn]] void fail_at_line(const std::string& name, std::size_t line,
                               const std::string& message);
// Hertz of a text such as "200 MHz"; 0 if it is none.
double frequency(std::string_view text);
// The time of a sample; they count from 0.
Time sample_time(std::uint64_t sample, double rate_hz);
// The names that a file offers, for messages: "'MA1', 'SL1'".
std::string quoted(const std::vector<std::string>& names);

}  // namespace mb4::sim

#endif  // MB4SIM_REPLAY_CAPTURE_HPP_
