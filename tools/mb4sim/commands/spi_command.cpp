// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "masters/mb4/chip_setup.hpp"
#include "masters/mb4/sim_bus.hpp"
#include "masters/mb4/spi_lines.hpp"
#include "mb4sim/simulator.hpp"
#include "report/exit_status.hpp"
#include "report/fault_report.hpp"
#include "report/hint_lines.hpp"
#include "report/pair_warning.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

// False at the end of standard input. Line by line, so that a program can converse with the chip.
bool read_line(std::string& line, unsigned number) {
  constexpr std::size_t kMaxLine = std::size_t{1} << 20U;
  line.clear();
  for (int c = std::getchar(); c != EOF; c = std::getchar()) {
    if (c == '\n') return true;
    if (line.size() == kMaxLine) {
      throw UseError(fmt::format("standard input:{}: the line is longer than 1 MiB", number));
    }
    line += static_cast<char>(c);
  }
  return !line.empty();
}

}  // namespace

int spi_command(const SpiOptions& options) {
  const sim::Scenario scenario = load_chip_scenario(options.scenario);
  sim::Simulator simulator(scenario);
  SimBus bus(simulator);
  std::string line;
  std::vector<std::uint8_t> received;
  PairWarning pairs(simulator);
  HintLines hints(false);
  std::size_t faults = 0;  // that have been logged
  for (unsigned number = 1; read_line(line, number); ++number) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    if (const std::string why = execute_words(simulator, bus, words, received); !why.empty()) {
      throw UseError(fmt::format("standard input:{}: {}", number, why));
    }
    if (!received.empty()) fmt::print("{:02X}\n", fmt::join(received, " "));
    print_faults(false, simulator.faults(), faults);
    pairs.look();
    hints.print(simulator.hints());
    faults = simulator.faults().size();
    if (std::fflush(stdout) != 0) throw UseError("cannot write to standard output");
  }
  if (const auto& check = simulator.host_check(); check.count() != 0) {
    fmt::print(stderr, "host timing: {} violation(s), first: {}\n", check.count(),
               check.violations().front().text);
  }
  return kGood;
}

}  // namespace mb4::tool
