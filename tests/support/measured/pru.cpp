// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The models of biss_pru that coverage or mutants run: takes the place of
// sim/masters/pru/pru_model.cpp.
#include <Vmeasured_pru_200.h>
#include <Vmeasured_pru_200___024root.h>
#include <Vmeasured_pru_80.h>
#include <Vmeasured_pru_80___024root.h>

#include "sim/masters/pru/pru_master.hpp"
#include "sim/masters/pru/verilated_pru.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  using Counts = NoCounts;
  template <typename Model>
  static unsigned mhz(const Model& model) {
    return pru_mhz(model.rootp->pru_core__DOT__plan_mhz_q);
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
  return chip.f_clk_hz == kPruFastHz ? make<Vmeasured_pru_200>(chip, seed)
                                     : make<Vmeasured_pru_80>(chip, seed);
}

}  // namespace mb4::sim
