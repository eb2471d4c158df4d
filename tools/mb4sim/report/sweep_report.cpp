// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/sweep_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "report/colour.hpp"
#include "sim/core/json_text.hpp"

namespace mb4::tool {
namespace {

constexpr int kFirstColumn = 11;

std::string cell(const SweepPoint& point) {
  if (point.bad() == 0) return ".";
  return fmt::format("{}{}", point.bad(), point.wrong != 0 ? "!" : "");
}

std::string skew_text(long long skew) {
  if (skew == 0) return "no skew";
  return fmt::format("{} edges {} % later", skew > 0 ? "falling" : "rising",
                     thousandths(std::abs(skew)));
}

std::string plane_text(const Sweep& sweep, const SweepPlane& plane) {
  std::size_t width = 5;
  for (const auto& row : plane.points) {
    for (const SweepPoint& point : row) width = std::max(width, cell(point).size() + 1);
  }
  for (const long long jitter : sweep.jitters_mpercent) {
    width = std::max(width, thousandths(jitter).size() + 2);
  }
  std::string out = fmt::format("\n{}; bad words by delay and jitter\n{:>{}}",
                                plane_title(sweep, plane), "delay/ns", kFirstColumn);
  for (const long long jitter : sweep.jitters_mpercent) {
    out += fmt::format("{:>{}}", thousandths(jitter) + "%", width);
  }
  out += '\n';
  for (std::size_t d = 0; d < sweep.delays_ps.size(); ++d) {
    out += fmt::format("{:>{}}", thousandths(sweep.delays_ps[d]), kFirstColumn);
    for (const SweepPoint& point : plane.points[d]) {
      out += coloured(fmt::format("{:>{}}", cell(point), width), point.bad() == 0);
    }
    out += '\n';
  }
  return out;
}

}  // namespace

std::string thousandths(long long value) {
  std::string text = fmt::format("{}{}.{:03}", value < 0 ? "-" : "", std::abs(value) / 1000,
                                 std::abs(value) % 1000);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string plane_title(const Sweep& sweep, const SweepPlane& plane) {
  if (!plane.title.empty()) return plane.title;
  return fmt::format("{} 0x{:02X}: MA {} kHz, T_MA {} ns{}", sweep.code_name, plane.code,
                     thousandths(static_cast<long long>(plane.ma_hz)),
                     thousandths(std::llround(1e12 / static_cast<double>(plane.ma_hz))),
                     plane.skew_mpercent ? ", " + skew_text(*plane.skew_mpercent) : "");
}

std::string frames_text(const Sweep& sweep) {
  return fmt::format("{} frame{} at each point", sweep.frames, sweep.frames == 1 ? "" : "s");
}

bool Sweep::within_allowed() const {
  for (const SweepPlane& plane : planes) {
    for (const auto& row : plane.points) {
      for (std::size_t j = 0; j < row.size(); ++j) {
        if (jitters_mpercent[j] <= plane.allowed_mpercent && row[j].bad() != 0) return false;
      }
    }
  }
  return true;
}

bool Sweep::any_allowed() const {
  const long long least = *std::min_element(jitters_mpercent.begin(), jitters_mpercent.end());
  return std::any_of(planes.begin(), planes.end(),
                     [&](const SweepPlane& plane) { return least <= plane.allowed_mpercent; });
}

std::string Sweep::allowed_text() const {
  std::vector<long long> limits;
  for (const SweepPlane& plane : planes) limits.push_back(plane.allowed_mpercent);
  limits.erase(std::unique(limits.begin(), limits.end()), limits.end());
  std::string text;
  for (const long long limit : limits) text += (text.empty() ? "" : ", ") + thousandths(limit);
  return text + " %";
}

std::string sweep_text(const Sweep& sweep) {
  std::string out = fmt::format("{}: {}, jitter peak to peak in % of {}\n", sweep.scenario,
                                frames_text(sweep), sweep.period);
  SweepPoint sum;
  for (const SweepPlane& plane : sweep.planes) {
    out += plane_text(sweep, plane);
    for (const auto& row : plane.points) {
      for (const SweepPoint& point : row) {
        sum.words += point.words;
        sum.flagged += point.flagged;
        sum.wrong += point.wrong;
      }
    }
  }
  out += fmt::format(
      "\n. = all good, ! = wrong words delivered as good (CRC aliases) among them\n"
      "words {}, flagged {}, wrong but delivered {}; jitter up to {}{}: {}; seed {}\n",
      sum.words, sum.flagged, sum.wrong, sweep.allowed_text(),
      sweep.jitter_item.empty() ? "" : fmt::format(" ({})", sweep.jitter_item),
      !sweep.any_allowed()     ? "not tried"
      : sweep.within_allowed() ? "all good"
                               : "BAD",
      sweep.seed);
  return out;
}

std::string sweep_json(const Sweep& sweep) {
  std::string out = fmt::format(
      "{{\"scenario\": {}, \"seed\": {}, \"frames\": {}, \"code_name\": {}, \"period\": {}, "
      "\"good\": {}, \"planes\": [",
      sim::json_text(sweep.scenario), sweep.seed, sweep.frames, sim::json_text(sweep.code_name),
      sim::json_text(sweep.period), sweep.within_allowed());
  for (const SweepPlane& plane : sweep.planes) {
    out +=
        fmt::format("{}\n  {{\"code\": {}, \"ma_hz\": {}{}, \"allowed_percent\": {}, \"points\": [",
                    &plane == &sweep.planes.front() ? "" : ",", plane.code, plane.ma_hz,
                    plane.skew_mpercent
                        ? fmt::format(", \"skew_percent\": {}", thousandths(*plane.skew_mpercent))
                        : "",
                    thousandths(plane.allowed_mpercent));
    for (std::size_t d = 0; d < sweep.delays_ps.size(); ++d) {
      for (std::size_t j = 0; j < sweep.jitters_mpercent.size(); ++j) {
        const SweepPoint& point = plane.points[d][j];
        out += fmt::format(
            "{}\n    {{\"delay_ns\": {}, \"jitter_percent\": {}, \"words\": {}, \"flagged\": {}, "
            "\"wrong\": {}}}",
            d + j == 0 ? "" : ",", thousandths(sweep.delays_ps[d]),
            thousandths(sweep.jitters_mpercent[j]), point.words, point.flagged, point.wrong);
      }
    }
    out += "\n  ]}";
  }
  return out + "\n]}\n";
}

std::string sweep_csv(const Sweep& sweep) {
  const bool skews = sweep.planes.front().skew_mpercent.has_value();
  std::string out = sweep.code_name + (skews ? ",ma_hz,skew_percent" : ",ma_hz") +
                    ",delay_ns,jitter_percent,words,flagged,wrong\n";
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const SweepPlane& plane : sweep.planes) {
    for (std::size_t d = 0; d < sweep.delays_ps.size(); ++d) {
      for (std::size_t j = 0; j < sweep.jitters_mpercent.size(); ++j) {
        const SweepPoint& point = plane.points[d][j];
        out += fmt::format("{},{},{}{},{},{},{},{}\n", plane.code, plane.ma_hz,
                           skews ? thousandths(*plane.skew_mpercent) + "," : "",
                           thousandths(sweep.delays_ps[d]), thousandths(sweep.jitters_mpercent[j]),
                           point.words, point.flagged, point.wrong);
      }
    }
  }
  return out;
}

}  // namespace mb4::tool
