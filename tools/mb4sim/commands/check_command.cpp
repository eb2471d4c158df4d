// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <string>

#include "commands/commands.hpp"
#include "report/exit_status.hpp"
#include "report/messages.hpp"
#include "scenario_argument.hpp"
#include "session.hpp"
#include "sim/core/one_line.hpp"
#include "sim/core/scenario_error.hpp"

namespace mb4::tool {

int check_command(const CheckOptions& options) {
  int status = kGood;
  for (const std::string& path : options.scenarios) {
    try {
      const sim::Scenario scenario = open_scenario(path);
      support_of(scenario).check(scenario);
      fmt::print("{}: ok\n", sim::one_line(path));
    } catch (const sim::ScenarioError& error) {
      status = kWrongUse;
      print_error(false, error.what(), status);
    }
  }
  return status;
}

}  // namespace mb4::tool
