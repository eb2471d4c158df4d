// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The BiSS C master with N channels on AXI as a master of a scenario.
#ifndef MB4SIM_AXI_MASTER_HPP_
#define MB4SIM_AXI_MASTER_HPP_

#include "sim/masters/master.hpp"

namespace mb4::sim {

extern const Master kAxiMaster;

}  // namespace mb4::sim

#endif  // MB4SIM_AXI_MASTER_HPP_
