// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// mb4sim: the openmb4 simulator on the command line. Data goes to standard output, messages to
// standard error.
#include <fmt/core.h>

#include <cstdio>
#include <exception>

#include "command_line.hpp"
#include "exit_status.hpp"
#include "mb4sim/model_stopped.hpp"
#include "mb4sim/one_line.hpp"

namespace {

int run(int argc, char** argv) {
  mb4::tool::Action action;
  const auto app = mb4::tool::make_command_line(action);
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app->exit(error);  // --help, --version
    fmt::print(stderr, "mb4sim: {} (see mb4sim --help)\n", mb4::sim::one_line(error.what()));
    return mb4::tool::kWrongUse;
  }
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  int status = mb4::tool::kWrongUse;
  try {
    status = run(argc, argv);
  } catch (const mb4::sim::ModelStopped& error) {
    fmt::print(stderr, "mb4sim: the model stopped: {}\n", error.what());
    status = mb4::tool::kModelStopped;
  } catch (const std::exception& error) {
    fmt::print(stderr, "mb4sim: {}\n", mb4::sim::one_line(error.what()));
  }
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (!written && (status == mb4::tool::kGood || status == mb4::tool::kBad)) {
    fmt::print(stderr, "mb4sim: cannot write to standard output\n");
    status = mb4::tool::kWrongUse;
  }
  return status;
}
