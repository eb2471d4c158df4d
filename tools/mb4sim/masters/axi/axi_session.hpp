// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Sessions with biss_axi, the BiSS C master with N channels on AXI.
#ifndef MB4SIM_TOOL_AXI_SESSION_HPP_
#define MB4SIM_TOOL_AXI_SESSION_HPP_

#include "session.hpp"

namespace mb4::tool {

extern const MasterSupport kAxiSupport;

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_AXI_SESSION_HPP_
