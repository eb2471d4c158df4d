// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Suggests the right word for a mistyped one.
#ifndef MB4SIM_TOOL_SUGGESTION_HPP_
#define MB4SIM_TOOL_SUGGESTION_HPP_

#include <string>
#include <string_view>
#include <vector>

namespace mb4::tool {

// ", did you mean 'run'?": the shortest of `known` that begins with `word` (three letters or more),
// else the one that the fewest letters added, left out, changed or swapped make of it. Empty if
// nothing is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_SUGGESTION_HPP_
