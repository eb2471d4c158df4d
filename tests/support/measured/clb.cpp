// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model of biss_clb that coverage or mutants run: takes the place of
// sim/masters/clb/clb_model.cpp.
#include <Vmeasured_clb.h>
#include <Vmeasured_clb___024root.h>

#include "sim/masters/clb/verilated_clb.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  using Counts = NoCounts;
  template <typename Model>
  static std::pair<unsigned, unsigned> ma_period(const Model& model) {
    return clb_period(model.rootp->biss_clb__DOT__u_frame__DOT__u_ma__DOT__period_i);
  }
  template <typename Model>
  static std::vector<WaveSignal> signals(const Model& /*model*/) {
    return {};
  }
};

}  // namespace

std::unique_ptr<ClbModel> make_clb_model(const ChipConfig& chip, std::uint64_t seed,
                                         bool /*plain*/) {
  return std::make_unique<VerilatedClb<Vmeasured_clb, Inside>>(chip, seed, true);
}

}  // namespace mb4::sim
