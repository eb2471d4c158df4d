// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A timing diagram as WaveJSON, which WaveDrom and its editor draw.
#ifndef MB4SIM_TOOL_WAVE_JSON_HPP_
#define MB4SIM_TOOL_WAVE_JSON_HPP_

#include <string>

#include "plot/timing_svg.hpp"

namespace mb4::tool {

// Levels and boxes are on a grid of one, two or four ticks a cell: as few as place each change. A
// change between the ticks goes to the nearest one. Rows of small digits are left out. A cut of the
// axis is a gap.
std::string wave_json(const Diagram& diagram);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_WAVE_JSON_HPP_
