// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The commands of mb4sim. Each returns an exit status and throws UseError, sim::ScenarioError or
// sim::ModelStopped.
#ifndef MB4SIM_TOOL_COMMANDS_HPP_
#define MB4SIM_TOOL_COMMANDS_HPP_

#include <cstdint>
#include <optional>
#include <string>

namespace mb4::tool {

struct RunOptions {
  std::string scenario;
  std::uint64_t frames = 10;
  std::string trace;  // empty: none
  std::string csv;    // empty: none
  bool json = false;
  std::optional<std::uint64_t> seed;
};
int run_command(const RunOptions& options);

struct SpiOptions {
  std::string scenario;
};
int spi_command(const SpiOptions& options);

struct RegsOptions {
  std::string scenario;
  std::uint64_t frames = 0;
  bool reset = false;
  bool json = false;
};
int regs_command(const RegsOptions& options);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_COMMANDS_HPP_
