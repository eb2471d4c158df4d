// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "chip_setup.hpp"
#include "commands/commands.hpp"
#include "mb4sim/simulator.hpp"
#include "report/exit_status.hpp"
#include "report/fault_report.hpp"
#include "report/frame_report.hpp"
#include "report/output_file.hpp"
#include "report/progress.hpp"
#include "session.hpp"
#include "sim/core/one_line.hpp"
#include "sim/masters/mb4/functional_coverage.hpp"
#include "sim/scenario/scenario.hpp"
#include "worker_pool.hpp"

namespace mb4::tool {
namespace {

constexpr const char* kRow = "{:<44}  {:>20}  {:>8}  {:>6}  {:>6}  {:>6}  {}\n";
constexpr std::uint64_t kMaxRuns = 1'000'000;

// What a worker returns: a line of the table, which begins with its exit status as a digit; with
// `cover` a line of counts after it.
std::string run_one(const std::string& path, const sim::Scenario& scenario, std::uint64_t seed,
                    std::uint64_t frames, bool cover) {
  std::string state = "ok";
  int status = kGood;
  FrameReport report(scenario);
  std::uint64_t faults = 0;
  std::uint64_t missed = 0;
  sim::FunctionalCoverage coverage;
  try {
    sim::SimulatorOptions options;
    options.seed = seed;
    Session session(scenario, options);
    if (cover) session.simulator().set_observer(&coverage);
    if (const Result<void> configured = session.configure(); !configured) {
      state = "cannot configure the chip: " + describe(configured.info());
      status = kBad;
    }
    FaultReport fault_report(session.simulator().scenario(), session.simulator().faults());
    for (std::uint64_t number = 1; status == kGood && number <= frames; ++number) {
      const SessionFrame frame = session.read(number);
      for (std::size_t i = 0; i < session.slaves().size(); ++i) {
        report.add(number, frame.end, session.slaves()[i].number, frame.results[i], frame.sent[i]);
      }
      session.report(frame, fault_report);
    }
    fault_report.finish();
    faults = session.simulator().faults().size();
    missed = fault_report.count(FaultReport::Fate::kMissed);
    if (status == kGood && (report.bad() != 0 || !fault_report.ids_good())) {
      status = kBad;
      state = report.bad() != 0 ? report.worst_error() : "register access failed";
    }
  } catch (const sim::ModelStopped& error) {
    state = std::string("the model stopped: ") + error.what();
    status = kModelStopped;
  }
  return fmt::format("{}", status) +
         fmt::format(kRow, sim::one_line(path), seed, report.good(), report.bad(), faults, missed,
                     state) +
         (cover ? fmt::format("{}", fmt::join(coverage.counts(), " ")) : "");
}

std::vector<std::uint64_t> numbers(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::uint64_t>(words), {}};
}

}  // namespace

int regress_command(const RegressOptions& options) {
  std::vector<sim::Scenario> scenarios;
  for (const std::string& path : options.scenarios) {
    scenarios.push_back(load_chip_scenario(path));
    make_config(scenarios.back());
  }
  const std::uint64_t runs = scenarios.size() * options.seeds;
  if (runs > kMaxRuns) throw UseError(fmt::format("{} runs are more than {}", runs, kMaxRuns));
  if (options.first_seed + (options.seeds - 1) < options.first_seed) {
    throw UseError("--seeds: the last seed does not fit into 64 bits");
  }
  std::optional<OutputFile> cover_file;
  if (!options.cover_path.empty()) {
    require_distinct({{"--cover", options.cover_path}}, options.scenarios);
    cover_file.emplace(options.cover_path);
  }
  sim::FunctionalCoverage coverage;
  fmt::print(kRow, "scenario", "seed", "good", "bad", "faults", "missed", "state");
  std::fflush(stdout);
  Progress progress(runs);
  std::uint64_t done = 0;
  std::uint64_t failed = 0;
  int status = kGood;
  const auto job = [&](std::uint64_t index) {
    const std::size_t which = index / options.seeds;
    return run_one(options.scenarios[which], scenarios[which],
                   options.first_seed + index % options.seeds, options.frames,
                   cover_file.has_value());
  };
  // Results come in the order of the runs, however many workers there are.
  const auto result = [&](const std::string& line) {
    progress.clear();
    const int one = line.empty() ? kModelStopped : line.front() - '0';
    status = std::max(status, one);
    if (one != kGood) ++failed;
    const std::size_t end = line.find('\n') + 1;
    fmt::print("{}", line.empty() ? "a worker has died\n" : line.substr(1, end - 1));
    if (cover_file) coverage.add(numbers(line.substr(line.empty() ? 0 : end)));
    progress.update(++done);
  };
  run_jobs(runs, static_cast<unsigned>(options.jobs), job, result);
  progress.clear();
  fmt::print("runs {}, failed {}\n", runs, failed);
  if (cover_file) {
    cover_file->commit(coverage.text());
    fmt::print("functional coverage {} of {} points\n", coverage.reached(), coverage.points());
  }
  return status;
}

}  // namespace mb4::tool
