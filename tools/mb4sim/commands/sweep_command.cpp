// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "commands/commands.hpp"
#include "mb4sim/model_stopped.hpp"
#include "number_list.hpp"
#include "report/exit_status.hpp"
#include "report/output_file.hpp"
#include "report/picture_file.hpp"
#include "report/progress.hpp"
#include "report/sweep_report.hpp"
#include "report/trace_file.hpp"
#include "scenario_argument.hpp"
#include "session.hpp"
#include "sim/core/one_line.hpp"
#include "sim/core/random.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/scenario/scenario.hpp"
#include "worker_pool.hpp"

namespace mb4::tool {
namespace {

constexpr double kMaxDelayNs = 1e6;
constexpr double kMaxJitterPercent = 1000;
constexpr double kMaxSkewPercent = 100;
constexpr std::uint64_t kMaxPoints = 1'000'000;
std::vector<unsigned> all_codes(const SweepCodes& all, std::uint64_t clk_hz) {
  std::vector<unsigned> codes;
  for (unsigned code = 0; code <= all.most; ++code) {
    if (all.divider(clk_hz, code) != 0) codes.push_back(code);
  }
  return codes;
}

std::vector<unsigned> codes_of(const std::string& text, const sim::Scenario& scenario) {
  const SweepCodes& all = support_of(scenario).sweep;
  const std::uint64_t clk_hz = scenario.chip.system_hz();
  if (text == "all") return all_codes(all, clk_hz);
  if (text.empty()) {
    if (all.present != nullptr) return {all.present(scenario)};
    for (const unsigned code : all_codes(all, clk_hz)) {
      if (clk_hz / all.divider(clk_hz, code) == scenario.host.ma_hz) return {code};
    }
    throw UseError(fmt::format("no {} gives the scenario's {} Hz; name codes with --freqs",
                               all.name, scenario.host.ma_hz));
  }
  std::vector<unsigned> codes;
  for (const long long value :
       number_list(text, {"--freqs", 0, static_cast<double>(all.most), true})) {
    const auto code = static_cast<unsigned>(value / 1000);
    if (all.divider(clk_hz, code) == 0) {
      throw UseError(fmt::format("--freqs: {} {}", all.refuses, code));
    }
    codes.push_back(code);
  }
  return codes;
}

// Without --skews that of the scenario.
std::vector<std::optional<long long>> skews_of(const std::string& text,
                                               const sim::Scenario& scenario) {
  if (text.empty()) return {std::nullopt};
  if (support_of(scenario).sweep.set_jitter != nullptr) {
    throw UseError("--skews: the line of this master has no SL");
  }
  const std::vector<long long> list =
      number_list(text, {"--skews", -kMaxSkewPercent, kMaxSkewPercent});
  return {list.begin(), list.end()};
}

void set_code(sim::Scenario& scenario, unsigned code) {
  const SweepCodes& all = support_of(scenario).sweep;
  const std::uint64_t clk_hz = scenario.chip.system_hz();
  if (all.set != nullptr) {
    all.set(scenario, code);
  } else {
    scenario.host.ma_hz = clk_hz / all.divider(clk_hz, code);
  }
}

SweepPoint measure(const sim::Scenario& scenario, std::uint64_t frames, std::uint64_t seed) {
  SessionOptions options;
  options.actuators = false;
  options.simulator.seed = seed;
  const MasterSupport& support = support_of(scenario);
  const std::unique_ptr<Session> session = support.open(scenario, options);
  const std::string why = session->configure();
  // A master that trains its line cannot do so at every point.
  if (!why.empty() && !support.trains) {
    throw UseError(fmt::format("{}: {}", support.not_begun, why));
  }
  SweepPoint point;
  point.words = point.flagged = session->failed_starts();
  if (!why.empty()) {
    point.words = point.flagged = frames * session->slaves().size();
    return point;
  }
  std::uint64_t number = 0;
  while (number < support.sweep.unmeasured) session->read(++number);
  while (number < support.sweep.unmeasured + frames) {
    const SessionFrame frame = session->read(++number);
    for (std::size_t i = 0; i < frame.results.size(); ++i) {
      ++point.words;
      if (frame.kind(i) == SlaveOutcome::Kind::kFlagged) ++point.flagged;
      if (frame.kind(i) == SlaveOutcome::Kind::kWrong) ++point.wrong;
    }
  }
  return point;
}

// A plane without its points.
SweepPlane empty_plane(const sim::Scenario& scenario, unsigned code,
                       std::optional<long long> skew) {
  const std::uint64_t clk_hz = scenario.chip.system_hz();
  const SweepCodes& all = support_of(scenario).sweep;
  SweepPlane plane;
  plane.code = code;
  plane.skew_mpercent = skew;
  plane.ma_hz = clk_hz / all.divider(clk_hz, code);
  if (all.allowed != nullptr) plane.allowed_mpercent = all.allowed(code);
  if (all.title != nullptr) plane.title = all.title(code);
  return plane;
}

// Where a point stands: its plane, delay and jitter.
struct Place {
  std::size_t plane, delay, jitter;
};

// Each point has a chip and random choices of its own.
SweepPoint measure_at(sim::Scenario scenario, const Sweep& sweep, const Place& place) {
  const std::uint64_t clk_hz = scenario.chip.system_hz();
  const SweepCodes& all = support_of(scenario).sweep;
  const SweepPlane& plane = sweep.planes[place.plane];
  const unsigned code = plane.code;
  const double period_ps = 1e12 * all.divider(clk_hz, code) / static_cast<double>(clk_hz);
  set_code(scenario, code);
  const auto jitter = static_cast<double>(sweep.jitters_mpercent[place.jitter]);
  const auto time = static_cast<sim::Time>(period_ps * jitter / 100'000);
  for (sim::ChannelConfig& channel : scenario.channels) {
    channel.cable->delay = static_cast<sim::Time>(sweep.delays_ps[place.delay]);
    if (all.set_jitter != nullptr) {
      all.set_jitter(*channel.cable, time);
    } else {
      channel.cable.as<sim::ClockedConfig>().sl.jitter = time;
      if (plane.skew_mpercent) {
        channel.cable.as<sim::ClockedConfig>().sl.skew = static_cast<std::int64_t>(
            period_ps * static_cast<double>(*plane.skew_mpercent) / 100'000);
      }
    }
  }
  const std::uint64_t skew = static_cast<std::uint64_t>(plane.skew_mpercent.value_or(0)) << 40U;
  const std::uint64_t part = skew + (std::uint64_t{code} << 32U) +
                             place.delay * sweep.jitters_mpercent.size() + place.jitter + 1;
  return measure(scenario, sweep.frames, sim::derive_seed(sweep.seed, part));
}

// What a worker returns: the counts, or why there are none.
std::string point_text(const sim::Scenario& scenario, const Sweep& sweep, const Place& place) {
  try {
    const SweepPoint point = measure_at(scenario, sweep, place);
    return fmt::format("{} {} {}", point.words, point.flagged, point.wrong);
  } catch (const sim::ModelStopped& error) {
    return fmt::format("stopped {}", error.what());
  } catch (const std::runtime_error& error) {
    return fmt::format("error {}", error.what());
  }
}

SweepPoint point_of(const std::string& text) {
  const std::string rest = text.substr(std::min(text.find(' '), text.size() - 1) + 1);
  if (text.starts_with("stopped")) throw sim::ModelStopped(rest);
  if (text.starts_with("error")) throw UseError(rest);
  std::istringstream in(text);
  SweepPoint point;
  if (!(in >> point.words >> point.flagged >> point.wrong)) {
    throw sim::ModelStopped("a worker has died");
  }
  return point;
}

// Fills the planes. The result does not depend on the number of jobs.
void measure_all(const sim::Scenario& scenario, std::uint64_t jobs, Sweep& sweep) {
  const std::size_t jitters = sweep.jitters_mpercent.size();
  const std::size_t in_plane = sweep.delays_ps.size() * jitters;
  const std::uint64_t count = sweep.planes.size() * in_plane;
  const auto place_of = [&](std::uint64_t index) {
    return Place{index / in_plane, index % in_plane / jitters, index % jitters};
  };
  for (SweepPlane& plane : sweep.planes) plane.points.resize(sweep.delays_ps.size());
  Progress progress(count);
  std::uint64_t done = 0;
  run_jobs(
      count, static_cast<unsigned>(jobs),
      [&](std::uint64_t index) { return point_text(scenario, sweep, place_of(index)); },
      [&](const std::string& text) {
        const Place place = place_of(done);
        sweep.planes[place.plane].points[place.delay].push_back(point_of(text));
        progress.update(++done);
      });
}

}  // namespace

int sweep_command(const SweepOptions& options) {
  const sim::Scenario scenario = open_scenario(options.scenario);
  const MasterSupport& support = support_of(scenario);
  if (support.sweep.divider == nullptr) {
    throw UseError(fmt::format("{}: the master \"{}\" has no codes of a frequency to sweep",
                               sim::one_line(options.scenario), scenario.master->type));
  }
  Sweep sweep;
  sweep.code_name = support.sweep.name;
  sweep.jitter_item = support.sweep.jitter_item;
  sweep.period = support.sweep.period;
  sweep.scenario = sim::one_line(options.scenario);
  sweep.seed = options.seed.value_or(scenario.seed);
  sweep.frames = options.frames;
  sweep.delays_ps = number_list(options.delays, {"--delays", 0, kMaxDelayNs});
  sweep.jitters_mpercent = number_list(options.jitters, {"--jitters", 0, kMaxJitterPercent});
  const std::vector<unsigned> codes = codes_of(options.freqs, scenario);
  const std::vector<std::optional<long long>> skews = skews_of(options.skews, scenario);
  const std::uint64_t points =
      codes.size() * skews.size() * sweep.delays_ps.size() * sweep.jitters_mpercent.size();
  if (points > kMaxPoints) {
    throw UseError(fmt::format("{} points are more than {}", points, kMaxPoints));
  }
  for (const unsigned code : codes) {
    sim::Scenario each = scenario;
    set_code(each, code);
    support.check(each);
  }
  std::vector<Output> outputs;
  for (const auto& [name, path] : {std::pair{"--csv", options.csv}, {"--svg", options.svg}}) {
    if (path.empty()) continue;
    outputs.push_back({name, path});
    outputs.push_back({name, partial_path(path)});
  }
  require_distinct(outputs, inputs_of(options.scenario, scenario));
  std::unique_ptr<OutputFile> csv;
  std::unique_ptr<PictureFile> svg;
  if (!options.csv.empty()) csv = std::make_unique<OutputFile>(options.csv);
  if (!options.svg.empty()) svg = std::make_unique<PictureFile>(options.svg);

  for (const unsigned code : codes) {
    for (const auto& skew : skews) sweep.planes.push_back(empty_plane(scenario, code, skew));
  }
  measure_all(scenario, options.jobs, sweep);
  fmt::print("{}", options.json ? sweep_json(sweep) : sweep_text(sweep));
  if (csv != nullptr) csv->commit(sweep_csv(sweep));
  if (svg != nullptr) svg->commit(sweep_svg(sweep));
  return sweep.within_allowed() ? kGood : kBad;
}

}  // namespace mb4::tool
