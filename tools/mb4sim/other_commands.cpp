// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Options and help of the commands that need no scenario.
#include <memory>
#include <string>

#include "command_line.hpp"
#include "commands.hpp"
#include "workload.hpp"

namespace mb4::tool {
namespace {

void add_bench(CLI::App& app, Action& action) {
  constexpr std::uint64_t kMaxRepeats = 1000;
  constexpr std::uint64_t kMaxMilliseconds = 100'000;
  std::shared_ptr<BenchOptions> options;
  CLI::App& bench = *add_command(app, action, "bench", "Measure how fast this machine simulates",
                                 &bench_command, options);
  bench
      .add_option("--workload", options->workloads,
                  "Which of A, B, C and D, as in AB (default all)")
      ->type_name("LETTERS");
  bench.add_option("--repeats", options->repeats, "Repeats of which the median counts (default 5)")
      ->type_name("N")
      ->transform(whole_number(1, kMaxRepeats));
  bench.add_option("--ms", options->milliseconds, "Processor time of each repeat (default 200)")
      ->type_name("MS")
      ->transform(whole_number(1, kMaxMilliseconds));
  bench.add_flag("--json", options->json, "Print JSON instead of the table");
  std::string about = "The workloads, all with CLK = 20 MHz:\n";
  for (const WorkloadInfo& info : workloads()) {
    about += std::string("  ") + info.letter + "  " + info.description + '\n';
  }
  bench.footer(about + "Example: mb4sim bench --workload B --repeats 9");
}

}  // namespace

void add_other_commands(CLI::App& app, Action& action) { add_bench(app, action); }

}  // namespace mb4::tool
