// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The files that `mb4sim run` writes.
#ifndef MB4SIM_TOOL_RUN_OUTPUTS_HPP_
#define MB4SIM_TOOL_RUN_OUTPUTS_HPP_

#include <memory>

#include "commands/commands.hpp"
#include "report/output_file.hpp"
#include "report/trace_file.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::tool {

// Null where no such file is wanted.
struct RunOutputs {
  TraceFile trace;
  std::unique_ptr<OutputFile> csv;
  std::unique_ptr<OutputFile> bus_log;
};

// Opens them, and checks that the waveform and its view can be written. Throws UseError if the
// options do not fit together or an output would overwrite something it must not; nothing has been
// written then.
RunOutputs open_outputs(const RunOptions& options, const sim::Scenario& scenario);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_RUN_OUTPUTS_HPP_
