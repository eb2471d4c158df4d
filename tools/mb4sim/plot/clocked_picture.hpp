// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The pictures of the protocols on clocked lines.
#ifndef MB4SIM_TOOL_CLOCKED_PICTURE_HPP_
#define MB4SIM_TOOL_CLOCKED_PICTURE_HPP_

#include <span>

#include "plot/pictures.hpp"

namespace mb4::tool {

std::span<const PictureDecoder> clocked_pictures();

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_CLOCKED_PICTURE_HPP_
