// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Pieces of SVG text.
#ifndef MB4SIM_TOOL_SVG_HPP_
#define MB4SIM_TOOL_SVG_HPP_

#include <string>
#include <string_view>
#include <vector>

namespace mb4::tool::svg {

// `text` as XML; control characters become '?'.
std::string escaped(std::string_view text);
// `style`: a class of the style sheet.
std::string text(double x, double y, std::string_view style, std::string_view content);

// Estimated width in pixels of a text in a wide sans-serif font.
double text_width(std::string_view content, double font_size);
// The first of `labels` that fits into `width`; empty if none does.
std::string fitting(const std::vector<std::string>& labels, double width, double font_size);

// `content` on as many lines as it needs, cut at blanks, or inside of words longer than a line.
std::vector<std::string> wrapped(std::string_view content, double width, double font_size);

}  // namespace mb4::tool::svg

#endif  // MB4SIM_TOOL_SVG_HPP_
