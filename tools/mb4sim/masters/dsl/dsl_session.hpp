// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#ifndef MB4SIM_TOOL_DSL_SESSION_HPP_
#define MB4SIM_TOOL_DSL_SESSION_HPP_

#include "session.hpp"

namespace mb4::tool {

extern const MasterSupport kDslSupport;
extern const MasterSupport kDslModelSupport;

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_DSL_SESSION_HPP_
