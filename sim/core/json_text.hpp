// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Text inside JSON.
#ifndef MB4SIM_JSON_TEXT_HPP_
#define MB4SIM_JSON_TEXT_HPP_

#include <string>
#include <string_view>

namespace mb4::sim {

// A string as JSON, quotes included. Bytes that are no UTF-8 become U+FFFD.
std::string json_text(std::string_view text);

}  // namespace mb4::sim

#endif  // MB4SIM_JSON_TEXT_HPP_
