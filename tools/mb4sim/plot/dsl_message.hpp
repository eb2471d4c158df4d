// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture of a message of DSL: a cell is an H-frame, with the symbol that M_PAR and S_PAR have
// in it, and the bytes that the nibbles make.
#ifndef MB4SIM_TOOL_DSL_MESSAGE_HPP_
#define MB4SIM_TOOL_DSL_MESSAGE_HPP_

#include <optional>
#include <vector>

#include "plot/dsl_decode.hpp"
#include "plot/pictures.hpp"

namespace mb4::tool {

// Nothing if no frame has a nibble.
std::optional<Picture> dsl_message_picture(const std::vector<DslExchange>& frames);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_DSL_MESSAGE_HPP_
