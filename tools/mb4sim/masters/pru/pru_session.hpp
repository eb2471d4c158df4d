// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_pru with the host that drives it in simulation.
#ifndef MB4SIM_TOOL_PRU_SESSION_HPP_
#define MB4SIM_TOOL_PRU_SESSION_HPP_

#include "session.hpp"

namespace mb4::tool {

extern const MasterSupport kPruSupport;

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_PRU_SESSION_HPP_
