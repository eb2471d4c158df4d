// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Options and help of the commands that need no scenario.
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "commands/commands.hpp"
#include "help_pages.hpp"
#include "report/exit_status.hpp"
#include "sim/core/suggestion.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "workload.hpp"

namespace mb4::tool {
namespace {

void add_bench(CLI::App& app, Action& action) {
  constexpr std::uint64_t kMaxRepeats = 1000;
  constexpr std::uint64_t kMaxMilliseconds = 100'000;
  std::shared_ptr<BenchOptions> options;
  CLI::App& bench = *add_command(app, action, "bench", "Measure how fast this machine simulates",
                                 &bench_command, options);
  bench.add_option("--workload", options->workloads, "Which of A to K, as in AB (default all)")
      ->type_name("LETTERS");
  bench.add_option("--repeats", options->repeats, "Repeats of which the median counts (default 5)")
      ->type_name("N")
      ->transform(whole_number(1, kMaxRepeats));
  bench.add_option("--ms", options->milliseconds, "Processor time of each repeat (default 200)")
      ->type_name("MS")
      ->transform(whole_number(1, kMaxMilliseconds));
  bench.add_flag("--json", options->json, "Print JSON instead of the table");
  std::string about = "The workloads, A to G with CLK = 20 MHz:\n";
  for (const WorkloadInfo& info : workloads()) {
    about += std::string("  ") + info.letter + "  " + info.description + '\n';
  }
  bench.footer(about + "Example: mb4sim bench --workload B --repeats 9");
}

void add_presets(CLI::App& app, Action& action) {
  std::shared_ptr<PresetsOptions> options;
  CLI::App& presets =
      *add_command(app, action, "presets", "List the encoders that are known by name",
                   &presets_command, options);
  presets.add_option("preset", options->name, "Print a scenario with this encoder instead")
      ->type_name("NAME");
  presets.add_flag("--json", options->json, "Print JSON instead of the table");
  presets.footer(
      "bits: position and flags, - = the scenario has to say (data_bits). registers: yes = reached "
      "through BiSS.\n"
      "Example: mb4sim presets resolute-26 > my.toml");
}

void add_schema(CLI::App& app, Action& action) {
  CLI::App& schema = *app.add_subcommand("schema", "Print a JSON Schema of scenario files");
  schema.footer(
      "docs/scenario.schema.json is the same with a sentence for each key.\n"
      "Example: mb4sim schema > scenario.schema.json");
  schema.callback([&action] {
    action = [] {
      fmt::print("{}", sim::scenario_schema());
      return kGood;
    };
  });
}

void add_completion(CLI::App& app, Action& action) {
  const auto shell = std::make_shared<std::string>();
  CLI::App& completion =
      *app.add_subcommand("completion", "Print the completion script of a shell");
  completion.add_option("shell", *shell, "bash or zsh")
      ->required()
      ->type_name("SHELL")
      ->check([](const std::string& text) {
        return text == "bash" || text == "zsh" ? "" : "'" + text + "' is neither bash nor zsh";
      });
  completion.footer("Example: source <(mb4sim completion bash)");
  completion.callback([&app, &action, shell] {
    action = [&app, shell] {
      fmt::print("{}", *shell == "bash" ? bash_completion(app) : zsh_completion(app));
      return kGood;
    };
  });
}

void add_man(CLI::App& app, Action& action) {
  CLI::App& man = *app.add_subcommand("man", "Print the manual page");
  man.footer("Example: mb4sim man | man -l -");
  man.callback([&app, &action] {
    action = [&app] {
      fmt::print("{}", man_page(app));
      return kGood;
    };
  });
}

void add_help(CLI::App& app, Action& action) {
  const auto name = std::make_shared<std::string>();
  CLI::App& help = *app.add_subcommand("help", "Print the help of mb4sim or of a command");
  help.add_option("command", *name, "Which command (default: the list of all)")
      ->type_name("COMMAND");
  help.footer("Example: mb4sim help run");
  help.callback([&app, &action, name] {
    action = [&app, name] {
      const std::vector<std::string> known = command_names(app);
      if (name->empty()) {
        app.clear();  // else it would be the help of `help`
        fmt::print("{}", app.help());
      } else if (std::find(known.begin(), known.end(), *name) != known.end()) {
        fmt::print("{}", app.get_subcommand(*name)->help(app.get_name()));
      } else {
        const std::string meant = sim::suggestion(*name, known);
        throw UseError(fmt::format("there is no command '{}'{}", *name,
                                   meant.empty() ? "; 'mb4sim help' lists them" : meant));
      }
      return kGood;
    };
  });
}

}  // namespace

void add_other_commands(CLI::App& app, Action& action) {
  add_presets(app, action);
  add_schema(app, action);
  add_bench(app, action);
  add_completion(app, action);
  add_man(app, action);
  add_help(app, action);
}

}  // namespace mb4::tool
