// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What has gone wrong in a simulation so far, as JSON: the faults and how they were met, and the
// violations of the host's timing. mb4sim.h describes the keys.
#ifndef MB4SIM_REPORT_HPP_
#define MB4SIM_REPORT_HPP_

#include <string>
#include <vector>

#include "mb4sim/simulator.hpp"
#include "sim/capi/frame_watch.hpp"

namespace mb4::sim {

// `stories`: of the simulator's faults, in their order. Missing ones count as 0 frames.
std::string report_json(Simulator& simulator, const std::vector<FaultStory>& stories);

}  // namespace mb4::sim

#endif  // MB4SIM_REPORT_HPP_
