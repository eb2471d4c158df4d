// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The iC-MB4 as a master of a scenario.
#ifndef MB4SIM_MB4_MASTER_HPP_
#define MB4SIM_MB4_MASTER_HPP_

#include "sim/masters/master.hpp"

namespace mb4::sim {

extern const Master kMb4Master;

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_MASTER_HPP_
