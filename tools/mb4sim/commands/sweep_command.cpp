// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "chip_setup.hpp"
#include "commands/commands.hpp"
#include "mb4/device.hpp"
#include "mb4sim/simulator.hpp"
#include "number_list.hpp"
#include "report/exit_status.hpp"
#include "report/output_file.hpp"
#include "report/sweep_report.hpp"
#include "report/trace_file.hpp"
#include "sim/core/one_line.hpp"
#include "sim/core/random.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim_bus.hpp"

namespace mb4::tool {
namespace {

constexpr double kMaxDelayNs = 1e6;
constexpr double kMaxJitterPercent = 1000;
constexpr std::uint64_t kMaxPoints = 1'000'000;
constexpr unsigned kMaxCode = 31;

std::vector<unsigned> freqs_codes(const std::string& text, const sim::Scenario& scenario) {
  if (text.empty()) {
    return {sim::freqs_code(scenario.chip.system_hz(), scenario.host.ma_hz).value_or(0)};
  }
  std::vector<unsigned> codes;
  if (text == "all") {
    for (unsigned code = 0; code <= kMaxCode; ++code) {
      if (sim::ma_divider(code) != 0) codes.push_back(code);
    }
    return codes;
  }
  for (const long long value : number_list(text, {"--freqs", 0, kMaxCode, true})) {
    const auto code = static_cast<unsigned>(value / 1000);
    if (sim::ma_divider(code) == 0) {
      throw UseError(fmt::format("--freqs: Table 35 does not permit code {}", code));
    }
    codes.push_back(code);
  }
  return codes;
}

SweepPoint measure(const sim::Scenario& scenario, const Config& config, std::uint64_t frames,
                   std::uint64_t seed) {
  sim::SimulatorOptions options;
  options.seed = seed;
  sim::Simulator simulator(scenario, options);
  SimBus bus(simulator);
  SimClock clock(simulator);
  Device device(bus, clock);
  std::vector<ConnectedSlave> slaves = connected_slaves(scenario);
  std::erase_if(slaves, [&](const ConnectedSlave& slave) {
    return !is_in(sensors(config), static_cast<std::uint8_t>(slave.number));
  });
  SweepPoint point;
  point.words = frames * slaves.size();
  if (const Result<void> configured = device.configure(config); !configured) {
    throw UseError("cannot configure the chip: " + describe(configured.info()));
  }
  for (std::uint64_t i = 0; i < frames; ++i) {
    Frame frame;
    const Result<void> read = device.read_all(frame);
    for (const ConnectedSlave& slave : slaves) {
      if (!read || !frame[slave.number]) {
        ++point.flagged;
      } else if (const auto sent = std::as_const(simulator).slave(slave.number)->sent_word();
                 sent && *sent != frame[slave.number]->raw) {
        ++point.wrong;
      }
    }
  }
  return point;
}

// One chip for each point, all with random choices of their own.
SweepPlane sweep_plane(sim::Scenario scenario, unsigned freqs, const Sweep& sweep) {
  SweepPlane plane;
  plane.freqs = freqs;
  plane.ma_hz = sim::ma_frequency(scenario.chip.system_hz(), freqs);
  scenario.host.ma_hz = plane.ma_hz;
  const double period_ps =
      1e12 * sim::ma_divider(freqs) / static_cast<double>(scenario.chip.system_hz());
  std::uint64_t part = std::uint64_t{freqs} << 32U;
  for (const long long delay : sweep.delays_ps) {
    std::vector<SweepPoint> row;
    for (const long long jitter : sweep.jitters_mpercent) {
      for (sim::ChannelConfig& channel : scenario.channels) {
        channel.delay = static_cast<sim::Time>(delay);
        channel.cable.sl.jitter =
            static_cast<sim::Time>(period_ps * static_cast<double>(jitter) / 100'000);
      }
      row.push_back(measure(scenario, make_config(scenario), sweep.frames,
                            sim::derive_seed(sweep.seed, ++part)));
    }
    plane.points.push_back(std::move(row));
  }
  return plane;
}

}  // namespace

int sweep_command(const SweepOptions& options) {
  const sim::Scenario scenario = load_chip_scenario(options.scenario);
  Sweep sweep;
  sweep.scenario = sim::one_line(options.scenario);
  sweep.seed = options.seed.value_or(scenario.seed);
  sweep.frames = options.frames;
  sweep.delays_ps = number_list(options.delays, {"--delays", 0, kMaxDelayNs});
  sweep.jitters_mpercent = number_list(options.jitters, {"--jitters", 0, kMaxJitterPercent});
  const std::vector<unsigned> codes = freqs_codes(options.freqs, scenario);
  const std::uint64_t points =
      codes.size() * sweep.delays_ps.size() * sweep.jitters_mpercent.size();
  if (points > kMaxPoints) {
    throw UseError(fmt::format("{} points are more than {}", points, kMaxPoints));
  }
  for (const unsigned code : codes) {
    sim::Scenario each = scenario;
    each.host.ma_hz = sim::ma_frequency(scenario.chip.system_hz(), code);
    make_config(each);
  }
  std::vector<Output> outputs;
  for (const auto& [name, path] : {std::pair{"--csv", options.csv}, {"--svg", options.svg}}) {
    if (path.empty()) continue;
    outputs.push_back({name, path});
    outputs.push_back({name, partial_path(path)});
  }
  require_distinct(outputs, inputs_of(options.scenario, scenario));
  std::unique_ptr<OutputFile> csv;
  std::unique_ptr<OutputFile> svg;
  if (!options.csv.empty()) csv = std::make_unique<OutputFile>(options.csv);
  if (!options.svg.empty()) svg = std::make_unique<OutputFile>(options.svg);

  for (const unsigned code : codes) sweep.planes.push_back(sweep_plane(scenario, code, sweep));
  fmt::print("{}", sweep_text(sweep));
  if (csv != nullptr) csv->commit(sweep_csv(sweep));
  if (svg != nullptr) svg->commit(sweep_svg(sweep));
  return sweep.within_i305() ? kGood : kBad;
}

}  // namespace mb4::tool
