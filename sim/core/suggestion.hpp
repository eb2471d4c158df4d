// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Suggests the right word for a mistyped one.
#ifndef MB4SIM_SUGGESTION_HPP_
#define MB4SIM_SUGGESTION_HPP_

#include <string>
#include <string_view>
#include <vector>

namespace mb4::sim {

// The word of `known` that was meant by `word`: the shortest that begins with `word` (three letters
// or more, or all up to a _), else the one that the fewest letters added, left out, changed or
// swapped make of it, else one that is a part of it (my_word: word). Empty if nothing is near.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

// ", did you mean 'run'?", or empty.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);
// For a value of a scenario, behind a list: "; did you mean "ramp"?", or empty.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace mb4::sim

#endif  // MB4SIM_SUGGESTION_HPP_
