// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Manual page and shell completions. They are made from the commands themselves, so that they
// always agree with --help.
#ifndef MB4SIM_TOOL_HELP_PAGES_HPP_
#define MB4SIM_TOOL_HELP_PAGES_HPP_

#include <CLI/CLI.hpp>
#include <string>

namespace mb4::tool {

// mb4sim.1 for man(1).
std::string man_page(const CLI::App& app);
// A completion script of this shell.
std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_HELP_PAGES_HPP_
