// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model of biss_clb, made of its iCE40 netlist: takes the place of
// sim/masters/clb/clb_model.cpp.
#include <Vclb_gate.h>
#include <Vclb_gate___024root.h>

#include "sim/masters/clb/verilated_clb.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  using Counts = NoCounts;
  static std::pair<unsigned, unsigned> ma_period(const Vclb_gate& model) {
    return clb_period(model.ma_period);
  }
  static std::vector<WaveSignal> signals(const Vclb_gate& /*model*/) { return {}; }
};

}  // namespace

std::unique_ptr<ClbModel> make_clb_model(const ChipConfig& chip, std::uint64_t seed,
                                         bool /*plain*/) {
  return std::make_unique<VerilatedClb<Vclb_gate, Inside>>(chip, seed, true);
}

}  // namespace mb4::sim
