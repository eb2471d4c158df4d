// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/replay/replay_recording.hpp"

#ifdef __EMSCRIPTEN__
#include <fast_float/fast_float.h>
#endif

#include <charconv>
#include <cmath>
#include <type_traits>

namespace mb4::sim {
namespace {

constexpr std::uint64_t kMaxMaHz = 100'000'000;
constexpr double kMaxNs = 1e9;  // one second

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view kBlank = " \t\r";
  for (auto at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlank, end);
  }
  return words;
}

template <typename T>
auto read_number(const char* begin, const char* end, T& value) {
#ifdef __EMSCRIPTEN__  // std::from_chars of its library takes whole numbers only
  if constexpr (std::is_floating_point_v<T>)
    return fast_float::from_chars(begin, end, value);
  else
#endif
    return std::from_chars(begin, end, value);
}

template <typename T>
bool parse_number(std::string_view word, T& value) {
  const auto [end, error] = read_number(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

ReplayRecording parse_recording(std::string_view text, const std::string& name) {
  ReplayRecording recording;
  bool level = true;
  unsigned number = 0;
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
    const auto words = words_of(line);
    if (words.empty()) continue;
    if (words.size() != 2) fail("expected 'ma_hz FREQUENCY' or 'NANOSECONDS LEVEL'");
    if (words[0] == "ma_hz") {
      if (recording.ma_hz != 0) fail("ma_hz is given twice");
      if (!parse_number(words[1], recording.ma_hz) || recording.ma_hz == 0 ||
          recording.ma_hz > kMaxMaHz) {
        fail("ma_hz: expected a whole number of 1 to 100000000");
      }
      continue;
    }
    double ns = 0;
    if (!parse_number(words[0], ns) || !(ns >= 0) || ns > kMaxNs) {
      fail("expected a time of 0 to 1e9 ns, found '" + std::string(words[0]) + "'");
    }
    if (words[1] != "0" && words[1] != "1") {
      fail("expected level 0 or 1, found '" + std::string(words[1]) + "'");
    }
    const ReplayRecording::Edge edge{from_ns(ns), words[1] == "1"};
    if (!recording.edges.empty() && edge.time <= recording.edges.back().time) {
      fail("time does not come after the edge before");
    }
    if (edge.level == level) {
      fail("level is " + std::string(words[1]) + " already (SL rests at 1 before the first edge)");
    }
    level = edge.level;
    recording.edges.push_back(edge);
  }
  if (recording.ma_hz == 0) fail("ma_hz is missing");
  if (recording.edges.empty()) fail("no edges");
  if (!level) fail("the last edge must go to 1");
  return recording;
}

}  // namespace mb4::sim
