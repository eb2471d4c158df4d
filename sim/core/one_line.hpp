// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes text from files and users safe to print inside a message.
#ifndef MB4SIM_ONE_LINE_HPP_
#define MB4SIM_ONE_LINE_HPP_

#include <string>
#include <string_view>

namespace mb4::sim {

// Returns `text` (UTF-8) with its control characters escaped: \n, \r, \t, else \x and two hex
// digits.
std::string one_line(std::string_view text);

}  // namespace mb4::sim

#endif  // MB4SIM_ONE_LINE_HPP_
