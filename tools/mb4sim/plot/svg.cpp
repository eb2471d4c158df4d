// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/svg.hpp"

#include <fmt/core.h>

namespace mb4::tool::svg {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      default:
        // Control characters are not allowed in XML.
        out += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  }
  return out;
}

std::string text(double x, double y, std::string_view style, std::string_view content) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x, y, style,
                     escaped(content));
}

double text_width(std::string_view content, double font_size) {
  // DejaVu Sans, in thousandths of the font size: narrow letters, wide ones, the rest.
  constexpr std::string_view kNarrow = "fijlrtI.,:;()|' ";
  constexpr std::string_view kWide = "mwMWOQGD=<>+";
  double width = 0;
  for (const char c : content) {
    width += kNarrow.find(c) != std::string_view::npos ? 0.37
             : kWide.find(c) != std::string_view::npos ? 0.88
                                                       : 0.64;
  }
  return width * font_size;
}

std::string fitting(const std::vector<std::string>& labels, double width, double font_size) {
  constexpr double kMargin = 2;
  for (const std::string& label : labels) {
    if (text_width(label, font_size) + kMargin <= width) return label;
  }
  return "";
}

std::vector<std::string> wrapped(std::string_view content, double width, double font_size) {
  std::vector<std::string> lines;
  while (text_width(content, font_size) > width) {
    std::size_t end = 1;
    std::size_t blank = 0;
    while (text_width(content.substr(0, end + 1), font_size) <= width) {
      if (content[end] == ' ') blank = end;
      ++end;
    }
    // Not inside of a character of UTF-8.
    while (end > 1 && (static_cast<unsigned char>(content[end]) & 0xC0U) == 0x80) --end;
    if (content[end] == ' ') blank = end;
    lines.emplace_back(content.substr(0, blank != 0 ? blank : end));
    content.remove_prefix(blank != 0 ? blank + 1 : end);
  }
  lines.emplace_back(content);
  return lines;
}

}  // namespace mb4::tool::svg
