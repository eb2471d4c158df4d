// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The section that an error in a scenario names.
#ifndef MB4TEST_SCENARIO_PLACE_HPP_
#define MB4TEST_SCENARIO_PLACE_HPP_

#include <algorithm>
#include <cstdlib>
#include <string>

namespace mb4test {

// `message` ("s.toml:3:1: ...") with " (in [host])" behind it: the last header of `text` up to this
// line. Nothing is added for the name in a header, which the file itself holds, nor if the message
// has a section already.
inline std::string with_section(const std::string& text, const std::string& message) {
  if (message.find(" (in ") != std::string::npos) return message;
  const std::size_t at = message.find(':') + 1;
  const auto line = std::strtoul(message.c_str() + at, nullptr, 10);
  const auto column = std::strtoul(message.c_str() + message.find(':', at) + 1, nullptr, 10);
  std::string section;
  std::size_t begin = 0;
  for (unsigned long number = 1; number <= line && begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string one = text.substr(begin, end - begin);
    begin = end + 1;
    if (one.empty() || one[0] != '[') continue;
    section = number == line && column > 1 ? "" : one.substr(0, one.rfind(']') + 1);
  }
  return section.empty() ? message : message + " (in " + section + ")";
}

}  // namespace mb4test

#endif  // MB4TEST_SCENARIO_PLACE_HPP_
