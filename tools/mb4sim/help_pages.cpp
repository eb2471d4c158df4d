// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "help_pages.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string_view>
#include <vector>

#include "command_line.hpp"
#include "sim/core/version.hpp"
#include "sim/lines/presets.hpp"

namespace mb4::tool {
namespace {

std::vector<const CLI::App*> commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> options(const CLI::App& command) {
  return command.get_options([](const CLI::Option*) { return true; });
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() != 0; }

// --- man page ------------------------------------------------------------------------------

std::string roff(std::string_view text) {
  std::string out;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
    line_start = c == '\n';
  }
  return out;
}

// A usage line: [options] and positionals.
std::string usage(const CLI::App& command) {
  std::string line = fmt::format("mb4sim {} [options]", command.get_name());
  for (const CLI::Option* option : options(command)) {
    if (!option->get_positional()) continue;
    std::string word = option->get_type_name();
    if (option->get_items_expected_max() > 1) word += "...";
    line += option->get_required() ? " " + word : " [" + word + "]";
  }
  return line;
}

void add_option(std::string& out, const CLI::Option& option) {
  if (option.get_positional()) {
    out += fmt::format(".TP\n.I {}\n{}\n", roff(option.get_type_name()),
                       roff(option.get_description()));
    return;
  }
  out += fmt::format(".TP\n.B{} {}", takes_value(option) ? "I" : "", roff(option.get_name()));
  if (takes_value(option)) out += fmt::format(" \" {}\"", roff(option.get_type_name()));
  out += fmt::format("\n{}\n", roff(option.get_description()));
}

// The text below the options; lines with examples as they are.
void add_footer(std::string& out, const std::string& footer) {
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    const std::string_view head = std::string_view(line).substr(0, colon);
    if (head == "Example" || head == "Examples") {
      out += fmt::format(".PP\n{}:\n.PP\n.nf\n{}\n.fi\n", head, roff(line.substr(colon + 2)));
    } else if (line.starts_with("  ")) {
      out += fmt::format(".nf\n{}\n.fi\n", roff(line));
    } else {
      out += fmt::format(".PP\n{}\n", roff(line));
    }
  }
}

// --- completion ----------------------------------------------------------------------------

// Long names of the options of a command.
std::string option_words(const CLI::App& command) {
  std::string words;
  for (const CLI::Option* option : options(command)) {
    for (const std::string& name : option->get_lnames()) {
      words += fmt::format("{}--{}", words.empty() ? "" : " ", name);
    }
  }
  return words;
}

// The words that the positional argument of a command may be; empty: files.
std::string argument_words(const CLI::App& app, const CLI::App& command) {
  if (command.get_name() == "help") return fmt::format("{}", fmt::join(command_names(app), " "));
  if (command.get_name() == "completion") return "bash zsh";
  std::string words;
  if (command.get_name() != "presets") return words;
  for (const sim::Preset& preset : sim::presets()) {
    words += (words.empty() ? "" : " ") + std::string(preset.name);
  }
  return words;
}

// Text between single quotes of a shell.
std::string shell_quoted(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out;
}

std::string zsh_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return shell_quoted(out);
}

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string out = fmt::format(
      ".\\\" SPDX-FileCopyrightText: 2026 The openmb4 authors\n"
      ".\\\" SPDX-License-Identifier: Apache-2.0\n"
      ".TH MB4SIM 1 \"\" \"openmb4 {}\" \"User Commands\"\n"
      ".SH NAME\nmb4sim \\- {}\n.SH SYNOPSIS\n",
      sim::version(), roff(app.get_description()));
  for (const CLI::App* command : commands(app))
    out += fmt::format("{}\n.br\n", roff(usage(*command)));
  out += ".SH DESCRIPTION\n";
  add_footer(out, app.get_footer());
  out +=
      ".PP\nA scenario is a TOML file that describes chip, host, cables and encoders; its keys are "
      "listed in sim/README.md, the commands explained in docs/simulator.md.\n.SH COMMANDS\n";
  for (const CLI::App* command : commands(app)) {
    out +=
        fmt::format(".SS {}\n{}.\n", roff(command->get_name()), roff(command->get_description()));
    for (const CLI::Option* option : options(*command)) add_option(out, *option);
    add_footer(out, command->get_footer());
  }
  return out;
}

std::string bash_completion(const CLI::App& app) {
  std::string out = fmt::format(
      "# Completion of mb4sim for bash.\n"
      "_mb4sim() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} command=${{COMP_WORDS[1]}} options words\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W '{} --help --version -V' -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case $command in\n",
      fmt::join(command_names(app), " "));
  for (const CLI::App* command : commands(app)) {
    out += fmt::format("    {}) options='{}' words='{}' ;;\n", command->get_name(),
                       option_words(*command), argument_words(app, *command));
  }
  return out +
         "  esac\n"
         "  if [[ $word == -* ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
         "  elif [ -n \"$words\" ]; then\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "  else\n"
         "    compopt -o filenames 2>/dev/null\n"
         "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -F _mb4sim mb4sim\n";
}

std::string zsh_completion(const CLI::App& app) {
  std::string out =
      "#compdef mb4sim\n# Completion of mb4sim for zsh.\nlocal -a commands\ncommands=(\n";
  for (const CLI::App* command : commands(app)) {
    out += fmt::format("  '{}:{}'\n", command->get_name(), zsh_text(command->get_description()));
  }
  out +=
      ")\nif (( CURRENT == 2 )); then\n  _describe command commands\n  return\nfi\ncase $words[2] "
      "in\n";
  for (const CLI::App* command : commands(app)) {
    out += fmt::format("  {})\n    _arguments", command->get_name());
    for (const CLI::Option* option : options(*command)) {
      for (const std::string& name : option->get_lnames()) {
        out += fmt::format(" \\\n      '--{}[{}]{}'", name, zsh_text(option->get_description()),
                           takes_value(*option)
                               ? fmt::format(":{}:_files", zsh_text(option->get_type_name()))
                               : "");
      }
    }
    const std::string words = argument_words(app, *command);
    out += words.empty() ? " \\\n      '*:file:_files'\n    ;;\n"
                         : fmt::format(" \\\n      '1:word:({})'\n    ;;\n", words);
  }
  return out + "esac\n";
}

}  // namespace mb4::tool
