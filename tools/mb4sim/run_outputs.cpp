// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "run_outputs.hpp"

#include <string_view>
#include <vector>

#include "exit_status.hpp"

namespace mb4::tool {
namespace {

void check_options(const RunOptions& options) {
  const auto need_trace = [&](const char* option) {
    if (options.trace.empty()) throw UseError(std::string(option) + ": needs --trace");
  };
  if (options.trace_from_us) need_trace("--trace-from");
  if (options.trace_to_us) need_trace("--trace-to");
  if (options.trace_error_us) need_trace("--trace-error");
  if (options.trace_error_us && (options.trace_from_us || options.trace_to_us)) {
    throw UseError("--trace-error: not together with --trace-from or --trace-to");
  }
  if (options.trace_from_us && options.trace_to_us &&
      *options.trace_to_us < *options.trace_from_us) {
    throw UseError("--trace-to: is before --trace-from");
  }
}

// Refuses outputs that would overwrite something they must not.
void check_files(const RunOptions& options, const sim::Scenario& scenario) {
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
  require_distinct(outputs, input_files(options.scenario, scenario));
}

}  // namespace

RunOutputs open_outputs(const RunOptions& options, const sim::Scenario& scenario) {
  check_options(options);
  check_files(options, scenario);
  RunOutputs outputs;
  if (!options.csv.empty()) outputs.csv = std::make_unique<OutputFile>(options.csv);
  if (!options.bus_log.empty()) outputs.bus_log = std::make_unique<OutputFile>(options.bus_log);
  if (!options.trace.empty()) {
    require_writable(options.trace);
    require_writable(view_path(options.trace));
  }
  return outputs;
}

std::string trace_target(const RunOptions& options) { return link_target(options.trace); }

std::string view_path(const std::string& trace) {
  constexpr std::string_view kEnding = ".fst";
  const bool fst = trace.ends_with(kEnding);
  return trace.substr(0, trace.size() - (fst ? kEnding.size() : 0)) + ".gtkw";
}

std::vector<std::string> input_files(const std::string& path, const sim::Scenario& scenario) {
  std::vector<std::string> files{path};
  for (const sim::ChannelConfig& channel : scenario.channels) {
    for (const sim::SlaveConfig& slave : channel.slaves) {
      if (!slave.file.empty()) files.push_back(slave.file);
    }
  }
  return files;
}

}  // namespace mb4::tool
