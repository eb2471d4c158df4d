// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/suggestion.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace mb4::sim {
namespace {

constexpr std::size_t kFar = 1000;
constexpr std::size_t kShortestBeginning = 3;
constexpr std::size_t kSameBeginning = 2;  // letters that may differ behind it

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

// How far `word` is from `one`, or kFar.
std::size_t far_from(std::string_view word, std::string_view one) {
  const bool long_enough = word.size() >= kShortestBeginning;
  if (one.starts_with(word) && one.substr(word.size()).starts_with('_')) return 0;
  if (long_enough && one.starts_with(word)) return 0;
  const std::size_t far = distance(word, one);
  if (far <= std::max<std::size_t>(1, word.size() / 3)) return far;
  const std::string_view beginning = word.substr(0, kShortestBeginning);
  if (long_enough && far <= kSameBeginning && one.starts_with(beginning)) return far;
  const bool part = one.size() >= kShortestBeginning && word.find(one) != std::string_view::npos;
  return part ? kFar - one.size() : kFar;
}

// Capitals are no mistake that counts.
std::string lower(std::string_view word) {
  std::string small(word);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  std::pair<std::size_t, std::size_t> best{kFar, 0};  // how far, how long
  std::string found;
  for (const std::string& one : known) {
    const std::pair rank{far_from(lower(word), lower(one)), one.size()};
    if (rank >= best) continue;
    best = rank;
    found = one;
  }
  return found;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  const std::string meant = nearest(word, known);
  return meant.empty() ? "" : ", did you mean '" + meant + "'?";
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string meant = nearest(word, known);
  return meant.empty() ? "" : "; did you mean \"" + meant + "\"?";
}

}  // namespace mb4::sim
