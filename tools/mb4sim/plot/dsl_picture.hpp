// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture of an H-frame of DSL: what the line shows the master, who drives it, the fields of
// both ends, and where the master samples.
#ifndef MB4SIM_TOOL_DSL_PICTURE_HPP_
#define MB4SIM_TOOL_DSL_PICTURE_HPP_

#include "plot/pictures.hpp"

namespace mb4::tool {

// The simulator has the masters "dsl" and "dsl-model".
extern const PictureDecoder kDslPicture;

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_DSL_PICTURE_HPP_
