// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/vcd_writer.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace mb4::tool {

std::string lines_vcd(const std::map<unsigned, std::unique_ptr<LinePicture>>& lines,
                      sim::Time end) {
  struct Change {
    sim::Time time;
    char code;
    bool level;
  };
  std::string out = "$timescale 1 ps $end\n$scope module line $end\n";
  std::string values;
  std::vector<Change> changes;
  char code = '!';
  for (const auto& [channel, line] : lines) {
    for (const auto& [name, wave] : line->signals()) {
      out += fmt::format("$var wire 1 {} {}{} $end\n", code, name, channel);
      values += fmt::format("{}{}\n", wave->idle ? 1 : 0, code);
      for (const Edge& edge : wave->edges) changes.push_back({edge.time, code, edge.level});
      ++code;
    }
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.time < b.time; });
  out += "$upscope $end\n$enddefinitions $end\n#0\n" + values;
  sim::Time last = 0;
  for (const Change& change : changes) {
    if (change.time != last) out += fmt::format("#{}\n", change.time);
    last = change.time;
    out += fmt::format("{}{}\n", change.level ? 1 : 0, change.code);
  }
  return out + fmt::format("#{}\n", std::max(end, last));
}

}  // namespace mb4::tool
