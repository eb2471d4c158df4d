// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Values of register fields in words: the name of a code, a frequency.
#ifndef MB4SIM_TOOL_REGISTER_TEXT_HPP_
#define MB4SIM_TOOL_REGISTER_TEXT_HPP_

#include <string>

#include "session.hpp"

namespace mb4::tool {

// "BiSS_C"; "0x00 (10 MHz)" where codes follow a rule; "0x1F" where any value may stand.
std::string value_text(const RegisterMap& map, const RegisterMap::Field& field);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_REGISTER_TEXT_HPP_
