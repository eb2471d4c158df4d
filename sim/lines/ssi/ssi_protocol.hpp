// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The protocol SSI of a scenario.
#ifndef MB4SIM_SSI_PROTOCOL_HPP_
#define MB4SIM_SSI_PROTOCOL_HPP_

#include "sim/lines/protocols.hpp"

namespace mb4::sim {

extern const Protocol kSsiProtocol;

}  // namespace mb4::sim

#endif  // MB4SIM_SSI_PROTOCOL_HPP_
