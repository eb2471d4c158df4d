// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Recorded lines as a VCD file, as logic analysers and sigrok read it.
#ifndef MB4SIM_TOOL_VCD_WRITER_HPP_
#define MB4SIM_TOOL_VCD_WRITER_HPP_

#include <map>
#include <memory>
#include <string>

#include "plot/pictures.hpp"

namespace mb4::tool {

// The signals of each line by its channel, up to `end`.
std::string lines_vcd(const std::map<unsigned, std::unique_ptr<LinePicture>>& lines, sim::Time end);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_VCD_WRITER_HPP_
