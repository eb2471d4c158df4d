// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The models of biss_pru, made of its iCE40 netlists: takes the place of
// sim/masters/pru/pru_model.cpp.
#include <Vpru_200_gate.h>
#include <Vpru_200_gate___024root.h>
#include <Vpru_80_gate.h>
#include <Vpru_80_gate___024root.h>

#include "sim/masters/pru/pru_master.hpp"
#include "sim/masters/pru/verilated_pru.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  using Counts = NoCounts;
  template <typename Model>
  static unsigned mhz(const Model& model) {
    return pru_mhz(model.mhz);
  }
  template <typename Model>
  static std::vector<WaveSignal> signals(const Model& /*model*/) {
    return {};
  }
};

template <typename Model>
std::unique_ptr<PruModel> make(const ChipConfig& chip, std::uint64_t seed) {
  return std::make_unique<VerilatedPru<Model, WholeSteps<Model>, Inside>>(chip, seed, true);
}

}  // namespace

std::unique_ptr<PruModel> make_pru_model(const ChipConfig& chip, std::uint64_t seed,
                                         bool /*plain*/) {
  return chip.f_clk_hz == kPruFastHz ? make<Vpru_200_gate>(chip, seed)
                                     : make<Vpru_80_gate>(chip, seed);
}

}  // namespace mb4::sim
