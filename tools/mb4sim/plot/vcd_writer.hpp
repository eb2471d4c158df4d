// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Recorded lines as a VCD file, as logic analysers and sigrok read it.
#ifndef MB4SIM_TOOL_VCD_WRITER_HPP_
#define MB4SIM_TOOL_VCD_WRITER_HPP_

#include <memory>
#include <string>
#include <vector>

#include "plot/line_recording.hpp"

namespace mb4::tool {

// Signals MA, MO and SL of each line that is there (by channel, from 1), up to `end`.
std::string lines_vcd(const std::vector<std::unique_ptr<LineRecording>>& lines, sim::Time end);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_VCD_WRITER_HPP_
