// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/messages.hpp"

#include <fmt/core.h>

#include <cstdio>

#include "sim/core/one_line.hpp"

namespace mb4::tool {

void print_error(bool json, std::string_view text, int status) {
  const std::string line = sim::one_line(text);
  if (json) {
    fmt::print(stderr, "{{\"error\": {}, \"status\": {}}}\n", json_text(line), status);
  } else {
    fmt::print(stderr, "mb4sim: {}\n", line);
  }
}

void print_note(bool json, std::string_view text) {
  const std::string line = sim::one_line(text);
  if (json) {
    fmt::print(stderr, "{{\"note\": {}}}\n", json_text(line));
  } else {
    fmt::print(stderr, "mb4sim: {}\n", line);
  }
}

}  // namespace mb4::tool
