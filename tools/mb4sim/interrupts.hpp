// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// SIGINT, SIGTERM and SIGHUP for commands that end in good order: their output is complete, and the
// processes that they have started end too.
#ifndef MB4SIM_TOOL_INTERRUPTS_HPP_
#define MB4SIM_TOOL_INTERRUPTS_HPP_

#include <signal.h>

#include <array>
#include <stdexcept>

namespace mb4::tool {

// A signal asks the command to end. main() then ends the process by that signal.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(int signal);
  int signal() const { return signal_; }

 private:
  int signal_;
};

// While this object exists, it stores these signals, each once. The same signal again ends the
// process in the usual way. Signals that were ignored before stay ignored. Only one object may
// exist at a time.
class Interrupts {
 public:
  static constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};

  Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
  ~Interrupts() { restore(); }

  // The signal that came first; 0 if none did.
  int signal() const;
  void check() const {
    if (const int number = signal(); number != 0) throw Interrupted(number);
  }
  // Restores the earlier handlers; also for use in a child process.
  void restore() const;

 private:
  std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_INTERRUPTS_HPP_
