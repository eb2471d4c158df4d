// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "number_list.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

#include "report/exit_status.hpp"
#include "sim/core/one_line.hpp"

namespace mb4::tool {
namespace {

[[noreturn]] void fail(const std::string& text, const NumberRule& rule, const std::string& why) {
  throw UseError(fmt::format("{}: '{}': {}", rule.option, sim::one_line(text), why));
}

long long number(std::string_view part, const std::string& text, const NumberRule& rule) {
  double value = 0;
  const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  const double thousandths = std::round(value * 1000);
  const bool good = error == std::errc() && stop == part.data() + part.size() &&
                    value >= rule.minimum && value <= rule.maximum &&
                    std::abs(value * 1000 - thousandths) < 1e-3 &&
                    (!rule.whole || value == std::floor(value));
  if (!good) {
    fail(text, rule,
         fmt::format("expected {} of {} to {}, a list A,B,C or a range FROM:TO:STEP",
                     rule.whole ? "a whole number" : "a number", rule.minimum, rule.maximum));
  }
  return std::llround(thousandths);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::vector<long long> number_list(const std::string& text, const NumberRule& rule) {
  std::vector<long long> values;
  const auto range = split(text, ':');
  if (range.size() == 1) {
    for (const std::string_view part : split(text, ',')) {
      values.push_back(number(part, text, rule));
    }
  } else {
    if (range.size() != 3) fail(text, rule, "a range has three parts, FROM:TO:STEP");
    const long long from = number(range[0], text, rule);
    const long long to = number(range[1], text, rule);
    const long long step = number(range[2], text, rule);
    if (step <= 0) fail(text, rule, "the step must be above 0");
    if (from > to) fail(text, rule, "the range ends before it begins");
    if ((to - from) / step >= static_cast<long long>(kMaxListed)) {
      fail(text, rule, fmt::format("more than {} values", kMaxListed));
    }
    for (long long value = from; value <= to; value += step) values.push_back(value);
  }
  if (values.size() > kMaxListed) fail(text, rule, fmt::format("more than {} values", kMaxListed));
  return values;
}

}  // namespace mb4::tool
