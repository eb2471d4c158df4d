// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/core/one_line.hpp"

namespace mb4::sim {

std::string one_line(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  constexpr unsigned kC1Lead = 0xC2;  // first UTF-8 byte of U+0080 to U+00BF
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = static_cast<unsigned char>(text[i]);
    if (code == kC1Lead && i + 1 < text.size()) {
      const unsigned next = static_cast<unsigned char>(text[i + 1]);
      if (next >= 0x80 && next < 0xA0) {
        code = next;
        ++i;
      }
    } else if (code >= 0x20 && code != 0x7F) {
      out += text[i];
      continue;
    }
    switch (code) {
      case kC1Lead:
        out += text[i];
        break;
      case '\n':
        out += "\\n";
        break;
      case '\r':
        out += "\\r";
        break;
      case '\t':
        out += "\\t";
        break;
      default:
        out += "\\x";
        out += kDigits[code >> 4U];
        out += kDigits[code & 0xFU];
        break;
    }
  }
  return out;
}

}  // namespace mb4::sim
