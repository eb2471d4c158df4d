// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "bridge/bridge_server.hpp"
#include "bridge/file_descriptor.hpp"
#include "commands/commands.hpp"
#include "masters/mb4/chip_setup.hpp"
#include "mb4sim/simulator.hpp"
#include "report/exit_status.hpp"
#include "report/trace_file.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

namespace fs = std::filesystem;

constexpr int kNotFound = 127;       // as in shells: there is no such program
constexpr int kNotExecutable = 126;  // as in shells: the program cannot be started

// One encoder of 26 bits on 10 m of cable: examples/resolute-26.toml.
constexpr const char* kDefaultScenario = R"(
[host]
sclk_hz = 5_000_000
ma_hz = 10_000_000
[[channel]]
number = 1
cable_m = 10.0
[[channel.slave]]
protocol = "biss-c"
preset = "resolute-26"
data = 0x2ABCDEF
)";

// The folder with the socket and with the file that stands for the device.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "mb4sim-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw UseError(fmt::format("{}: cannot create: {}", name, std::strerror(errno)));
    }
    path_ = name;
    if (!std::ofstream(token())) {
      throw UseError(fmt::format("{}: cannot create: {}", token(), std::strerror(errno)));
    }
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  const std::string& path() const { return path_; }
  std::string socket() const { return path_ + "/socket"; }
  std::string token() const { return path_ + "/device"; }

 private:
  std::string path_;
};

// The library lies in the build tree or the installation beside the program.
std::string library_path(const std::string& option) {
  std::vector<fs::path> places;
  if (!option.empty()) {
    places.emplace_back(option);
  } else {
    const fs::path bin = fs::read_symlink("/proc/self/exe").parent_path();
    places.push_back(bin / MB4SIM_LIB_FROM_BIN / "libmb4sim_spidev.so");
    places.push_back(bin / "../lib/libmb4sim_spidev.so");
  }
  for (const fs::path& place : places) {
    std::error_code error;
    if (fs::is_regular_file(place, error)) return fs::canonical(place).string();
  }
  throw UseError(fmt::format("{}: the preload library is not there", places.front().string()));
}

// The loader splits the list of libraries at blanks and colons. A path with such a character is
// replaced by a link.
std::string loadable(const std::string& library, const Folder& folder) {
  if (library.find_first_of(" :") == std::string::npos) return library;
  const fs::path link = fs::path(folder.path()) / fs::path("libmb4sim_spidev.so");
  std::error_code error;
  fs::create_symlink(library, link, error);
  if (error) throw UseError(fmt::format("{}: cannot create: {}", link.string(), error.message()));
  return link.string();
}

void set_environment(const SpidevOptions& options, const Folder& folder,
                     const std::string& library) {
  const char* const before = std::getenv("LD_PRELOAD");
  const bool others = before != nullptr && *before != '\0';
  const std::string preload = library + (others ? std::string(":") + before : "");
  ::setenv("LD_PRELOAD", preload.c_str(), 1);
  ::setenv("MB4SIM_SPIDEV_DIR", folder.path().c_str(), 1);
  ::setenv("MB4SIM_SPIDEV_DEVICE", options.device.c_str(), 1);
  ::setenv("MB4SIM_SPIDEV_TIME", options.simulated_time ? "simulated" : "wall", 1);
}

[[noreturn]] void become(const SpidevOptions& options, const Folder& folder,
                         const std::string& library) {
  set_environment(options, folder, library);
  std::vector<char*> arguments;
  for (const std::string& word : options.program) {
    arguments.push_back(const_cast<char*>(word.c_str()));
  }
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  const int error = errno;
  fmt::print(stderr, "mb4sim: {}: cannot start: {}\n", options.program[0], std::strerror(error));
  ::_exit(error == ENOENT ? kNotFound : kNotExecutable);
}

int status_of(pid_t program) {
  int status = 0;
  while (::waitpid(program, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFSIGNALED(status) ? kSignalled + WTERMSIG(status) : WEXITSTATUS(status);
}

volatile std::sig_atomic_t g_program = 0;  // process that receives the signals

void pass_on(int signal) {
  if (g_program > 0) ::kill(static_cast<pid_t>(g_program), signal);
}

// Signals for the program. SIGINT and SIGQUIT of the terminal reach it directly; this process
// ignores them. It passes on SIGTERM and SIGHUP. So this process lives as long as the program.
class ProgramSignals {
 public:
  // SIGTERM and SIGHUP wait until the program is known.
  ProgramSignals() {
    sigset_t passed;
    ::sigemptyset(&passed);
    ::sigaddset(&passed, SIGTERM);
    ::sigaddset(&passed, SIGHUP);
    ::sigprocmask(SIG_BLOCK, &passed, &mask_);
    for (std::size_t i = 0; i < kCount; ++i) {
      before_[i] = std::signal(kSignals[i].number, kSignals[i].handler);
    }
  }
  ProgramSignals(const ProgramSignals&) = delete;
  ProgramSignals& operator=(const ProgramSignals&) = delete;
  ~ProgramSignals() {
    restore();
    g_program = 0;
  }

  void pass_to(pid_t program) const {
    g_program = program;
    ::sigprocmask(SIG_SETMASK, &mask_, nullptr);
  }
  // Restores the earlier handlers and mask.
  void restore() const {
    for (std::size_t i = 0; i < kCount; ++i) std::signal(kSignals[i].number, before_[i]);
    ::sigprocmask(SIG_SETMASK, &mask_, nullptr);
  }

 private:
  struct Handled {
    int number;
    void (*handler)(int);
  };
  static constexpr std::size_t kCount = 4;
  static inline const std::array<Handled, kCount> kSignals{
      {{SIGINT, SIG_IGN}, {SIGQUIT, SIG_IGN}, {SIGTERM, &pass_on}, {SIGHUP, &pass_on}}};

  sigset_t mask_{};
  std::array<void (*)(int), kCount> before_{};
};

void report(const sim::HostCheck& check, const Folder& folder) {
  if (check.count() != 0) {
    fmt::print(stderr, "host timing: {} violation(s), first: {}\n", check.count(),
               check.violations().front().text);
  }
  std::error_code error;
  if (fs::file_size(folder.token(), error) != 0 && !error) {
    fmt::print(stderr,
               "mb4sim: the program has written to the device by a call that the library "
               "does not see (docs/spidev.md)\n");
  }
}

}  // namespace

int spidev_command(const SpidevOptions& options) {
  if (options.program.empty()) throw UseError("spidev needs a program: mb4sim spidev -- PROGRAM");
  const sim::Scenario scenario = options.scenario.empty()
                                     ? sim::parse_scenario(kDefaultScenario, "built-in scenario")
                                     : load_chip_scenario(options.scenario);
  if (!scenario.host.serial()) {
    throw sim::ScenarioError(scenario.name, scenario.host.source.of("interface"), "interface",
                             "spidev needs a host on SPI");
  }
  const TraceFile trace(options.trace, options.scenario, scenario);
  sim::SimulatorOptions sim_options;
  sim_options.seed = options.seed;
  sim_options.trace_path = trace.path();
  const std::string found = library_path(options.library);
  const Folder folder;
  const std::string library = loadable(found, folder);
  int status = kGood;
  {
    sim::Simulator simulator(scenario, sim_options);
    BridgeServer server(simulator, options.simulated_time ? Pace::kGaps : Pace::kWall);
    server.listen_unix(folder.socket());
    const ProgramSignals signals;
    const pid_t program = ::fork();
    if (program < 0) throw UseError(fmt::format("cannot fork: {}", std::strerror(errno)));
    if (program == 0) {
      signals.restore();
      become(options, folder, library);
    }
    signals.pass_to(program);
    const FileDescriptor ended(static_cast<int>(::syscall(SYS_pidfd_open, program, 0U)));
    if (!ended) throw UseError(fmt::format("pidfd_open: {}", std::strerror(errno)));
    server.serve(ended.get(), false);
    status = status_of(program);
    report(simulator.host_check(), folder);
    if (server.stopped()) {
      fmt::print(stderr, "mb4sim: the model stopped: {}\n", *server.stopped());
      status = kModelStopped;
    }
  }
  trace.write_view();
  return status;
}

}  // namespace mb4::tool
