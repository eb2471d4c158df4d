// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture of one frame.
#ifndef MB4SIM_TOOL_FRAME_DIAGRAM_HPP_
#define MB4SIM_TOOL_FRAME_DIAGRAM_HPP_

#include <string>

#include "plot/frame_decode.hpp"
#include "plot/line_recording.hpp"
#include "plot/timing_svg.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

Diagram frame_diagram(const LineRecording& recording, const DecodedFrame& frame,
                      const sim::ChannelConfig& channel, const std::string& title);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_FRAME_DIAGRAM_HPP_
