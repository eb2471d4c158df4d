// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/frame_diagram.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "sim/lines/clocked/clocked_line.hpp"

namespace mb4::tool {
namespace {

// Longer stretches without an edge are cut to this, in periods of MA.
constexpr double kLongestRest = 6;
constexpr double kBefore = 1;  // shown in front of the first edge
constexpr double kBehind = 1;

// Converts time to position. A cell is a period of MA. The middle of a long rest is cut out.
class Axis {
 public:
  Axis(const DecodedFrame& frame, const std::vector<const Wave*>& waves)
      : begin_(frame.trace.begin), period_(static_cast<double>(frame.trace.period())) {
    std::vector<sim::Time> times{frame.trace.begin, frame.trace.end};
    for (const Wave* wave : waves) {
      for (const Edge& edge : wave->edges) {
        if (edge.time > frame.trace.begin && edge.time < frame.trace.end)
          times.push_back(edge.time);
      }
    }
    // Nothing is cut where bits are read, even if their level does not change.
    times.insert(times.end(), frame.bits.begin(), frame.bits.end());
    std::sort(times.begin(), times.end());
    double position = kBefore;
    points_.push_back({times.front(), position});
    for (std::size_t i = 1; i < times.size(); ++i) {
      const double cells = static_cast<double>(times[i] - times[i - 1]) / period_;
      if (cells > kLongestRest) {
        const auto half = static_cast<sim::Time>(kLongestRest / 2 * period_);
        cuts_.push_back(position + kLongestRest / 2);
        points_.push_back({times[i - 1] + half, cuts_.back()});
        points_.push_back({times[i] - half, cuts_.back()});
      }
      position += std::min(cells, kLongestRest);
      points_.push_back({times[i], position});
    }
    length_ = position + kBehind;
  }

  double operator()(sim::Time time) const {
    if (time <= points_.front().time) {
      return points_.front().position - static_cast<double>(points_.front().time - time) / period_;
    }
    if (time >= points_.back().time) {
      return points_.back().position + static_cast<double>(time - points_.back().time) / period_;
    }
    const auto next = std::upper_bound(points_.begin(), points_.end(), time,
                                       [](sim::Time t, const Point& p) { return t < p.time; });
    const Point& a = *std::prev(next);
    return a.position + (next->position - a.position) * static_cast<double>(time - a.time) /
                            static_cast<double>(next->time - a.time);
  }
  // False for a time that is cut out.
  bool shown(sim::Time time) const {
    const double at = (*this)(time);
    return std::find(cuts_.begin(), cuts_.end(), at) == cuts_.end();
  }
  double length() const { return length_; }
  const std::vector<double>& cuts() const { return cuts_; }

 private:
  struct Point {
    sim::Time time;
    double position;
  };
  sim::Time begin_;
  double period_;
  std::vector<Point> points_;
  std::vector<double> cuts_;
  double length_ = 0;
};

DiagramRow wave_row(const char* name, const Wave& wave, const DecodedFrame& frame,
                    const Axis& axis) {
  const auto margin = static_cast<sim::Time>(kBehind * static_cast<double>(frame.trace.period()));
  const sim::Time from = frame.trace.begin - std::min(frame.trace.begin, margin);
  const Wave part = wave.between(from, frame.trace.end + margin);
  DiagramRow row;
  row.name = name;
  row.idle = part.idle;
  for (const Edge& edge : part.edges) row.levels.push_back({axis(edge.time), edge.level});
  return row;
}

DiagramRow field_row(const std::vector<Field>& fields, const Axis& axis) {
  DiagramRow row;
  row.type = DiagramRow::Type::kFields;
  for (const Field& field : fields) {
    row.fields.push_back({{axis(field.from), axis(field.to)}, field.kind, field.labels, field.bad});
  }
  return row;
}

// Numbers of rising edges: the first three, every fifth, the last.
DiagramRow edge_numbers(const DecodedFrame& frame, const Axis& axis) {
  DiagramRow row;
  row.type = DiagramRow::Type::kDigits;
  const std::size_t last = frame.trace.rising.size();
  for (std::size_t i = 1; i <= last; ++i) {
    const bool near_last = i != last && last - i < 2;
    if ((i <= 3 || i % 5 == 0 || i == last) && !near_last) {
      row.digits.push_back({axis(frame.trace.rising[i - 1]), fmt::format("{}", i)});
    }
  }
  return row;
}

DiagramRow bit_row(const Wave& sl, const DecodedFrame& frame, const Axis& axis) {
  DiagramRow row;
  row.type = DiagramRow::Type::kDigits;
  const sim::Time half = frame.trace.period() / 2;
  for (const sim::Time bit : frame.bits) {
    row.digits.push_back({axis(bit + half), sl.at(bit + half) ? "1" : "0"});
  }
  return row;
}

void add_ticks(const DecodedFrame& frame, const Axis& axis, Diagram& diagram) {
  constexpr double kApart = 2;  // cells
  const auto add = [&](sim::Time t) {
    diagram.ticks.push_back({axis(frame.trace.begin + t), fmt::format("{:.4g}", sim::to_us(t))});
  };
  // Every fifth period, as time since the first falling edge.
  const sim::Time step = 5 * frame.trace.period();
  const sim::Time end = frame.trace.end - frame.trace.begin;
  for (sim::Time t = 0; t <= end; t += step) {
    if (axis.shown(frame.trace.begin + t)) add(t);
  }
  // After a cut the end has its own number, because no other number may stand there.
  if (!axis.cuts().empty()) {
    while (axis(frame.trace.end) - diagram.ticks.back().at < kApart) diagram.ticks.pop_back();
    add(end);
  }
  diagram.axis = "t / us";
}

}  // namespace

Diagram frame_diagram(const LineRecording& recording, const DecodedFrame& frame,
                      const sim::ChannelConfig& channel, const std::string& title) {
  std::vector<const Wave*> waves{&recording.ma(), &recording.sl()};
  if (clocked(*channel.cable).mo) waves.push_back(&recording.mo());
  const Axis axis(frame, waves);
  Diagram diagram;
  diagram.title = title;
  diagram.notes.push_back(
      fmt::format("{}, f_MA {:.4g} MHz, {} rising edges, SL {:.4g} ns behind MA, {:.4g} us{}",
                  channel.protocol().title, 1e6 / static_cast<double>(frame.trace.period()),
                  frame.trace.rising.size(), sim::to_ns(frame.delay),
                  sim::to_us(frame.trace.end - frame.trace.begin),
                  !frame.complete ? std::string("; no answer")
                  : frame.good    ? std::string()
                                  : "; " + frame.mistakes));
  diagram.rows.push_back(edge_numbers(frame, axis));
  diagram.rows.push_back(wave_row("MA", recording.ma(), frame, axis));
  if (!frame.ma.empty()) diagram.rows.push_back(field_row(frame.ma, axis));
  if (clocked(*channel.cable).mo)
    diagram.rows.push_back(wave_row("MO", recording.mo(), frame, axis));
  diagram.rows.push_back(wave_row("SL", recording.sl(), frame, axis));
  diagram.rows.push_back(bit_row(recording.sl(), frame, axis));
  diagram.rows.push_back(field_row(frame.sl, axis));
  add_ticks(frame, axis, diagram);
  diagram.length = axis.length();
  diagram.cuts = axis.cuts();
  return diagram;
}

}  // namespace mb4::tool
