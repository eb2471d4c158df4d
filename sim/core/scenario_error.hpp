// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Places in a scenario file, and the error that names one.
#ifndef MB4SIM_SCENARIO_ERROR_HPP_
#define MB4SIM_SCENARIO_ERROR_HPP_

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "sim/core/one_line.hpp"

namespace mb4::sim {

// A place in the scenario file. Line and column count from 1; 0 = unknown.
struct SourcePos {
  unsigned line = 0;
  unsigned column = 0;
  std::string table{};  // "[host]" or "[[channel]]"; empty: the file itself
};

// The place of a table in the scenario, and of the values of its keys.
struct TableSource {
  SourcePos table;
  std::map<std::string, SourcePos, std::less<>> keys;

  // Returns the place of the value if the key is there, else that of the table.
  SourcePos of(std::string_view key) const;
};

// A mistake in a scenario or in a file that it names. what() is one complete line:
// "file:line:column: key 'x': message (in [table])". Line, column and table are missing where there
// is none. Control characters are escaped (one_line.hpp).
class ScenarioError : public std::runtime_error {
 public:
  explicit ScenarioError(const std::string& message) : std::runtime_error(one_line(message)) {}
  ScenarioError(const std::string& file, const SourcePos& where, std::string_view key,
                const std::string& message);
};

// The message for something that this build has not. `option` brings it, given to CMake.
std::string left_out(std::string_view name, std::string_view option);

}  // namespace mb4::sim

#endif  // MB4SIM_SCENARIO_ERROR_HPP_
