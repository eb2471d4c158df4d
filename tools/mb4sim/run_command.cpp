// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "chip_setup.hpp"
#include "commands.hpp"
#include "exit_status.hpp"
#include "frame_report.hpp"
#include "mb4/device.hpp"
#include "mb4sim/scenario.hpp"
#include "mb4sim/simulator.hpp"
#include "mb4sim/wave_view.hpp"
#include "output_file.hpp"
#include "sim_bus.hpp"

namespace mb4::tool {
namespace {

// "x.fst" -> "x.gtkw"; other names get the ending added.
std::string view_path(const std::string& trace) {
  constexpr std::string_view kEnding = ".fst";
  const bool fst = trace.ends_with(kEnding);
  return trace.substr(0, trace.size() - (fst ? kEnding.size() : 0)) + ".gtkw";
}

// Refuses outputs that would overwrite something they must not, before anything is written.
void check_outputs(const RunOptions& options, const sim::Scenario& scenario) {
  std::vector<std::string> inputs{options.scenario};
  for (const sim::ChannelConfig& channel : scenario.channels) {
    for (const sim::SlaveConfig& slave : channel.slaves) {
      if (!slave.file.empty()) inputs.push_back(slave.file);
    }
  }
  std::vector<Output> outputs;
  if (!options.csv.empty()) {
    outputs.push_back({"--csv", options.csv});
    outputs.push_back({"--csv", partial_path(options.csv)});
  }
  if (!options.bus_log.empty()) {
    outputs.push_back({"--bus-log", options.bus_log});
    outputs.push_back({"--bus-log", partial_path(options.bus_log)});
  }
  if (!options.trace.empty()) {
    // The FST writer keeps a second file while it works.
    const std::string work = link_target(options.trace) + ".hier";
    for (const std::string& path : {options.trace, work, view_path(options.trace)}) {
      require_regular(path);
      outputs.push_back({"--trace", path});
    }
  }
  require_distinct(outputs, inputs);
}

}  // namespace

int run_command(const RunOptions& options) {
  const sim::Scenario scenario = sim::load_scenario(options.scenario);
  const Config config = make_config(scenario);
  // Everything is checked before the first file is touched.
  check_outputs(options, scenario);
  std::unique_ptr<OutputFile> csv;
  if (!options.csv.empty()) csv = std::make_unique<OutputFile>(options.csv);
  std::unique_ptr<OutputFile> bus_log;
  if (!options.bus_log.empty()) bus_log = std::make_unique<OutputFile>(options.bus_log);
  std::string bus_lines;
  sim::SimulatorOptions sim_options;
  sim_options.seed = options.seed;
  if (!options.trace.empty()) {
    require_writable(options.trace);
    require_writable(view_path(options.trace));
    // The FST writer would replace a link instead of following it.
    sim_options.trace_path = link_target(options.trace);
  }

  FrameReport report(scenario);
  RunSummary summary;
  Result<void> configured;
  // The waveform file is complete when the simulator has gone, also after an assertion.
  const auto write_view = [&] {
    if (!options.trace.empty()) sim::write_wave_view(options.trace, view_path(options.trace));
  };
  try {
    sim::Simulator simulator(scenario, sim_options);
    summary.seed = simulator.seed();
    SimBus bus(simulator, bus_log != nullptr ? &bus_lines : nullptr);
    SimClock clock(simulator);
    Device device(bus, clock);
    configured = device.configure(config);
    if (configured && !options.json) fmt::print("{}", report.table_header());
    for (std::uint64_t number = 1; configured && number <= options.frames; ++number) {
      Frame frame;
      const Result<void> read = device.read_all(frame);
      for (const ConnectedSlave& slave : connected_slaves(scenario)) {
        // What is wrong with the whole frame is wrong with each slave.
        report.add(number, simulator.now(), slave.number,
                   read ? frame[slave.number] : Result<Reading>(read.info()));
        if (!options.json) fmt::print("{}", report.table_row());
      }
    }
    summary.time = simulator.now();
    summary.clocks = simulator.clk_cycles();
  } catch (const sim::ModelStopped&) {
    write_view();
    throw;
  }
  write_view();
  if (!configured) {
    fmt::print(stderr, "mb4sim: cannot configure the chip: {}\n", describe(configured.info()));
    return kBad;
  }
  if (options.json) {
    fmt::print("{}", report.json(options.scenario, summary));
  } else {
    fmt::print("{}", report.table_summary(summary));
  }
  if (bus_log != nullptr) bus_log->commit(bus_lines);
  if (csv != nullptr) csv->commit(report.csv());
  return report.bad() == 0 ? kGood : kBad;
}

}  // namespace mb4::tool
