// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "suggestion.hpp"

#include <algorithm>
#include <utility>

namespace mb4::tool {
namespace {

constexpr std::size_t kFar = 1000;
constexpr std::size_t kShortestBeginning = 3;

// Letters to add, leave out or change, or neighbours to swap.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before;  // the row above the last one
  std::vector<std::size_t> last(b.size() + 1);
  for (std::size_t k = 0; k <= b.size(); ++k) last[k] = k;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1, i);
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const bool same = a[i - 1] == b[k - 1];
      row[k] = std::min({last[k] + 1, row[k - 1] + 1, last[k - 1] + (same ? 0 : 1)});
      if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1]) {
        row[k] = std::min(row[k], before[k - 2] + 1);
      }
    }
    before = std::exchange(last, std::move(row));
  }
  return last.back();
}

}  // namespace

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  std::pair<std::size_t, std::size_t> best{kFar, 0};  // how far, how long
  const std::string* nearest = nullptr;
  for (const std::string& one : known) {
    const bool begins = word.size() >= kShortestBeginning && one.starts_with(word);
    const std::size_t far = begins ? 0 : distance(word, one);
    if (far > std::max<std::size_t>(1, word.size() / 3)) continue;
    if (const std::pair rank{far, one.size()}; rank < best) {
      best = rank;
      nearest = &one;
    }
  }
  return nearest == nullptr ? "" : ", did you mean '" + *nearest + "'?";
}

}  // namespace mb4::tool
