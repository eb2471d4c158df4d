// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model without tracing, made of the iCE40 netlist: takes the place of
// sim/masters/mb4/model/fast_chip.cpp.
#include "tests/gate/gate_model.hpp"

namespace mb4::sim {

std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed) {
  return make_gate_chip(config, seed);
}

}  // namespace mb4::sim
