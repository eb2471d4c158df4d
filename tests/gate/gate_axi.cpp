// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The models of biss_axi, made of iCE40 netlists with four channels: takes the place of
// sim/masters/axi/axi_model.cpp.
#include <Vaxi_4_gate.h>
#include <Vaxi_4_gate___024root.h>
#include <Vaxi_full_4_gate.h>
#include <Vaxi_full_4_gate___024root.h>

#include <stdexcept>

#include "sim/masters/axi/verilated_axi.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  using Counts = NoCounts;
  template <typename Model>
  static unsigned frame(const Model& model) {
    return model.frame_q;
  }
  template <typename Model>
  static std::vector<WaveSignal> signals(const Model& /*model*/) {
    return {};
  }
};

template <typename Model>
std::unique_ptr<AxiModel> make(const ChipConfig& chip, std::uint64_t seed) {
  return std::make_unique<VerilatedAxi<Model, 4, WholeSteps<Model>, Inside>>(chip, seed, true);
}

}  // namespace

std::unique_ptr<AxiModel> make_axi_model(const ChipConfig& chip, unsigned channels,
                                         std::uint64_t seed, bool /*plain*/) {
  if (channels > 4) throw std::runtime_error("the netlists have four channels");
  return chip.features == kAxiFull ? make<Vaxi_full_4_gate>(chip, seed)
                                   : make<Vaxi_4_gate>(chip, seed);
}

}  // namespace mb4::sim
