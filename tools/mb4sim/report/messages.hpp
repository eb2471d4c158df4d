// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages on standard error: lines "mb4sim: ...", or with --json one JSON object on each line.
#ifndef MB4SIM_TOOL_MESSAGES_HPP_
#define MB4SIM_TOOL_MESSAGES_HPP_

#include <string>
#include <string_view>

namespace mb4::tool {

// A string as JSON, quotes included. Bytes that are no UTF-8 become U+FFFD.
std::string json_text(std::string_view text);

// {"error": "...", "status": N} with --json.
void print_error(bool json, std::string_view text, int status);
// {"note": "..."} with --json.
void print_note(bool json, std::string_view text);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_MESSAGES_HPP_
