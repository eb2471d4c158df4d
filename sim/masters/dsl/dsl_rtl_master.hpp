// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// [master] type = "dsl": dsl_axil, the master of DSL in RTL, as a master of a scenario.
#ifndef MB4SIM_DSL_DSL_RTL_MASTER_HPP_
#define MB4SIM_DSL_DSL_RTL_MASTER_HPP_

#include "sim/masters/master.hpp"

namespace mb4::sim {

extern const Master kDslMaster;

}  // namespace mb4::sim

#endif  // MB4SIM_DSL_DSL_RTL_MASTER_HPP_
