// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames of biss_axi, one after the other: H and I of workload.hpp.
#ifndef MB4SIM_TOOL_AXI_WORKLOAD_HPP_
#define MB4SIM_TOOL_AXI_WORKLOAD_HPP_

#include <span>

#include "workload.hpp"

namespace mb4::tool {

// Encoders of 26 bits with nE and nW, axi_aclk = 100 MHz, MA = 10 MHz. The internal sample
// clock has 1 MHz, so a frame begins within 1 us after the last encoder is ready. The cables have
// 5 m, 10 m ...
std::span<const WorkloadInfo> axi_workloads();

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_AXI_WORKLOAD_HPP_
