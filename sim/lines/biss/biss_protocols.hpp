// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The protocols BiSS C and BiSS B of a scenario.
#ifndef MB4SIM_BISS_PROTOCOLS_HPP_
#define MB4SIM_BISS_PROTOCOLS_HPP_

#include "sim/lines/protocols.hpp"

namespace mb4::sim {

extern const Protocol kBissCProtocol;
extern const Protocol kBissBProtocol;

}  // namespace mb4::sim

#endif  // MB4SIM_BISS_PROTOCOLS_HPP_
