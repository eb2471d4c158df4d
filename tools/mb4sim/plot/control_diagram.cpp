// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "plot/control_diagram.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace mb4::tool {
namespace {

constexpr std::size_t kCellsBefore = 4;  // cells before S: the last zeros
constexpr std::size_t kCellsBehind = 1;

DiagramRow row(DiagramRow::Type type, std::string name = "") {
  DiagramRow result;
  result.type = type;
  result.name = std::move(name);
  return result;
}

DiagramRow field_row(const std::vector<SlotField>& fields, bool zeros) {
  DiagramRow result = row(DiagramRow::Type::kFields);
  if (zeros) {
    result.fields.push_back(
        {{0, static_cast<double>(kCellsBefore)}, FieldKind::kRest, {"14 or more times 0"}, false});
  }
  for (const SlotField& field : fields) {
    result.fields.push_back({{static_cast<double>(field.from + kCellsBefore),
                              static_cast<double>(field.to + kCellsBefore)},
                             field.kind,
                             field.labels,
                             field.bad});
  }
  return result;
}

}  // namespace

Diagram control_diagram(const std::vector<ControlBits>& bits, const ControlFrame& frame,
                        const std::string& title) {
  Diagram diagram;
  diagram.title = title;
  diagram.notes.push_back(frame.text + (frame.good ? "" : " (not good)") +
                          (frame.mistakes.empty() ? "" : "; " + frame.mistakes));
  diagram.notes.emplace_back(
      "One cell for each frame. CDM: level of MA behind the frame, inverted.");
  diagram.notes.emplace_back(
      "CDS: the bit behind the start bit; it answers the CDM of the frame before.");
  DiagramRow cdm = row(DiagramRow::Type::kWave, "CDM");
  DiagramRow cds = row(DiagramRow::Type::kWave, "CDS");
  DiagramRow cdm_bits = row(DiagramRow::Type::kDigits);
  DiagramRow cds_bits = row(DiagramRow::Type::kDigits);
  cdm.idle = cds.idle = false;
  const std::size_t cells = kCellsBefore + frame.slots + kCellsBehind;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::size_t index = frame.start + cell - kCellsBefore;
    if (index >= bits.size()) break;
    const auto at = static_cast<double>(cell);
    const ControlBits& bit = bits[index];
    cdm.levels.push_back({at, bit.cdm});
    cds.levels.push_back({at, bit.cds});
    cdm_bits.digits.push_back({at + 0.5, bit.cdm ? "1" : "0"});
    cds_bits.digits.push_back({at + 0.5, bit.cds ? "1" : "0"});
    const long slot = static_cast<long>(cell) - static_cast<long>(kCellsBefore);
    diagram.ticks.push_back({at + 0.5, fmt::format("{}", slot)});
    diagram.length = at + 1;
  }
  diagram.axis = "slot";
  diagram.rows = {cdm, cdm_bits, field_row(frame.cdm, true),
                  cds, cds_bits, field_row(frame.cds, false)};
  return diagram;
}

}  // namespace mb4::tool
