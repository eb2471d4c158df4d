// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Recorded frames: the edges of SL after the first falling edge of MA. sim/README.md describes the
// text format.
#ifndef MB4SIM_REPLAY_RECORDING_HPP_
#define MB4SIM_REPLAY_RECORDING_HPP_

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/time.hpp"

namespace mb4::sim {

struct ReplayRecording {
  struct Edge {
    Time time = 0;  // ps after the first falling edge of MA
    bool level = false;
  };

  struct Frame {
    std::vector<Edge> edges;  // in order of time; each changes the level; the first goes to 0, the
                              // last to 1, because SL rests at 1
    std::size_t rising = 0;   // edges of MA while recording; 0: not known
  };

  std::uint64_t ma_hz = 0;  // frequency of MA while recording
  std::vector<Frame> frames;
};

inline constexpr std::uint64_t kMaxRecordedHz = 100'000'000;  // of MA

// A mistake in a file of edges or in a capture. what() is the complete message "file:line:
// message". For an empty file it has no line.
class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Reads an edge file, which has one frame. `name` is the file name for messages. Throws
// RecordingError.
ReplayRecording parse_recording(std::string_view text, const std::string& name);

}  // namespace mb4::sim

#endif  // MB4SIM_REPLAY_RECORDING_HPP_
