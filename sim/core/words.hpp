// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#ifndef MB4SIM_CORE_WORDS_HPP_
#define MB4SIM_CORE_WORDS_HPP_

#include <algorithm>
#include <string_view>
#include <vector>

namespace mb4::sim {

// What stands between the blanks of a line. Views into `line`.
inline std::vector<std::string_view> split_at_blanks(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view kBlank = " \t\r";
  for (auto at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlank, end);
  }
  return words;
}

}  // namespace mb4::sim

#endif  // MB4SIM_CORE_WORDS_HPP_
