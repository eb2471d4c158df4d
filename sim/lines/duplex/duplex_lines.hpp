// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The kind of line with one wire that both ends drive. A scenario gives a channel of it, beside the
// keys that lines of every kind have: jitter_ns, skew_ns, glitches_per_s of the way to the master,
// out_jitter_ns and so on of the way to the device, glitch_ns, enable_ns (30) and disable_ns (40)
// of both transceivers, answer_errors and master_errors: the chance that a bit is wrong.
#ifndef MB4SIM_DUPLEX_LINES_HPP_
#define MB4SIM_DUPLEX_LINES_HPP_

#include "sim/lines/line_kind.hpp"

namespace mb4::sim {

extern const LineKind kDuplexLines;

}  // namespace mb4::sim

#endif  // MB4SIM_DUPLEX_LINES_HPP_
