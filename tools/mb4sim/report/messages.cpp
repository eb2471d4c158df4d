// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/messages.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "sim/core/one_line.hpp"

namespace mb4::tool {
namespace {

// Bytes of the UTF-8 character at the front of `text`; 0 if there is none.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80                    ? 1
                             : lead >= 0xC2 && lead <= 0xDF ? 2
                             : lead >= 0xE0 && lead <= 0xEF ? 3
                             : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                            : 0;
  if (length > text.size()) return 0;
  const bool good = std::all_of(text.begin() + 1, text.begin() + std::max<std::size_t>(length, 1),
                                [](char c) { return (c & 0xC0) == 0x80; });
  return good ? length : 0;
}

}  // namespace

std::string json_text(std::string_view text) {
  std::string out(1, '"');
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) {
      out += "\\ufffd";
    } else if (text[0] == '"' || text[0] == '\\') {
      out += '\\';
      out += text[0];
    } else if (static_cast<unsigned char>(text[0]) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(text[0]));
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  out += '"';
  return out;
}

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
