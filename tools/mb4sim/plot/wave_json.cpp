// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/wave_json.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "sim/core/json_text.hpp"

namespace mb4::tool {
namespace {

constexpr unsigned kMostTicks = 4;  // of a cell

std::vector<double> changes_of(const Diagram& diagram) {
  std::vector<double> places;
  for (const DiagramRow& row : diagram.rows) {
    for (const DiagramRow::Level& level : row.levels) places.push_back(level.at);
    for (const DiagramField& field : row.fields) {
      places.insert(places.end(), {field.span.from, field.span.to});
    }
  }
  return places;
}

unsigned ticks_of(const Diagram& diagram) {
  const std::vector<double> places = changes_of(diagram);
  unsigned ticks = 1;
  const auto is_whole = [&](double place) {
    return std::abs(place * ticks - std::round(place * ticks)) < 0.01;
  };
  while (ticks < kMostTicks && !std::all_of(places.begin(), places.end(), is_whole)) ticks *= 2;
  return ticks;
}

// Boxes of WaveDrom have colours by number; 9 is red.
char box_of(const DiagramField& field) {
  if (field.bad) return '9';
  switch (field.kind) {
    case FieldKind::kData:
      return '5';
    case FieldKind::kFlag:
      return '4';
    case FieldKind::kCrc:
      return '7';
    case FieldKind::kControl:
      return '3';
    default:
      return '2';
  }
}

class Grid {
 public:
  Grid(const Diagram& diagram, unsigned ticks)
      : ticks_(ticks), length_(index(diagram.length)), cuts_(diagram.cuts) {}

  // One signal: a character for each tick, '.' as the one before.
  std::string signal(const DiagramRow& row) const {
    std::string wave(length_, '.');
    std::string data;
    if (row.type == DiagramRow::Type::kWave) {
      levels(row, wave);
    } else {
      fields(row, wave, data);
    }
    for (const double cut : cuts_) {
      const std::size_t at = index(cut);
      if (at < length_ && wave[at] == '.') wave[at] = '|';
    }
    return fmt::format("{{\"name\": {}, \"wave\": \"{}\"{}}}", sim::json_text(row.name), wave,
                       data.empty() ? "" : fmt::format(", \"data\": [{}]", data));
  }

 private:
  std::size_t index(double place) const {
    return static_cast<std::size_t>(std::max(0L, std::lround(place * ticks_)));
  }

  void levels(const DiagramRow& row, std::string& wave) const {
    std::string states(length_, row.idle ? '1' : '0');
    for (const DiagramRow::Level& level : row.levels) {
      const std::size_t from = std::min(index(level.at), length_);
      std::fill(states.begin() + static_cast<std::ptrdiff_t>(from), states.end(),
                level.level ? '1' : '0');
    }
    for (std::size_t i = 0; i < length_; ++i) {
      if (i == 0 || states[i] != states[i - 1]) wave[i] = states[i];
    }
  }

  // Between the boxes the row is blank, as far as WaveDrom has that: high impedance.
  void fields(const DiagramRow& row, std::string& wave, std::string& data) const {
    std::size_t free = 0;  // the first tick without a box
    if (length_ != 0) wave[0] = 'z';
    for (const DiagramField& field : row.fields) {
      const std::size_t from = std::max(index(field.span.from), free);
      const std::size_t to = std::min(std::max(index(field.span.to), from + 1), length_);
      if (from >= length_) break;
      if (from > free && free != 0) wave[free] = 'z';
      wave[from] = box_of(field);
      data += (data.empty() ? "" : ", ") +
              sim::json_text(field.labels.empty() ? "" : field.labels.front());
      free = to;
    }
    if (free != 0 && free < length_) wave[free] = 'z';
  }

  unsigned ticks_;
  std::size_t length_;
  const std::vector<double>& cuts_;
};

}  // namespace

std::string wave_json(const Diagram& diagram) {
  const unsigned ticks = ticks_of(diagram);
  const Grid grid(diagram, ticks);
  std::string signals;
  for (const DiagramRow& row : diagram.rows) {
    if (row.type == DiagramRow::Type::kDigits) continue;
    signals += (signals.empty() ? "" : ",\n    ") + grid.signal(row);
  }
  std::string notes;
  for (const std::string& note : diagram.notes) notes += (notes.empty() ? "" : "; ") + note;
  notes += fmt::format("{}{} tick(s) a cell", notes.empty() ? "" : "; ", ticks);
  return fmt::format(
      "{{\n  \"signal\": [\n    {}\n  ],\n  \"head\": {{\"text\": {}}},\n  \"foot\": {{\"text\": "
      "{}}}\n}}\n",
      signals, sim::json_text(diagram.title), sim::json_text(notes));
}

}  // namespace mb4::tool
