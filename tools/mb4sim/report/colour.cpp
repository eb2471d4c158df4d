// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/colour.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace mb4::tool {
namespace {

constexpr const char* kGreen = "\033[32m";
constexpr const char* kRed = "\033[31m";
constexpr const char* kPlain = "\033[0m";

std::string_view variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

bool has_colours() {
  static const bool has =
      ::isatty(STDOUT_FILENO) != 0 && variable("NO_COLOR").empty() && variable("TERM") != "dumb";
  return has;
}

std::string coloured(std::string row, bool good) {
  if (!has_colours()) return row;
  const bool line = row.ends_with('\n');
  if (line) row.pop_back();
  return (good ? kGreen : kRed) + row + kPlain + (line ? "\n" : "");
}

}  // namespace mb4::tool
