// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "workload.hpp"

#include <algorithm>
#include <vector>

#include "masters/mb4/mb4_workload.hpp"
#if MB4SIM_WITH_AXI
#include "masters/axi/axi_workload.hpp"
#endif
#if MB4SIM_WITH_DSL
#include "masters/dsl/dsl_workload.hpp"
#endif

namespace mb4::tool {

// The only list of the masters whose speed is measured.
std::span<const WorkloadInfo> workloads() {
  static const std::vector<WorkloadInfo> all = [] {
    std::vector<WorkloadInfo> found;
    const auto add = [&found](std::span<const WorkloadInfo> those) {
      found.insert(found.end(), those.begin(), those.end());
    };
    add(mb4_workloads());
#if MB4SIM_WITH_AXI
    add(axi_workloads());
#endif
#if MB4SIM_WITH_DSL
    add(dsl_workloads());
#endif
    std::ranges::sort(found, {}, &WorkloadInfo::letter);
    return found;
  }();
  return all;
}

}  // namespace mb4::tool
