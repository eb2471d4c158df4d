// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/hint_lines.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "report/messages.hpp"

namespace mb4::tool {

void HintLines::print(const std::vector<sim::Hint>& hints) {
  for (const sim::Hint& hint : hints) {
    if (std::find(printed_.begin(), printed_.end(), hint.text) != printed_.end()) continue;
    printed_.push_back(hint.text);
    if (json_) {
      fmt::print(stderr, "{{\"hint\": {}, \"place\": {}, \"text\": {}}}\n", json_text(hint.kind),
                 json_text(hint.place), json_text(hint.text));
    } else {
      fmt::print(stderr, "mb4sim: hint ({}): {}\n", hint.kind, hint.text);
    }
  }
}

std::vector<sim::Hint> hints_of_run(sim::Simulator& simulator, std::uint64_t missed) {
  std::vector<sim::Hint> hints = simulator.hints(missed);
  if (missed == 0) std::erase_if(hints, [](const sim::Hint& hint) { return hint.place != "host"; });
  return hints;
}

}  // namespace mb4::tool
