// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/timing_svg.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "plot/svg.hpp"

namespace mb4::tool {
namespace {

constexpr double kLeft = 64;
constexpr double kRight = 24;
constexpr double kCell = 28;
constexpr double kMaxCells = 46;  // on one line
constexpr double kTop = 16;
constexpr double kTitle = 24;
constexpr double kNote = 16;
constexpr double kWave = 26;
constexpr double kDigits = 14;
constexpr double kFields = 20;
constexpr double kRowGap = 5;
constexpr double kAxis = 30;
constexpr double kLineGap = 20;
constexpr double kFont = 10;
constexpr double kSmall = 9;
constexpr double kNoteFont = 12;
constexpr double kTitleFont = 16;  // 15, bold

const char* fill(FieldKind kind) {
  switch (kind) {
    case FieldKind::kFraming:
      return "#ececec";
    case FieldKind::kControl:
      return "#f9dfc4";
    case FieldKind::kData:
      return "#d6e6f5";
    case FieldKind::kFlag:
      return "#fbf3c4";
    case FieldKind::kCrc:
      return "#daefd2";
    case FieldKind::kRest:
      break;
  }
  return "#ffffff";
}

double height_of(const DiagramRow& row) {
  switch (row.type) {
    case DiagramRow::Type::kWave:
      return kWave;
    case DiagramRow::Type::kDigits:
      return kDigits;
    case DiagramRow::Type::kFields:
      break;
  }
  return kFields;
}

// One of the lines of a diagram.
class Line {
 public:
  Line(double from, double to, double top) : from_(from), to_(to), top_(top) {}

  double x(double cell) const { return kLeft + (cell - from_) * kCell; }
  double right() const { return x(to_); }

  std::string draw(const Diagram& diagram) const {
    std::string out;
    double y = top_;
    for (const DiagramRow& row : diagram.rows) {
      if (!row.name.empty()) {
        out += svg::text(kLeft - 8, y + height_of(row) / 2 + 4, "name", row.name);
      }
      switch (row.type) {
        case DiagramRow::Type::kWave:
          out += wave(row, y) + cuts(diagram, y - 1, kWave + 2);
          break;
        case DiagramRow::Type::kDigits:
          out += digits(row.digits, y + kDigits - 4);
          break;
        case DiagramRow::Type::kFields:
          out += fields(row, y);
          break;
      }
      y += height_of(row) + kRowGap;
    }
    return out + axis(diagram, y) + cuts(diagram, y - 4, 8);
  }

 private:
  bool holds(double cell) const { return cell >= from_ && cell < to_; }

  std::string wave(const DiagramRow& row, double y) const {
    const auto height = [&](bool level) { return level ? y + 3 : y + kWave - 3; };
    bool level = row.idle;
    std::string path;
    for (const DiagramRow::Level& edge : row.levels) {
      if (edge.at >= to_) break;
      if (edge.at > from_) {
        if (path.empty()) path = fmt::format("M{:.1f} {:.1f}", x(from_), height(level));
        path += fmt::format("H{:.1f}V{:.1f}", x(edge.at), height(edge.level));
      }
      level = edge.level;
    }
    if (path.empty()) path = fmt::format("M{:.1f} {:.1f}", x(from_), height(level));
    return fmt::format("<path d=\"{}H{:.1f}\" class=\"wave\"/>\n", path, right());
  }

  std::string digits(const std::vector<DiagramRow::Digit>& digits, double y) const {
    std::string out;
    for (const DiagramRow::Digit& digit : digits) {
      if (holds(digit.at)) out += svg::text(x(digit.at), y, "digit", digit.text);
    }
    return out;
  }

  std::string fields(const DiagramRow& row, double y) const {
    std::string out;
    for (const DiagramField& field : row.fields) {
      const double from = std::max(field.span.from, from_);
      const double to = std::min(field.span.to, to_);
      if (to - from < 0.05) continue;
      out += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" fill=\"{}\"{}/>\n",
          x(from), y, (to - from) * kCell, kFields, field.bad ? "#f6b9b4" : fill(field.kind),
          field.kind == FieldKind::kRest ? " stroke-dasharray=\"3 2\"" : "");
      // A field that spans several lines has its label in its longest piece.
      const double whole = field.span.to - field.span.from;
      if (to - from < whole / 2 && !is_longest(field, to - from)) continue;
      const double width = (to - from) * kCell;
      const std::string label = svg::fitting(field.labels, width, kFont);
      const std::string small = label.empty() ? svg::fitting(field.labels, width + 2, kSmall) : "";
      out += svg::text(x((from + to) / 2), y + kFields / 2 + 3.5, label.empty() ? "tight" : "field",
                       label.empty() ? small : label);
    }
    return out;
  }

  bool is_longest(const DiagramField& field, double here) const {
    const double before = std::min(from_ - field.span.from, to_ - from_);
    const double behind = std::min(field.span.to - to_, to_ - from_);
    return here > before && here >= behind;
  }

  std::string axis(const Diagram& diagram, double y) const {
    std::string out =
        fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" class=\"axis\"/>\n", x(from_), y, right());
    for (const DiagramRow::Digit& tick : diagram.ticks) {
      if (!holds(tick.at)) continue;
      out += fmt::format("<path d=\"M{:.1f} {:.1f}v4\" class=\"axis\"/>\n", x(tick.at), y);
      out += svg::text(x(tick.at), y + 15, "digit", tick.text);
    }
    // The unit stands beside the axis, because the first number may stand at its very beginning.
    out += svg::text(kLeft - 8, y + 3, "unit", diagram.axis);
    return out;
  }

  // Draws the cuts over the lines that begin at `top`.
  std::string cuts(const Diagram& diagram, double top, double height) const {
    std::string out;
    for (const double cut : diagram.cuts) {
      if (!holds(cut)) continue;
      out += fmt::format(
          "<rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"5\" height=\"{2:.1f}\" class=\"cut\"/>\n"
          "<path d=\"M{0:.1f} {1:.1f}v{2:.1f}m5 0v-{2:.1f}\" class=\"cutline\"/>\n",
          x(cut) - 2.5, top, height);
    }
    return out;
  }

  double from_;
  double to_;
  double top_;
};

constexpr const char* kStyle =
    "text{font:10px sans-serif;fill:#111}.title{font-size:15px;font-weight:bold}"
    ".note{font-size:12px}.name{font-size:12px;font-weight:bold;text-anchor:end}"
    ".digit{font-size:9px;text-anchor:middle}.unit{font-size:9px;text-anchor:end}"
    ".field{text-anchor:middle}.tight{font-size:9px;text-anchor:middle}"
    "rect{stroke:#555;stroke-width:.7}.wave{fill:none;stroke:#111;stroke-width:1.4}"
    ".axis{fill:none;stroke:#777;stroke-width:.8}.cut{fill:#fff;stroke:none}"
    ".cutline{fill:none;stroke:#777;stroke-width:.8;stroke-dasharray:2 2}";

}  // namespace

std::string timing_svg(const Diagram& diagram) {
  const auto lines = static_cast<unsigned>(std::ceil(std::max(diagram.length / kMaxCells, 1.0)));
  // Whole cells on every line, about as many on each.
  const double cells = std::ceil(diagram.length / lines);
  double line_height = kAxis;
  for (const DiagramRow& row : diagram.rows) line_height += height_of(row) + kRowGap;
  const double width = kLeft + cells * kCell + kRight;
  const double room = width - kLeft - 4;
  const std::vector<std::string> titles = svg::wrapped(diagram.title, room, kTitleFont);
  std::vector<std::string> notes;
  for (const std::string& note : diagram.notes) {
    for (std::string& line : svg::wrapped(note, room, kNoteFont)) notes.push_back(std::move(line));
  }
  const double head = kTop + kTitle * static_cast<double>(titles.size()) +
                      kNote * static_cast<double>(notes.size()) + 8;
  const double height = head + lines * line_height + (lines - 1) * kLineGap;
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- SPDX-FileCopyrightText: 2026 The openmb4 authors\n"
      "     SPDX-License-Identifier: Apache-2.0 -->\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n<style>{2}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\" style=\"stroke:none\"/>\n",
      width, height, kStyle);
  double y = kTop;
  for (const std::string& title : titles) {
    out += svg::text(kLeft, y + 8, "title", title);
    y += kTitle;
  }
  for (const std::string& note : notes) {
    out += svg::text(kLeft, y + 6, "note", note);
    y += kNote;
  }
  for (unsigned i = 0; i < lines; ++i) {
    const double from = i * cells;
    const Line line(from, std::min(from + cells, diagram.length),
                    head + i * (line_height + kLineGap));
    out += line.draw(diagram);
  }
  return out + "</svg>\n";
}

}  // namespace mb4::tool
