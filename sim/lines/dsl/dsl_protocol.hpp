// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Encoders with DSL in a scenario: protocol = "dsl".
#ifndef MB4SIM_DSL_PROTOCOL_HPP_
#define MB4SIM_DSL_PROTOCOL_HPP_

#include "sim/lines/protocols.hpp"

namespace mb4::sim {

extern const Protocol kDslProtocol;

}  // namespace mb4::sim

#endif  // MB4SIM_DSL_PROTOCOL_HPP_
