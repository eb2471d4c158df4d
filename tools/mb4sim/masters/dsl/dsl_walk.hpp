// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The resources of an encoder with DSL, as a host reads them by messages.
#ifndef MB4SIM_TOOL_DSL_WALK_HPP_
#define MB4SIM_TOOL_DSL_WALK_HPP_

#include "session.hpp"

namespace mb4::tool {

// For MasterSupport::walk, of either master.
EncoderTree walk_dsl(const sim::Scenario& scenario);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_DSL_WALK_HPP_
