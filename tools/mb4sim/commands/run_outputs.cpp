// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/run_outputs.hpp"

#include <string>
#include <utility>
#include <vector>

#include "report/exit_status.hpp"

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

// What would be written, for require_distinct().
std::vector<Output> files_of(const RunOptions& options, const TraceFile& trace) {
  std::vector<Output> outputs;
  for (const auto& [option, path] :
       {std::pair{"--csv", options.csv}, std::pair{"--bus-log", options.bus_log}}) {
    if (path.empty()) continue;
    outputs.push_back({option, path});
    outputs.push_back({option, partial_path(path)});
  }
  outputs.insert(outputs.end(), trace.outputs().begin(), trace.outputs().end());
  return outputs;
}

}  // namespace

RunOutputs open_outputs(const RunOptions& options, const sim::Scenario& scenario) {
  check_options(options);
  RunOutputs outputs{TraceFile(options.trace, options.scenario, scenario), nullptr, nullptr};
  require_distinct(files_of(options, outputs.trace), inputs_of(options.scenario, scenario));
  if (!options.csv.empty()) outputs.csv = std::make_unique<OutputFile>(options.csv);
  if (!options.bus_log.empty()) outputs.bus_log = std::make_unique<OutputFile>(options.bus_log);
  return outputs;
}

}  // namespace mb4::tool
