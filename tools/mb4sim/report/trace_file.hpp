// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The waveform file of a command's --trace and the view beside it.
#ifndef MB4SIM_TOOL_TRACE_FILE_HPP_
#define MB4SIM_TOOL_TRACE_FILE_HPP_

#include <optional>
#include <string>
#include <vector>

#include "report/output_file.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

// Files that a scenario consists of, itself at `path` first.
std::vector<std::string> inputs_of(const std::string& path, const sim::Scenario& scenario);

class TraceFile {
 public:
  // `option`: the file's name, empty for none. Throws UseError if it, its view or the file that the
  // FST writer keeps beside it cannot be written or is a file of the scenario.
  TraceFile(const std::string& option, const std::string& scenario_path,
            const sim::Scenario& scenario);

  // For SimulatorOptions::trace_path.
  std::optional<std::string> path() const;
  // The files that are written, for require_distinct().
  const std::vector<Output>& outputs() const { return outputs_; }
  // Writes the view. Destroy the simulator first: only then is the waveform complete.
  // `marker`: where GTKWave's marker stands, else at the beginning.
  void write_view(std::optional<sim::Time> marker = {}) const;

 private:
  std::string path_;
  const sim::Master* master_;
  sim::HostConfig host_;
  std::vector<Output> outputs_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_TRACE_FILE_HPP_
