// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <sys/signalfd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "bridge/bridge_server.hpp"
#include "bridge/file_descriptor.hpp"
#include "commands/commands.hpp"
#include "masters/mb4/chip_setup.hpp"
#include "mb4sim/model_stopped.hpp"
#include "mb4sim/simulator.hpp"
#include "report/exit_status.hpp"
#include "report/trace_file.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

// A descriptor that becomes readable when a signal asks the process to end.
FileDescriptor make_stop_signals() {
  sigset_t set;
  ::sigemptyset(&set);
  ::sigaddset(&set, SIGINT);
  ::sigaddset(&set, SIGTERM);
  ::sigprocmask(SIG_BLOCK, &set, nullptr);
  FileDescriptor fd(::signalfd(-1, &set, SFD_CLOEXEC));
  if (!fd) throw UseError(fmt::format("cannot wait for signals: {}", std::strerror(errno)));
  return fd;
}

}  // namespace

int bridge_command(const BridgeOptions& options) {
  if (options.unix_path.empty() == options.tcp.empty()) {
    throw UseError("bridge needs either --unix or --tcp");
  }
  const sim::Scenario scenario = load_chip_scenario(options.scenario);
  const TraceFile trace(options.trace, options.scenario, scenario);
  sim::SimulatorOptions sim_options;
  sim_options.seed = options.seed;
  sim_options.trace_path = trace.path();
  std::optional<std::string> stopped;
  {
    sim::Simulator simulator(scenario, sim_options);
    BridgeServer server(simulator, options.wall ? Pace::kWall : Pace::kRequests);
    const FileDescriptor stop = make_stop_signals();
    const std::string where = options.tcp.empty() ? server.listen_unix(options.unix_path)
                                                  : server.listen_tcp(options.tcp);
    fmt::print("listening on {}\n", where);
    if (std::fflush(stdout) != 0) throw UseError("cannot write to standard output");
    server.serve(stop.get(), options.once);
    stopped = server.stopped();
  }
  trace.write_view();
  if (stopped) throw sim::ModelStopped(*stopped);
  return kGood;
}

}  // namespace mb4::tool
