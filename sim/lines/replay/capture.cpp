// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/lines/replay/capture.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sim/core/number_text.hpp"

namespace mb4::sim {
namespace {

// Mean distance of the rising edges of MA within frames: most distances are of frames.
Time period_of(const CaptureSignal& ma) {
  std::vector<Time> distances;
  Time before = kNever;
  for (const auto& edge : ma.edges) {
    if (!edge.level) continue;
    if (before != kNever) distances.push_back(edge.time - before);
    before = edge.time;
  }
  if (distances.empty()) return 0;
  std::vector<Time> sorted = distances;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  const Time middle = sorted[sorted.size() / 2];
  std::erase_if(distances, [&](Time d) { return d < middle * 3 / 4 || d > middle * 5 / 4; });
  return std::accumulate(distances.begin(), distances.end(), Time{0}) / distances.size();
}

// The indexes of the edges of MA that begin a frame. The phase before the falling edge is a rest,
// or the one before that: MA rests at 0 after a frame with CDM = 1.
std::vector<std::size_t> beginnings(const CaptureSignal& ma, Time rest) {
  std::vector<std::size_t> found;
  const auto time = [&](std::size_t i) { return ma.edges[i].time; };
  for (std::size_t i = 0; i < ma.edges.size(); ++i) {
    if (ma.edges[i].level) continue;
    const Time high = i == 0 ? time(0) : time(i) - time(i - 1);
    const Time low = i < 2 ? 0 : time(i - 1) - time(i - 2);
    if (high > rest || low > rest) found.push_back(i);
  }
  return found;
}

}  // namespace

void CaptureSignal::set(Time time, bool level) {
  if (level == last()) return;
  if (!edges.empty() && edges.back().time == time) {
    edges.pop_back();  // a step of no length
  } else if (time == 0) {
    first = level;
  } else {
    edges.push_back({time, level});
  }
}

void CaptureSignal::invert() {
  first = !first;
  for (auto& edge : edges) edge.level = !edge.level;
}

void fail_at_line(const std::string& name, std::size_t line, const std::string& message) {
  throw RecordingError(name + ":" + std::to_string(line) + ": " + message);
}

double frequency(std::string_view text) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"GHz", 1e9}, {"MHz", 1e6}, {"kHz", 1e3}, {"Hz", 1}, {"", 1}};
  const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
  const auto number = parse_real(text.substr(0, digits));
  text.remove_prefix(digits);
  if (text.starts_with(' ')) text.remove_prefix(1);
  for (const auto& [unit, hz] : kUnits) {
    if (number && text == unit && *number * hz <= 1e11) return *number * hz;
  }
  return 0;
}

Time sample_time(std::uint64_t sample, double rate_hz) {
  return static_cast<Time>(static_cast<double>(sample) * (1e12 / rate_hz) + 0.5);
}

std::string quoted(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text.empty() ? "none" : text;
}

Capture parse_capture(std::string_view bytes, const std::string& name,
                      const CaptureNames& signals) {
  if (name.ends_with(".vcd")) return parse_vcd(bytes, name, signals);
  if (name.ends_with(".sr")) return parse_sr(bytes, name, signals);
  if (name.ends_with(".csv")) return parse_csv(bytes, name, signals);
  throw RecordingError(name + ": expected a capture with the ending .vcd, .sr or .csv");
}

ReplayRecording frames_of(const Capture& capture, Time rest, const std::string& name,
                          const CaptureNames& signals) {
  const auto fail = [&](const std::string& message) {
    throw RecordingError(name + ": " + message);
  };
  const Time period = period_of(capture.ma);
  if (period == 0) fail("'" + signals.ma + "' rises fewer than twice: expected the clock MA");
  ReplayRecording recording;
  recording.ma_hz = (kPsPerSecond + period / 2) / period;
  if (recording.ma_hz > kMaxRecordedHz) {
    fail("'" + signals.ma + "' has more than 100 MHz: expected the clock MA");
  }
  if (rest == 0) rest = period;
  const auto begins = beginnings(capture.ma, rest);
  unsigned cut_off = 0;
  unsigned silent = 0;
  unsigned low = 0;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const bool last = i + 1 == begins.size();
    const std::size_t end_index = last ? capture.ma.edges.size() : begins[i + 1];
    const Time begin = capture.ma.edges[begins[i]].time;
    const Time end = last ? capture.end : capture.ma.edges[end_index].time;
    if (last && end - capture.ma.edges.back().time <= rest) {
      ++cut_off;
      continue;
    }
    const auto after = [](const auto& edge, Time time) { return edge.time < time; };
    const auto& sl = capture.sl.edges;
    const auto from = std::lower_bound(sl.begin(), sl.end(), begin, after);
    const auto to = std::lower_bound(from, sl.end(), end, after);
    const bool before = from == sl.begin() ? capture.sl.first : std::prev(from)->level;
    // Edges of MA of a frame: falling, rising, falling, ...
    if (from == to || end_index - begins[i] < 6) {
      ++silent;
    } else if (!before || !std::prev(to)->level) {
      ++low;
    } else {
      auto& frame = recording.frames.emplace_back();
      frame.rising = (end_index - begins[i]) / 2;
      for (auto edge = from; edge != to; ++edge) {
        frame.edges.push_back({edge->time - begin, edge->level});
      }
    }
  }
  if (!recording.frames.empty()) return recording;
  if (begins.empty()) {
    fail("no frame begins: expected a falling edge of '" + signals.ma +
         "' after a rest of more than " + std::to_string((rest + kPsPerNs / 2) / kPsPerNs) + " ns");
  }
  fail("none of " + std::to_string(begins.size()) + " frames of '" + signals.ma +
       "' can be played: " + std::to_string(silent) + " without an answer of '" + signals.sl +
       "', " + std::to_string(low) + " that begin or end while it is 0, " +
       std::to_string(cut_off) + " cut off; expected '" + signals.sl +
       "' to rest at 1 (key 'invert')");
  return recording;
}

}  // namespace mb4::sim
