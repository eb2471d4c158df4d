// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The commands, options and help texts of mb4sim.
#ifndef MB4SIM_TOOL_COMMAND_LINE_HPP_
#define MB4SIM_TOOL_COMMAND_LINE_HPP_

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mb4::tool {

// Runs a command after the command line is parsed; returns the exit status.
using Action = std::function<int()>;

// The whole command line. Parsing sets `action` to the command that was asked for.
std::unique_ptr<CLI::App> make_command_line(Action& action);

// Describes the mistake in a command line that caused `error`: unknown words and options first, in
// the order in which they were typed.
std::string mistake(const CLI::App& app, const CLI::ParseError& error);

std::vector<std::string> command_names(const CLI::App& app);

// --- for those who add commands ------------------------------------------------------------

// Commands that read a scenario: run, watch, check, spi, regs, scan, sweep, regress.
void add_scenario_commands(CLI::App& app, Action& action);
// Commands without a scenario: presets, schema, bench, completion, man, help.
void add_other_commands(CLI::App& app, Action& action);
// The simulated chip in place of a real chip, and pictures of its lines: spidev, bridge, plot.
void add_dropin_commands(CLI::App& app, Action& action);

// Whole number, decimal or 0x.
CLI::Validator whole_number(std::uint64_t minimum, std::uint64_t maximum);
// Microseconds of 0 to 10^9, decimals allowed.
CLI::Validator microseconds();
// Anything but an empty text.
CLI::Validator file_name();
// The argument SCENARIO.
void add_scenario(CLI::App& command, std::string& target);
// --seed.
void add_seed(CLI::App& command, std::optional<std::uint64_t>& seed);
// An option with the name of a file.
void add_output(CLI::App& command, const char* option, std::string& path, const char* description,
                const char* type_name = "F");
// --trace of a waveform.
void add_trace(CLI::App& command, std::string& path);

// A command whose options live as long as the command line; `run` gets them.
template <typename Options>
CLI::App* add_command(CLI::App& app, Action& action, const char* name, const char* description,
                      int (*run)(const Options&), std::shared_ptr<Options>& options) {
  options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(name, description);
  command->callback([&action, run, options] { action = [run, options] { return run(*options); }; });
  return command;
}

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_COMMAND_LINE_HPP_
