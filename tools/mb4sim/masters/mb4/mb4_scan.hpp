// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The scan of a channel of the iC-MB4: MasterSupport::scan.
#ifndef MB4SIM_TOOL_MB4_SCAN_HPP_
#define MB4SIM_TOOL_MB4_SCAN_HPP_

#include "session.hpp"

namespace mb4::tool {

ScanResult scan_mb4(const sim::Scenario& scenario, const ScanRequest& request);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_MB4_SCAN_HPP_
