// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "commands/commands.hpp"
#include "mb4sim/simulator.hpp"
#include "plot/svg.hpp"
#include "report/colour.hpp"
#include "report/exit_status.hpp"
#include "report/fault_report.hpp"
#include "report/frame_report.hpp"
#include "report/messages.hpp"
#include "report/output_file.hpp"
#include "report/progress.hpp"
#include "scenario_argument.hpp"
#include "session.hpp"
#include "sim/core/one_line.hpp"
#include "sim/masters/mb4/functional_coverage.hpp"
#include "sim/scenario/scenario.hpp"
#include "worker_pool.hpp"

namespace mb4::tool {
namespace {

constexpr const char* kRegressRow = "{:<44}  {:>20}  {:>8}  {:>6}  {:>6}  {:>6}  {}\n";
constexpr std::uint64_t kMaxRuns = 1'000'000;
constexpr std::string_view kFormat = "mb4sim-regress-1";  // first word of a shard
constexpr std::string_view kEnd = "end";                  // its last line

std::vector<std::string> fields_of(const std::string& line, char separator = '\t') {
  std::vector<std::string> fields;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  return fields;
}

std::optional<std::uint64_t> number_of(std::string_view text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || last != end) return std::nullopt;
  return number;
}

// The whole batch: run `number` has scenario number / seeds and seed first_seed + number % seeds.
struct Batch {
  std::uint64_t scenarios, seeds, first_seed, frames;
  bool cover;

  std::uint64_t runs() const { return scenarios * seeds; }
  std::uint64_t seed(std::uint64_t number) const { return first_seed + number % seeds; }
  std::string text() const {
    return fmt::format("{}\t{}\t{}\t{}\t{}", scenarios, seeds, first_seed, frames, cover ? 1 : 0);
  }
};

// The result of a run. Its text is what a worker returns and a line of a shard; docs/simulator.md
// describes it.
struct Row {
  int status = kGood;
  std::string scenario;
  std::uint64_t seed = 0, good = 0, bad = 0, faults = 0, missed = 0;
  std::string state = "ok";
  std::vector<std::uint64_t> coverage;

  std::string text(std::uint64_t number) const {
    return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}", number, status, scenario, seed,
                       good, bad, faults, missed, state, fmt::join(coverage, " "));
  }
  // Nothing if the fields are not those of a row.
  static std::optional<Row> from(const std::vector<std::string>& fields) {
    if (fields.size() != 10) return std::nullopt;
    Row row;
    std::uint64_t status = 0;
    const auto take = [](std::string_view text, std::uint64_t& target) {
      const std::optional<std::uint64_t> value = number_of(text);
      target = value.value_or(0);
      return value.has_value();
    };
    if (!take(fields[1], status) || status > kModelStopped || !take(fields[3], row.seed) ||
        !take(fields[4], row.good) || !take(fields[5], row.bad) || !take(fields[6], row.faults) ||
        !take(fields[7], row.missed)) {
      return std::nullopt;
    }
    row.status = static_cast<int>(status);
    row.scenario = fields[2];
    row.state = fields[8];
    if (fields[9].empty()) return row;
    for (const std::string& count : fields_of(fields[9], ' ')) {
      if (!take(count, row.coverage.emplace_back())) return std::nullopt;
    }
    return row;
  }
};

Row run_one(const std::string& path, const sim::Scenario& scenario, std::uint64_t seed,
            std::uint64_t frames, bool cover) {
  Row row;
  row.scenario = sim::one_line(path);
  row.seed = seed;
  FrameReport report(scenario);
  sim::FunctionalCoverage coverage;
  try {
    SessionOptions options;
    options.simulator.seed = seed;
    const std::unique_ptr<Session> session = support_of(scenario).open(scenario, options);
    if (cover) session->simulator().set_observer(&coverage);
    if (const std::string why = session->configure(); !why.empty()) {
      row.state = fmt::format("{}: {}", support_of(scenario).not_begun, why);
      row.status = kBad;
    }
    FaultReport fault_report(session->simulator().scenario(), session->simulator().faults());
    for (std::uint64_t number = 1; row.status == kGood && number <= frames; ++number) {
      const SessionFrame frame = session->read(number);
      for (std::size_t i = 0; i < session->slaves().size(); ++i) {
        report.add(frame, session->slaves()[i].number, i);
      }
      fault_report.add(frame, *session);
    }
    fault_report.finish();
    row.faults = session->simulator().faults().size();
    row.missed = fault_report.count(FaultReport::Fate::kMissed);
    if (row.status == kGood && (report.bad() != 0 || !fault_report.ids_good())) {
      row.status = kBad;
      row.state = report.bad() != 0 ? report.worst_error() : "register access failed";
    }
  } catch (const sim::ModelStopped& error) {
    row.state = std::string("the model stopped: ") + error.what();
    row.status = kModelStopped;
  }
  row.state = sim::one_line(row.state);
  row.good = report.good();
  row.bad = report.bad();
  if (cover) row.coverage = coverage.counts();
  return row;
}

// As the value of an attribute.
std::string attribute(std::string_view text) {
  std::string out;
  for (const char c : svg::escaped(text)) {
    if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

// A run as a test of JUnit.
std::string junit_case(const Row& row) {
  const std::string begin = fmt::format("  <testcase classname=\"{}\" name=\"seed {}\"",
                                        attribute(row.scenario), row.seed);
  if (row.status == kGood) return begin + "/>\n";
  return begin +
         fmt::format(
             ">\n    <failure message=\"{}\">good {}, bad {}, faults {}, missed {}; repeat: "
             "mb4sim run {} --seed {}</failure>\n  </testcase>\n",
             attribute(row.state), row.good, row.bad, row.faults, row.missed,
             attribute(row.scenario), row.seed);
}

// The table and the sums of a batch.
class Table {
 public:
  explicit Table(const RegressOptions& options) : json_(options.json) {
    if (!options.cover_path.empty()) {
      require_distinct({{"--cover", options.cover_path}}, options.scenarios);
      cover_file_.emplace(options.cover_path);
    }
    if (!options.junit.empty()) {
      require_distinct({{"--junit", options.junit}}, options.scenarios);
      junit_file_.emplace(options.junit);
    }
  }
  void head() const {
    if (json_) {
      fmt::print("{{\"runs\": [");
      return;
    }
    fmt::print(kRegressRow, "scenario", "seed", "good", "bad", "faults", "missed", "state");
    std::fflush(stdout);
  }
  void print(const Row& row) {
    if (json_) {
      fmt::print(
          "{}\n  {{\"scenario\": {}, \"seed\": {}, \"good\": {}, \"bad\": {}, \"faults\": {}, "
          "\"missed\": {}, \"status\": {}, \"state\": {}}}",
          any_ ? "," : "", json_text(row.scenario), row.seed, row.good, row.bad, row.faults,
          row.missed, row.status, json_text(row.state));
      any_ = true;
      return;
    }
    fmt::print("{}", coloured(fmt::format(kRegressRow, row.scenario, row.seed, row.good, row.bad,
                                          row.faults, row.missed, row.state),
                              row.status == kGood));
  }
  void count(const Row& row) {
    ++runs_;
    status_ = std::max(status_, row.status);
    if (row.status != kGood) ++failed_;
    coverage_.add(row.coverage);
    if (junit_file_) cases_ += junit_case(row);
  }
  void sums(std::uint64_t runs) const {
    if (json_) {
      fmt::print("\n], \"failed\": {}}}\n", failed_);
    } else {
      fmt::print("runs {}, failed {}\n", runs, failed_);
    }
  }
  // Writes the file of --cover. Returns the exit status.
  int finish(bool print) {
    if (junit_file_) {
      junit_file_->commit(fmt::format(
          "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"mb4sim regress\" "
          "tests=\"{}\" failures=\"{}\">\n{}</testsuite>\n",
          runs_, failed_, cases_));
    }
    if (!cover_file_) return status_;
    cover_file_->commit(coverage_.text());
    if (print && !json_) {
      fmt::print("functional coverage {} of {} points\n", coverage_.reached(), coverage_.points());
    }
    return status_;
  }

 private:
  bool json_;
  bool any_ = false;
  std::optional<OutputFile> cover_file_;
  std::optional<OutputFile> junit_file_;
  std::string cases_;  // of JUnit
  std::uint64_t runs_ = 0;
  sim::FunctionalCoverage coverage_;
  std::uint64_t failed_ = 0;
  int status_ = kGood;
};

// "K/N": shard K of N, from 1 on.
struct Shard {
  std::uint64_t number = 1, count = 1;

  explicit Shard(const std::string& text) {
    if (text.empty()) return;
    const std::size_t slash = std::min(text.find('/'), text.size());
    number = number_of(std::string_view(text).substr(0, slash)).value_or(0);
    count = number_of(std::string_view(text).substr(std::min(slash + 1, text.size()))).value_or(0);
    if (number == 0 || number > count || count > kMaxRuns) {
      throw UseError(fmt::format("--shard: '{}' is no K/N with K of 1 to N and N of 1 to {}",
                                 sim::one_line(text), kMaxRuns));
    }
  }
  // Neighbouring runs cost about the same, so they go to different shards.
  std::uint64_t runs(std::uint64_t all) const {
    return all / count + (number <= all % count ? 1 : 0);
  }
  std::uint64_t run(std::uint64_t index) const { return index * count + number - 1; }
};

int run_shard(const RegressOptions& options) {
  const Shard shard(options.shard);
  std::vector<sim::Scenario> scenarios;
  for (const std::string& path : options.scenarios) {
    const sim::Scenario& scenario = scenarios.emplace_back(open_scenario(path));
    support_of(scenario).check(scenario);
    if (!options.cover_path.empty() && !support_of(scenario).coverage) {
      throw UseError(fmt::format("--cover: {}: there are no points for the master \"{}\"",
                                 sim::one_line(path), scenario.master->type));
    }
    if (!options.cover_path.empty() && scenario.host.interface.words) {
      throw UseError(fmt::format("--cover: {}: there are no points for the interface \"{}\"",
                                 sim::one_line(path), scenario.host.interface.key));
    }
  }
  const Batch batch{scenarios.size(), options.seeds, options.first_seed, options.frames,
                    !options.cover_path.empty()};
  if (batch.runs() > kMaxRuns) {
    throw UseError(fmt::format("{} runs are more than {}", batch.runs(), kMaxRuns));
  }
  if (options.first_seed + (options.seeds - 1) < options.first_seed) {
    throw UseError("--seeds: the last seed does not fit into 64 bits");
  }
  Table table(options);
  const bool part = !options.shard.empty();
  if (part) {
    fmt::print("{}\t{}\t{}\t{}\n", kFormat, shard.number, shard.count, batch.text());
  } else {
    table.head();
  }
  const std::uint64_t runs = shard.runs(batch.runs());
  Progress progress(runs);
  std::uint64_t done = 0;
  const auto job = [&](std::uint64_t index) {
    const std::uint64_t run = shard.run(index);
    const std::size_t which = run / batch.seeds;
    return run_one(options.scenarios[which], scenarios[which], batch.seed(run), batch.frames,
                   batch.cover)
        .text(run);
  };
  // Results come in the order of the runs, however many workers there are.
  const auto result = [&](const std::string& text) {
    progress.clear();
    const std::uint64_t run = shard.run(done);
    std::optional<Row> row = Row::from(fields_of(text));
    if (!row) {
      row.emplace();
      row->status = kModelStopped;
      row->scenario = sim::one_line(options.scenarios[run / batch.seeds]);
      row->seed = batch.seed(run);
      row->state = "the worker has died";
    }
    if (part) {
      fmt::print("{}\n", row->text(run));
    } else {
      table.print(*row);
    }
    table.count(*row);
    progress.update(++done);
  };
  run_jobs(runs, static_cast<unsigned>(options.jobs), job, result);
  progress.clear();
  if (part) {
    fmt::print("{}\n", kEnd);
  } else {
    table.sums(runs);
  }
  return table.finish(!part);
}

// Reads the shards of a batch, in any order, and prints what the whole batch would have printed.
int merge(const RegressOptions& options) {
  std::string head;  // of the batch, from the first file
  Batch batch{};
  std::vector<std::string> rows;   // by their numbers
  std::vector<std::string> names;  // of the scenarios
  std::set<std::uint64_t> shards;
  std::uint64_t count = 0;
  for (const std::string& path : options.scenarios) {
    require_regular(path);
    std::ifstream file(path);
    std::string line;
    std::uint64_t at = 1;
    const auto refuse = [&](const std::string& why) {
      return UseError(fmt::format("{}:{}: {}", sim::one_line(path), at, why));
    };
    if (!std::getline(file, line)) throw refuse("cannot read, or empty");
    const std::vector<std::string> words = fields_of(line);
    std::vector<std::uint64_t> values;
    for (std::size_t i = 1; i < words.size(); ++i) {
      values.push_back(number_of(words[i]).value_or(kMaxRuns + 1));
    }
    if (words[0] != kFormat || values.size() != 7 || values[0] == 0 || values[0] > values[1] ||
        values[1] > kMaxRuns || values[2] == 0 || values[2] > kMaxRuns || values[3] == 0 ||
        values[3] > kMaxRuns / values[2] || values[6] > 1) {
      throw refuse("no output of mb4sim regress --shard");
    }
    const Batch own{values[2], values[3], number_of(words[5]).value_or(0), values[5],
                    values[6] != 0};
    if (head.empty()) {
      batch = own;
      head = own.text();
      count = values[1];
      rows.resize(batch.runs());
      names.resize(batch.scenarios);
    }
    if (own.text() != head || values[1] != count) {
      throw refuse("a shard of another batch than " + sim::one_line(options.scenarios[0]));
    }
    if (!shards.insert(values[0]).second) {
      throw refuse(fmt::format("shard {} of {} comes twice", values[0], count));
    }
    const Shard shard(fmt::format("{}/{}", values[0], count));
    for (std::uint64_t index = 0; index < shard.runs(batch.runs()); ++index) {
      ++at;
      const std::uint64_t run = shard.run(index);
      std::getline(file, line);
      const std::vector<std::string> fields = fields_of(line);
      const std::optional<Row> row = Row::from(fields);
      if (!row || number_of(fields[0]) != run || row->seed != batch.seed(run)) {
        throw refuse(fmt::format("no row of run {}", run));
      }
      std::string& name = names[run / batch.seeds];
      if (name.empty()) name = row->scenario;
      if (name != row->scenario) {
        throw refuse(
            fmt::format("run {} has scenario {}, another shard {}", run, row->scenario, name));
      }
      rows[run] = line;
    }
    ++at;
    if (!std::getline(file, line) || line != kEnd) throw refuse("the end of the shard is missing");
  }
  for (std::uint64_t number = 1; number <= count; ++number) {
    if (!shards.contains(number)) {
      throw UseError(fmt::format("--merge: shard {} of {} is missing", number, count));
    }
  }
  if (!options.cover_path.empty() && !batch.cover) {
    throw UseError("--cover: the shards were made without --cover");
  }
  Table table(options);
  table.head();
  for (const std::string& line : rows) {
    const Row row = *Row::from(fields_of(line));
    table.print(row);
    table.count(row);
  }
  table.sums(rows.size());
  return table.finish(true);
}

}  // namespace

int regress_command(const RegressOptions& options) {
  return options.merge ? merge(options) : run_shard(options);
}

}  // namespace mb4::tool
