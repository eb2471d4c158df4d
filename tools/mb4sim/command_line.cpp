// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "command_line.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include "sim/core/suggestion.hpp"
#include "sim/core/version.hpp"

namespace mb4::tool {

// Passes decimal text without leading zeros to CLI11. CLI11 itself reads leading zeros as octal,
// wraps negative numbers and cuts long ones.
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

CLI::Validator microseconds() {
  const auto check = [](const std::string& text) {
    constexpr double kMaxUs = 1e9;
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value, std::chars_format::fixed);
    if (error != std::errc() || stop != end || !(value >= 0 && value <= kMaxUs)) {
      return fmt::format("'{}' is no time of 0 to 1000000000 us", text);
    }
    return std::string();
  };
  return CLI::Validator(check, "");
}

CLI::Validator file_name() {
  return CLI::Validator(
      [](const std::string& text) {
        if (text.empty()) return std::string("a file name is needed");
        if (text == "-")
          return std::string(
              "'-' is taken for no pipe: give a file name (./- for one of this name)");
        return std::string();
      },
      "");
}

void add_scenario(CLI::App& command, std::string& target) {
  command.add_option("scenario", target, "Scenario file (TOML), or a name of `mb4sim presets`")
      ->required()
      ->type_name("SCENARIO")
      ->check(file_name());
}

void add_seed(CLI::App& command, std::optional<std::uint64_t>& seed) {
  command.add_option("--seed", seed, "Seed of every random choice (default 1)")
      ->type_name("S")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
}

void add_output(CLI::App& command, const char* option, std::string& path, const char* description,
                const char* type_name) {
  command.add_option(option, path, description)->type_name(type_name)->check(file_name());
}

void add_trace(CLI::App& command, std::string& path) {
  add_output(command, "--trace", path, "Write a waveform, and a .gtkw view beside it", "F.fst");
}

std::unique_ptr<CLI::App> make_command_line(Action& action) {
  auto app = std::make_unique<CLI::App>(
      "Simulator of an iC-MB4-compatible BiSS/SSI master with cables and encoders.");
  app->name("mb4sim");
  app->set_version_flag("-V,--version", std::string("mb4sim ") + sim::version());
  app->require_subcommand(1);
  app->footer(
      "Exit status: 0 good, 1 a check failed or a frame was bad, 2 wrong use or input, 3 the model "
      "stopped on an assertion.\nExample: mb4sim run examples/resolute-26.toml --frames 5");
  add_scenario_commands(*app, action);
  add_dropin_commands(*app, action);
  add_other_commands(*app, action);
  return app;
}

namespace {

std::vector<std::string> long_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options([](const CLI::Option*) { return true; })) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

}  // namespace

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(each->get_name());
  }
  return names;
}

std::string mistake(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const CLI::App& command = parsed.empty() ? app : *parsed.front();
  const std::vector<std::string> options = long_names(command);
  // An unknown word is most often the reason why another word is missing.
  std::string unknown;
  for (const std::string& word : app.remaining(true)) {
    if (word == "--") continue;
    unknown += fmt::format("{}'{}'", unknown.empty() ? "unknown: " : ", ", word);
    const std::string name = word.substr(0, word.find('='));
    if (word.starts_with('-')) {
      const bool early = std::find(options.begin(), options.end(), name) != options.end();
      unknown += early ? ", which goes behind the command" : sim::suggestion(name, options);
    } else if (parsed.empty()) {
      unknown += sim::suggestion(word, command_names(app));
      break;  // the next words belong to the intended command
    }
  }
  return fmt::format("{} (see mb4sim {}--help)", unknown.empty() ? error.what() : unknown,
                     parsed.empty() ? "" : command.get_name() + " ");
}

}  // namespace mb4::tool
