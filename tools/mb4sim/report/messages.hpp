// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages on standard error: lines "mb4sim: ...", or with --json one JSON object on each line.
#ifndef MB4SIM_TOOL_MESSAGES_HPP_
#define MB4SIM_TOOL_MESSAGES_HPP_

#include <string_view>

#include "sim/core/json_text.hpp"

namespace mb4::tool {

using sim::json_text;

// {"error": "...", "status": N} with --json.
void print_error(bool json, std::string_view text, int status);
// {"note": "..."} with --json.
void print_note(bool json, std::string_view text);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_MESSAGES_HPP_
