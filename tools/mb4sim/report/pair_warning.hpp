// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Warns about a scenario with channel 2 when the host uses the pins of channel 2 for another
// purpose by CFGIF.
#ifndef MB4SIM_TOOL_PAIR_WARNING_HPP_
#define MB4SIM_TOOL_PAIR_WARNING_HPP_

#include <fmt/core.h>

#include <cstdio>

#include "mb4sim/simulator.hpp"

namespace mb4::tool {

class PairWarning {
 public:
  explicit PairWarning(const sim::Simulator& simulator) : simulator_(simulator) {}

  // To be called when the host may have written; warns once.
  void look() {
    if (said_ || !simulator_.paired() || simulator_.scenario().channel(2) == nullptr) return;
    said_ = true;
    fmt::print(
        stderr,
        "mb4sim: CFGIF makes the pins of line 2 the inverse ones of line 1: channel 2 of the "
        "scenario is not connected\n");
  }

 private:
  const sim::Simulator& simulator_;
  bool said_ = false;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_PAIR_WARNING_HPP_
