// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs jobs in worker processes. It uses processes and not threads: a job that crashes is one
// failed job, and jobs share nothing that could make a result depend on other jobs.
#ifndef MB4SIM_TOOL_WORKER_POOL_HPP_
#define MB4SIM_TOOL_WORKER_POOL_HPP_

#include <cstdint>
#include <functional>
#include <string>

namespace mb4::tool {

// Number of processors that this process may use, 1 or more.
unsigned usable_cores();

// Runs `job` for 0 to count - 1 in at most `workers` (1 or more) processes at a time and hands what
// they return to `result`, in the order of their numbers; an empty text if a worker has died.
// Throws UseError if no process can be started, Interrupted if a signal ends the command. In every
// case no worker runs after the call.
void run_jobs(std::uint64_t count, unsigned workers,
              const std::function<std::string(std::uint64_t)>& job,
              const std::function<void(const std::string&)>& result);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_WORKER_POOL_HPP_
