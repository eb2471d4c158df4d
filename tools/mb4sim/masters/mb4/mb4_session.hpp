// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Sessions with the iC-MB4.
#ifndef MB4SIM_TOOL_MB4_SESSION_HPP_
#define MB4SIM_TOOL_MB4_SESSION_HPP_

#include "session.hpp"

namespace mb4::tool {

extern const MasterSupport kMb4Support;

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_MB4_SESSION_HPP_
