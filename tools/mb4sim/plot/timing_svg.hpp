// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A timing diagram on as many lines as it needs: signals with their levels, and rows of fields,
// over a common axis counted in cells (periods of MA, or frames). Stretches in which nothing
// happens are cut.
#ifndef MB4SIM_TOOL_TIMING_SVG_HPP_
#define MB4SIM_TOOL_TIMING_SVG_HPP_

#include <string>
#include <vector>

#include "plot/field.hpp"

namespace mb4::tool {

// Position on the axis, in cells.
struct CellSpan {
  double from;
  double to;
};

struct DiagramField {
  CellSpan span;
  FieldKind kind;
  std::vector<std::string> labels;
  bool bad = false;
};

struct DiagramRow {
  enum class Type {
    kWave,    // a level
    kDigits,  // small texts at places
    kFields,  // boxes
  };
  struct Level {
    double at;
    bool level;
  };
  struct Digit {
    double at;  // middle
    std::string text;
  };

  Type type = Type::kWave;
  std::string name;  // at the left; empty: none
  bool idle = true;  // kWave
  std::vector<Level> levels;
  std::vector<Digit> digits;
  std::vector<DiagramField> fields;
};

struct Diagram {
  std::string title;
  std::vector<std::string> notes;  // lines below it
  std::vector<DiagramRow> rows;
  std::vector<DiagramRow::Digit> ticks;  // of the axis
  std::string axis;                      // its unit
  double length = 0;                     // cells
  std::vector<double> cuts;              // where the axis is not true to scale
};

std::string timing_svg(const Diagram& diagram);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_TIMING_SVG_HPP_
