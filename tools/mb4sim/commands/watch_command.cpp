// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <string>

#include "commands/commands.hpp"
#include "interrupts.hpp"
#include "report/colour.hpp"
#include "report/exit_status.hpp"
#include "report/frame_report.hpp"
#include "report/messages.hpp"
#include "scenario_argument.hpp"
#include "session.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

// Keys come one by one and are not shown, as long as this object exists.
class Keys {
 public:
  Keys() {
    ::tcgetattr(STDIN_FILENO, &before_);
    termios now = before_;
    now.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    ::tcsetattr(STDIN_FILENO, TCSANOW, &now);
  }
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;
  ~Keys() { ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_); }

  // Waits; returns whether a key was pressed. A signal ends the wait.
  bool pressed(int milliseconds) const {
    pollfd keyboard{STDIN_FILENO, POLLIN, 0};
    return ::poll(&keyboard, 1, milliseconds) > 0;
  }

 private:
  termios before_{};
};

void require_terminal() {
  if (::isatty(STDIN_FILENO) == 0 || ::isatty(STDOUT_FILENO) == 0) {
    throw UseError("watch needs a terminal; 'mb4sim run' prints the same rows into a file");
  }
}

}  // namespace

int watch_command(const WatchOptions& options) {
  const sim::Scenario scenario = open_scenario(options.scenario);
  const MasterSupport& support = support_of(scenario);
  support.check(scenario);
  require_terminal();
  SessionOptions session_options;
  session_options.simulator.seed = options.seed;
  const std::unique_ptr<Session> session = support.open(scenario, session_options);
  if (const std::string why = session->configure(); !why.empty()) {
    print_error(false, fmt::format("{}: {}", support.not_begun, why), kBad);
    return kBad;
  }
  FrameReport report(session->simulator().scenario(), session->columns());
  fmt::print("{}", report.table_header());
  const Interrupts interrupts;
  {
    const Keys keys;
    for (std::uint64_t number = 1;; ++number) {
      const SessionFrame frame = session->read(number);
      if (number > 1) fmt::print("\033[{}A", session->slaves().size() + 1);
      for (std::size_t i = 0; i < session->slaves().size(); ++i) {
        const bool good = report.add(frame, session->slaves()[i].number, i).good();
        fmt::print("\r\033[K{}", coloured(report.table_row(), good));
      }
      fmt::print("\r\033[Kgood {}, bad {}; a key ends it\n", report.good(), report.bad());
      std::fflush(stdout);
      if (keys.pressed(static_cast<int>(options.milliseconds))) break;
      interrupts.check();
    }
  }
  return report.bad() == 0 ? kGood : kBad;
}

}  // namespace mb4::tool
