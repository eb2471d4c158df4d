// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture of a control frame. Each cell is a frame on the line, which carries one bit.
#ifndef MB4SIM_TOOL_CONTROL_DIAGRAM_HPP_
#define MB4SIM_TOOL_CONTROL_DIAGRAM_HPP_

#include <string>
#include <vector>

#include "plot/control_decode.hpp"
#include "plot/timing_svg.hpp"

namespace mb4::tool {

Diagram control_diagram(const std::vector<ControlBits>& bits, const ControlFrame& frame,
                        const std::string& title);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_CONTROL_DIAGRAM_HPP_
