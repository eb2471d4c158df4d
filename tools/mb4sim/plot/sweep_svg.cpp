// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "plot/svg.hpp"
#include "report/sweep_report.hpp"

namespace mb4::tool {
namespace {

constexpr double kPlotWidth = 640;
constexpr double kPlotHeight = 220;
constexpr double kLeft = 80;
constexpr double kTop = 78;       // of the first panel: title and legend above it
constexpr double kPanelGap = 92;  // axis and heading of the next panel
constexpr double kRight = 40;
constexpr double kBottom = 64;
constexpr long long kMaxLabels = 10;

using svg::text;

std::string box(double x, double y, double width, double height, const std::string& fill) {
  return fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x, y,
      width, height, fill);
}

// Green: no bad word. Pale yellow to red: share of bad words, on a square root scale, so that few
// bad words differ from none. Violet: a wrong word was delivered.
std::string colour(const SweepPoint& point) {
  if (point.wrong != 0) return "#6a1b9a";
  if (point.bad() == 0) return "#4caf50";
  const double share =
      std::sqrt(static_cast<double>(point.bad()) / static_cast<double>(point.words));
  const auto mix = [&](double from, double to) {
    return static_cast<int>(std::lround(from + (to - from) * share));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(255, 183), mix(241, 28), mix(118, 28));
}

// Borders of the cells: half way between two values, and as far beyond the first and last.
std::vector<double> borders(const std::vector<long long>& values) {
  std::vector<double> result;
  const std::size_t n = values.size();
  const auto at = [&](std::size_t i) { return static_cast<double>(values[i]); };
  if (n == 1) return {at(0) - 0.5, at(0) + 0.5};
  result.push_back(at(0) - (at(1) - at(0)) / 2);
  for (std::size_t i = 1; i < n; ++i) result.push_back((at(i - 1) + at(i)) / 2);
  result.push_back(at(n - 1) + (at(n - 1) - at(n - 2)) / 2);
  return result;
}

struct Axis {
  double low;   // value at `from`
  double high;  // value at `to`
  double from;
  double to;
  double operator()(double value) const {
    return from + (to - from) * (value - low) / (high - low);
  }
};

// Round values for the labels of an axis: multiples of 1, 2 or 5 times a power of ten.
std::vector<long long> ticks(const std::vector<long long>& values) {
  long long step = 1;
  for (unsigned i = 0; (values.back() - values.front()) / step >= kMaxLabels; ++i) {
    step = i % 3 == 1 ? step / 2 * 5 : step * 2;
  }
  std::vector<long long> result;
  for (long long value = (values.front() + step - 1) / step * step; value <= values.back();
       value += step) {
    result.push_back(value);
  }
  return result;
}

// The places in `values`, by ascending values. A repeated value has one place.
std::vector<std::size_t> order_of(const std::vector<long long>& values) {
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  order.erase(std::unique(order.begin(), order.end(),
                          [&](std::size_t a, std::size_t b) { return values[a] == values[b]; }),
              order.end());
  return order;
}

std::vector<long long> picked(const std::vector<long long>& values,
                              const std::vector<std::size_t>& order) {
  std::vector<long long> result;
  for (const std::size_t i : order) result.push_back(values[i]);
  return result;
}

std::string panel(const Sweep& sweep, const SweepPlane& plane, double top) {
  const auto delay_order = order_of(sweep.delays_ps);
  const auto jitter_order = order_of(sweep.jitters_mpercent);
  const auto delays = picked(sweep.delays_ps, delay_order);
  const auto jitters = picked(sweep.jitters_mpercent, jitter_order);
  const auto columns = borders(delays);
  const auto rows = borders(jitters);
  const Axis x{columns.front(), columns.back(), kLeft, kLeft + kPlotWidth};
  const Axis y{rows.front(), rows.back(), top + kPlotHeight, top};
  std::string out = text(kLeft, top - 8, "head", plane_title(sweep, plane));
  for (std::size_t d = 0; d < delays.size(); ++d) {
    for (std::size_t j = 0; j < jitters.size(); ++j) {
      out +=
          box(x(columns[d]), y(rows[j + 1]), x(columns[d + 1]) - x(columns[d]),
              y(rows[j]) - y(rows[j + 1]), colour(plane.points[delay_order[d]][jitter_order[j]]));
    }
  }
  out += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#333\"/>\n", kLeft,
      top, kPlotWidth, kPlotHeight);
  const auto allowed = static_cast<double>(plane.allowed_mpercent);
  if (allowed >= rows.front() && allowed <= rows.back()) {
    out += fmt::format(
        "<line x1=\"{}\" y1=\"{:.2f}\" x2=\"{}\" y2=\"{:.2f}\" stroke=\"#000\" "
        "stroke-dasharray=\"6 4\"/>\n",
        kLeft, y(allowed), kLeft + kPlotWidth, y(allowed));
    out += text(
        kLeft + kPlotWidth + 4, y(allowed) + 4, "small",
        sweep.jitter_item.empty() ? thousandths(plane.allowed_mpercent) + " %" : sweep.jitter_item);
  }
  for (const long long delay : ticks(delays)) {
    out += text(x(static_cast<double>(delay)), top + kPlotHeight + 16, "mid", thousandths(delay));
  }
  for (const long long jitter : ticks(jitters)) {
    out += text(kLeft - 6, y(static_cast<double>(jitter)) + 4, "end", thousandths(jitter));
  }
  out += text(kLeft + kPlotWidth / 2, top + kPlotHeight + 36, "mid", "round-trip delay / ns");
  out += fmt::format(
      "<text class=\"mid\" transform=\"translate({:.1f},{:.1f}) rotate(-90)\">jitter peak to peak "
      "/ % of {}</text>\n",
      kLeft - 60, top + kPlotHeight / 2, svg::escaped(sweep.period));
  return out;
}

// The title has room for a file's name, not for its folder.
std::string file_name(const std::string& path) {
  constexpr std::size_t kLongest = 40;
  const std::string name = path.substr(path.find_last_of('/') + 1);
  if (name.size() <= kLongest) return name;
  std::size_t from = name.size() - kLongest;
  while ((static_cast<unsigned char>(name[from]) & 0xC0U) == 0x80) ++from;  // inside a character
  return "..." + name.substr(from);
}

std::string legend() {
  struct Entry {
    SweepPoint point;
    const char* name;
  };
  const Entry entries[] = {{{100, 0, 0}, "all words good"},
                           {{100, 1, 0}, "1 % bad, flagged"},
                           {{100, 25, 0}, "25 %"},
                           {{100, 100, 0}, "100 %"},
                           {{100, 0, 1}, "wrong word delivered"}};
  constexpr double kStep[] = {0, 132, 274, 336, 406};
  std::string out;
  for (std::size_t i = 0; i < std::size(entries); ++i) {
    const double x = kLeft + kStep[i];
    out += box(x, 36, 12, 12, colour(entries[i].point));
    out += text(x + 17, 46, "small", entries[i].name);
  }
  return out;
}

}  // namespace

std::string sweep_svg(const Sweep& sweep) {
  const auto panels = static_cast<double>(sweep.planes.size());
  const double width = kLeft + kPlotWidth + kRight;
  const double height = kTop + panels * kPlotHeight + (panels - 1) * kPanelGap + kBottom;
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\">\n"
      "<style>text {{ font: 12px sans-serif; fill: #222 }} .title {{ font-size: 15px; font-weight: "
      "bold }} .head {{ font-weight: bold }} .mid {{ text-anchor: middle }} .end {{ text-anchor: "
      "end }} .small {{ font-size: 11px }} rect {{ shape-rendering: "
      "crispEdges }}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height);
  out += text(kLeft, 24, "title",
              fmt::format("Eye margin: {}, {}, seed {}", file_name(sweep.scenario),
                          frames_text(sweep), sweep.seed));
  out += legend();
  double top = kTop;
  for (const SweepPlane& plane : sweep.planes) {
    out += panel(sweep, plane, top);
    top += kPlotHeight + kPanelGap;
  }
  return out + "</svg>\n";
}

}  // namespace mb4::tool
