// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What to write instead of a wrong line of a TOML file.
#ifndef MB4SIM_TOML_ADVICE_HPP_
#define MB4SIM_TOML_ADVICE_HPP_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mb4::sim {

// A number as a scenario has it: 10_000_000.
std::string toml_number(double value);

// The key of `known` that is `key` in another unit (at_ms: at_us), and `value` in its unit. Empty
// if there is none.
struct InUnit {
  std::string key;
  double value = 0;
};
std::optional<InUnit> other_unit(std::string_view key, double value,
                                 const std::vector<std::string>& known);

// "cable_m = 10" for the key cable_m and the text "10 m"; also from another unit. Empty if the text
// is no such number.
std::string number_line(std::string_view key, std::string_view text);

// The mistake in a line that is no TOML: its key, its section, and the right line.
struct LineAdvice {
  std::string key;
  std::string section;  // "[host]"; empty: none
  std::string line;     // empty: nothing is known
};
// `number`: the line of `text` at which reading ended, from 1 on.
LineAdvice advice_on_line(std::string_view text, unsigned number);

}  // namespace mb4::sim

#endif  // MB4SIM_TOML_ADVICE_HPP_
