// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model of dsl_bus made of its iCE40 netlist: takes the place of sim/masters/dsl/dsl_rtl.cpp.
#include <Vdsl_gate.h>

#include "sim/masters/dsl/verilated_dsl.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  static bool know_edges(Vdsl_gate& /*model*/) { return false; }
  static std::vector<WaveSignal> signals(const Vdsl_gate& /*model*/) { return {}; }
};

}  // namespace

std::unique_ptr<DslRtl> make_dsl_rtl(const ChipConfig& chip, std::uint64_t bus_hz,
                                     std::uint64_t seed, bool /*plain*/) {
  return std::make_unique<DslOnTwoClocks<Vdsl_gate, Inside>>(chip, bus_hz, seed);
}

}  // namespace mb4::sim
