// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/number_text.hpp"

#ifdef __EMSCRIPTEN__
#include <fast_float/fast_float.h>
#endif

#include <charconv>
#include <cstdio>
#include <sstream>

namespace mb4::sim {

std::optional<std::uint64_t> parse_word(std::string_view text) {
  int base = 10;
  if (text.starts_with("0x") || text.starts_with("0X")) {
    base = 16;
    text.remove_prefix(2);
  }
  std::string digits;
  for (const char c : text) {
    if (c != '_') digits += c;
  }
  std::uint64_t value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value, base);
  if (digits.empty() || error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::optional<double> parse_real(std::string_view text) {
#ifdef __EMSCRIPTEN__  // std::from_chars of its library takes whole numbers only
  using fast_float::from_chars;
#else
  using std::from_chars;
#endif
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::string hex_word(std::uint64_t value) {
  char text[20];
  std::snprintf(text, sizeof(text), "0x%llX", static_cast<unsigned long long>(value));
  return text;
}

std::string plain(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string ns_text(Time time) {
  char text[40];
  std::snprintf(text, sizeof(text), "%llu.%03llu", static_cast<unsigned long long>(time / kPsPerNs),
                static_cast<unsigned long long>(time % kPsPerNs));
  return text;
}

}  // namespace mb4::sim
