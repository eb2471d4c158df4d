// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a picture says of a stretch of a signal.
#ifndef MB4SIM_TOOL_FIELD_HPP_
#define MB4SIM_TOOL_FIELD_HPP_

#include <string>
#include <vector>

#include "sim/core/time.hpp"

namespace mb4::tool {

enum class FieldKind { kFraming, kControl, kData, kFlag, kCrc, kRest };

// A stretch of a signal with a meaning.
struct Field {
  sim::Time from = 0;
  sim::Time to = 0;
  FieldKind kind = FieldKind::kFraming;
  std::vector<std::string> labels;  // the same thing in more and in fewer words
  bool bad = false;                 // the check has failed
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_FIELD_HPP_
