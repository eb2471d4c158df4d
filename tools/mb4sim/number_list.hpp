// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Lists of numbers on the command line: "25", "0,10,25" or "0:100:10" (from, to, step).
#ifndef MB4SIM_TOOL_NUMBER_LIST_HPP_
#define MB4SIM_TOOL_NUMBER_LIST_HPP_

#include <cstddef>
#include <string>
#include <vector>

namespace mb4::tool {

struct NumberRule {
  const char* option;  // for messages
  double minimum;
  double maximum;
  bool whole = false;
};

// Longest list.
inline constexpr std::size_t kMaxListed = 2000;

// The values of `text` in their order, in thousandths: at most three decimals. Throws UseError.
std::vector<long long> number_list(const std::string& text, const NumberRule& rule);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_NUMBER_LIST_HPP_
