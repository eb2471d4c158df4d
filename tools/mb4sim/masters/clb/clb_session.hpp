// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_clb with the host that drives it in simulation.
#ifndef MB4SIM_TOOL_CLB_SESSION_HPP_
#define MB4SIM_TOOL_CLB_SESSION_HPP_

#include "session.hpp"

namespace mb4::tool {

extern const MasterSupport kClbSupport;

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_CLB_SESSION_HPP_
