// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The kind of line of BiSS and SSI: MA and MO out, SL back, a chain of slaves.
#ifndef MB4SIM_CLOCKED_LINES_HPP_
#define MB4SIM_CLOCKED_LINES_HPP_

#include "sim/lines/line_kind.hpp"

namespace mb4::sim {

extern const LineKind kClockedLines;

}  // namespace mb4::sim

#endif  // MB4SIM_CLOCKED_LINES_HPP_
