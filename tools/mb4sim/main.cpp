// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// mb4sim: the openmb4 simulator on the command line. Data goes to standard output, messages to
// standard error.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <limits>
#include <string>
#include <system_error>

#include "commands.hpp"
#include "exit_status.hpp"
#include "mb4sim/model_stopped.hpp"
#include "mb4sim/one_line.hpp"
#include "mb4sim/version.hpp"

namespace {

using mb4::tool::RegsOptions;
using mb4::tool::RunOptions;
using mb4::tool::SpiOptions;
using mb4::tool::SweepOptions;

constexpr std::uint64_t kMaxFrames = 1'000'000'000;

// Whole number, decimal or 0x. What goes on to CLI11 is decimal without leading zeros: left alone
// it reads octal, wraps negative numbers and cuts long ones.
CLI::Validator whole_number(std::uint64_t minimum, std::uint64_t maximum) {
  const auto check = [=](std::string& text) {
    const bool hex = text.starts_with("0x") || text.starts_with("0X");
    const char* const begin = text.data() + (hex ? 2 : 0);
    const char* const end = text.data() + text.size();
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value, hex ? 16 : 10);
    if (error != std::errc() || stop != end || value < minimum || value > maximum) {
      return fmt::format("'{}' is no whole number of {} to {}", text, minimum, maximum);
    }
    text = fmt::format("{}", value);
    return std::string();
  };
  return CLI::Validator(check, "");
}

CLI::Validator file_name() {
  return CLI::Validator(
      [](const std::string& text) {
        return text.empty() ? std::string("a file name is needed") : std::string();
      },
      "");
}

void add_scenario(CLI::App& command, std::string& target) {
  command.add_option("scenario", target, "Scenario file (TOML)")
      ->required()
      ->type_name("SCENARIO")
      ->check(file_name());
}

int run(int argc, char** argv) {
  CLI::App app{"Simulator of an iC-MB4-compatible BiSS/SSI master with cables and encoders."};
  app.name("mb4sim");
  app.set_version_flag("--version", std::string("mb4sim ") + mb4::sim::version());
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 good, 1 a check failed or a frame was bad, 2 wrong use or input, 3 the model "
      "stopped on an assertion.\nExample: mb4sim run examples/resolute-26.toml --frames 5");
  std::function<int()> command;

  RunOptions run_options;
  CLI::App* run_app =
      app.add_subcommand("run", "Configure the chip through the driver and read all slaves");
  add_scenario(*run_app, run_options.scenario);
  run_app->add_option("--frames", run_options.frames, "Frames to read (default 10)")
      ->type_name("N")
      ->transform(whole_number(1, kMaxFrames));
  run_app->add_option("--trace", run_options.trace, "Write a waveform, and a .gtkw view beside it")
      ->type_name("F.fst")
      ->check(file_name());
  run_app->add_option("--csv", run_options.csv, "Also write the table as CSV")
      ->type_name("F")
      ->check(file_name());
  run_app->add_option("--bus-log", run_options.bus_log, "Write what the driver sends and receives")
      ->type_name("F")
      ->check(file_name());
  run_app->add_flag("--json", run_options.json, "Print JSON instead of the table");
  run_app->add_option("--seed", run_options.seed, "Seed of every random choice (default 1)")
      ->type_name("S")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  run_app->footer("Example: mb4sim run examples/resolute-26.toml --frames 5 --trace run.fst");
  run_app->callback([&] { command = [&] { return mb4::tool::run_command(run_options); }; });

  SpiOptions spi_options;
  CLI::App* spi_app = app.add_subcommand("spi", "Exchange SPI frames given on standard input");
  add_scenario(*spi_app, spi_options.scenario);
  spi_app->footer(
      "Each line of standard input is one of\n"
      "  02 ED 01       an SPI frame in hex; its MISO bytes are printed\n"
      "  +1000          let 1000 ns pass\n"
      "  pin GETSENS 1  set a pin\n"
      "  # comment\n"
      "Example: echo '03 EA 00 00' | mb4sim spi examples/resolute-26.toml");
  spi_app->callback([&] { command = [&] { return mb4::tool::spi_command(spi_options); }; });

  SweepOptions sweep_options;
  CLI::App* sweep_app = app.add_subcommand(
      "sweep", "Count bad frames over line delay, jitter and FREQS (eye margin)");
  add_scenario(*sweep_app, sweep_options.scenario);
  sweep_app
      ->add_option("--delays", sweep_options.delays,
                   "Round-trip delays in ns, on all channels (default 0:400:20)")
      ->type_name("LIST");
  sweep_app
      ->add_option("--jitters", sweep_options.jitters,
                   "Jitter of SL in % of T_MA, peak to peak (default 0:50:5)")
      ->type_name("LIST");
  sweep_app
      ->add_option("--freqs", sweep_options.freqs,
                   "FREQS codes, or all (default: the scenario's ma_hz)")
      ->type_name("LIST");
  sweep_app->add_option("--frames", sweep_options.frames, "Frames at each point (default 20)")
      ->type_name("N")
      ->transform(whole_number(1, kMaxFrames));
  sweep_app->add_option("--csv", sweep_options.csv, "Also write one line a point")
      ->type_name("F")
      ->check(file_name());
  sweep_app->add_option("--svg", sweep_options.svg, "Also draw the eye margin")
      ->type_name("F.svg")
      ->check(file_name());
  sweep_app->add_option("--seed", sweep_options.seed, "Seed of every random choice (default 1)")
      ->type_name("S")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  sweep_app->footer(
      "LIST is A, A,B,C or FROM:TO:STEP. The rest of the cable is as the scenario says. Exit "
      "status "
      "1 if a word was bad with jitter up to 25 % (I305).\n"
      "Example: mb4sim sweep examples/resolute-26.toml --jitters 0:60:5 --freqs 0,3 --svg eye.svg");
  sweep_app->callback([&] { command = [&] { return mb4::tool::sweep_command(sweep_options); }; });

  RegsOptions regs_options;
  CLI::App* regs_app = app.add_subcommand("regs", "Print the chip's registers, decoded");
  add_scenario(*regs_app, regs_options.scenario);
  regs_app->add_option("--frames", regs_options.frames, "Frames to read before (default 0)")
      ->type_name("N")
      ->transform(whole_number(0, kMaxFrames));
  regs_app->add_flag("--reset", regs_options.reset, "As after reset, without configuring the chip")
      ->excludes("--frames");
  regs_app->add_flag("--json", regs_options.json, "Print JSON instead of the table");
  regs_app->footer("Example: mb4sim regs examples/resolute-26.toml --frames 1");
  regs_app->callback([&] { command = [&] { return mb4::tool::regs_command(regs_options); }; });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    fmt::print(stderr, "mb4sim: {} (see mb4sim --help)\n", mb4::sim::one_line(error.what()));
    return mb4::tool::kWrongUse;
  }
  return command();
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
