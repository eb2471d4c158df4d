// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "commands/commands.hpp"
#include "masters/mb4/chip_setup.hpp"
#include "masters/mb4/sim_bus.hpp"
#include "mb4sim/simulator.hpp"
#include "report/exit_status.hpp"
#include "report/fault_report.hpp"
#include "report/pair_warning.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {
namespace {

constexpr std::uint64_t kMaxAdvanceNs = 1'000'000'000'000;  // 1000 s

std::vector<std::string_view> words_of(std::string_view line) {
  line = line.substr(0, std::min(line.find('#'), line.size()));
  std::vector<std::string_view> words;
  constexpr std::string_view kBlank = " \t\r";
  for (auto at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlank, end);
  }
  return words;
}

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

template <typename T>
bool parse(std::string_view word, T& value, int base) {
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value, base);
  return error == std::errc() && stop == end;
}

// One line of standard input; throws UseError without the place.
void execute(sim::Simulator& simulator, SimBus& bus, const std::vector<std::string_view>& words) {
  if (words[0].starts_with('+')) {
    std::uint64_t ns = 0;
    if (words.size() != 1 || !parse(words[0].substr(1), ns, 10) || ns > kMaxAdvanceNs) {
      throw UseError("expected +N with N nanoseconds up to 10^12");
    }
    simulator.advance(ns * sim::kPsPerNs);
    return;
  }
  if (words[0] == "pin") {
    if (words.size() != 3 || (words[2] != "0" && words[2] != "1")) {
      throw UseError("expected 'pin NAME LEVEL' with level 0 or 1");
    }
    const auto pin = simulator.pin_by_name(words[1]);
    if (!pin) throw UseError(fmt::format("there is no pin '{}'", words[1]));
    if (!simulator.can_set(*pin)) {
      throw UseError(fmt::format("pin '{}' is driven by chip or simulation", words[1]));
    }
    simulator.set_pin(*pin, words[2] == "1");
    return;
  }
  std::vector<std::uint8_t> tx;
  for (const std::string_view word : words) {
    std::uint8_t byte = 0;
    if (word.size() != 2 || !parse(word, byte, 16)) {
      throw UseError(
          fmt::format("expected bytes of two hex digits, +N or pin NAME LEVEL, found '{}'", word));
    }
    tx.push_back(byte);
  }
  std::vector<std::uint8_t> rx(tx.size());
  bus.transfer({tx.data(), tx.size()}, {rx.data(), rx.size()});
  fmt::print("{:02X}\n", fmt::join(rx, " "));
}

}  // namespace

int spi_command(const SpiOptions& options) {
  const sim::Scenario scenario = load_chip_scenario(options.scenario);
  sim::Simulator simulator(scenario);
  SimBus bus(simulator);
  std::string line;
  PairWarning pairs(simulator);
  std::size_t faults = 0;  // that have been logged
  for (unsigned number = 1; read_line(line, number); ++number) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    try {
      execute(simulator, bus, words);
    } catch (const UseError& error) {
      throw UseError(fmt::format("standard input:{}: {}", number, error.what()));
    }
    print_faults(false, simulator.faults(), faults);
    pairs.look();
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
