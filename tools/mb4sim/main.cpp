// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// mb4sim: the openmb4 simulator on the command line. Data goes to standard output, messages to
// standard error.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "command_line.hpp"
#include "interrupts.hpp"
#include "mb4sim/model_stopped.hpp"
#include "report/exit_status.hpp"
#include "report/messages.hpp"

namespace mb4::tool {
namespace {

// True if the command line has --json, also if it has mistakes. Words after "--" belong to a
// program.
bool wants_json(int argc, char** argv) {
  char** const end = std::find(argv, argv + argc, std::string_view("--"));
  return std::find(argv, end, std::string_view("--json")) != end;
}

int run(int argc, char** argv, bool json) {
  Action action;
  const auto app = make_command_line(action);
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app->exit(error);  // --help, --version
    print_error(json, mistake(*app, error), kWrongUse);
    return kWrongUse;
  }
  return action();
}

// Ends the process by the signal, as a shell expects it of an interrupted program.
void die_by(int signal) {
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace
}  // namespace mb4::tool

int main(int argc, char** argv) {
  using namespace mb4::tool;
  const bool json = wants_json(argc, argv);
  int status = kWrongUse;
  int signal = 0;
  try {
    status = run(argc, argv, json);
  } catch (const mb4::sim::ModelStopped& error) {
    status = kModelStopped;
    print_error(json, std::string("the model stopped: ") + error.what(), status);
  } catch (const Interrupted& error) {
    signal = error.signal();
    status = kSignalled + signal;
    print_error(json, error.what(), status);
  } catch (const std::exception& error) {
    print_error(json, error.what(), status);
  }
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (!written && (status == kGood || status == kBad)) {
    status = kWrongUse;
    print_error(json, "cannot write to standard output", status);
  }
  if (signal != 0) die_by(signal);
  return status;
}
