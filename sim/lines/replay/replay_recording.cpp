// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/replay/replay_recording.hpp"

#include <algorithm>

#include "sim/core/number_text.hpp"
#include "sim/core/words.hpp"

namespace mb4::sim {
namespace {

constexpr double kMaxNs = 1e9;  // one second

}  // namespace

ReplayRecording parse_recording(std::string_view text, const std::string& name) {
  ReplayRecording recording;
  bool level = true;
  unsigned number = 0;
  ReplayRecording::Frame frame;
  const auto fail = [&](const std::string& message) -> void {
    throw RecordingError(name + ":" + std::to_string(number) + ": " + message);
  };
  if (text.empty()) throw RecordingError(name + ": the file is empty");
  while (!text.empty()) {
    ++number;
    const auto end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line = line.substr(0, std::min(line.find('#'), line.size()));
    const auto words = split_at_blanks(line);
    if (words.empty()) continue;
    if (words.size() != 2) fail("expected 'ma_hz FREQUENCY' or 'NANOSECONDS LEVEL'");
    if (words[0] == "ma_hz") {
      if (recording.ma_hz != 0) fail("ma_hz is given twice");
      const auto ma_hz = parse_word(words[1]);
      if (!ma_hz || *ma_hz == 0 || *ma_hz > kMaxRecordedHz) {
        fail("ma_hz: expected a whole number of 1 to 100000000");
      }
      recording.ma_hz = *ma_hz;
      continue;
    }
    const auto ns = parse_real(words[0]);
    if (!ns || !(*ns >= 0) || *ns > kMaxNs) {
      fail("expected a time of 0 to 1e9 ns, found '" + std::string(words[0]) + "'");
    }
    if (words[1] != "0" && words[1] != "1") {
      fail("expected level 0 or 1, found '" + std::string(words[1]) + "'");
    }
    const ReplayRecording::Edge edge{from_ns(*ns), words[1] == "1"};
    if (!frame.edges.empty() && edge.time <= frame.edges.back().time) {
      fail("time does not come after the edge before");
    }
    if (edge.level == level) {
      fail("level is " + std::string(words[1]) + " already (SL rests at 1 before the first edge)");
    }
    level = edge.level;
    frame.edges.push_back(edge);
  }
  if (recording.ma_hz == 0) fail("ma_hz is missing");
  if (frame.edges.empty()) fail("no edges");
  if (!level) fail("the last edge must go to 1");
  recording.frames.push_back(std::move(frame));
  return recording;
}

}  // namespace mb4::sim
