// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames of dsl_axil, one after the other: J of workload.hpp.
#ifndef MB4SIM_TOOL_DSL_WORKLOAD_HPP_
#define MB4SIM_TOOL_DSL_WORKLOAD_HPP_

#include <span>

#include "workload.hpp"

namespace mb4::tool {

// An encoder of 32 bits on 20 m of cable, linked; nobody reads. 75 MHz, the bus has the same clock.
std::span<const WorkloadInfo> dsl_workloads();

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_DSL_WORKLOAD_HPP_
