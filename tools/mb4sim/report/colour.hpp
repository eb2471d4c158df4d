// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Colour of good and bad rows, on a terminal only. NO_COLOR and TERM=dumb turn it off.
#ifndef MB4SIM_TOOL_COLOUR_HPP_
#define MB4SIM_TOOL_COLOUR_HPP_

#include <string>

namespace mb4::tool {

// Whether standard output takes colours.
bool has_colours();

// The row in green or red where there are colours; a newline at its end stays outside.
std::string coloured(std::string row, bool good);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_COLOUR_HPP_
