// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Hints on standard error, each once.
#ifndef MB4SIM_TOOL_HINT_LINES_HPP_
#define MB4SIM_TOOL_HINT_LINES_HPP_

#include <string>
#include <vector>

#include "mb4sim/simulator.hpp"

namespace mb4::tool {

class HintLines {
 public:
  // Lines "mb4sim: hint (length): slave 1 sends ...", or with `json` one object on each line.
  explicit HintLines(bool json) : json_(json) {}

  // Prints those that have not been printed.
  void print(const std::vector<sim::Hint>& hints);

 private:
  bool json_;
  std::vector<std::string> printed_;
};

// The hints after a run that has missed words of these slaves, bit n for slave n + 1. Without any
// the words were as the host wanted them, and only what it has done at its pins is told.
std::vector<sim::Hint> hints_of_run(sim::Simulator& simulator, std::uint64_t missed);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_HINT_LINES_HPP_
