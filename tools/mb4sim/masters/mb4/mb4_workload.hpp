// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The workloads of the iC-MB4: A to G and K of workload.hpp.
#ifndef MB4SIM_TOOL_MB4_WORKLOAD_HPP_
#define MB4SIM_TOOL_MB4_WORKLOAD_HPP_

#include <span>

#include "workload.hpp"

namespace mb4::tool {

std::span<const WorkloadInfo> mb4_workloads();

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_MB4_WORKLOAD_HPP_
