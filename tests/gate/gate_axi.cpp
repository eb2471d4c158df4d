// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The models of biss_axi with four channels and of biss_spi, made of iCE40 netlists: takes the
// place of sim/masters/axi/axi_model.cpp and axi_spi.cpp.
#include <Vaxi_4_gate.h>
#include <Vaxi_4_gate___024root.h>
#include <Vaxi_frames_4_gate.h>
#include <Vaxi_frames_4_gate___024root.h>
#include <Vaxi_full_4_gate.h>
#include <Vaxi_full_4_gate___024root.h>
#include <Vaxi_spi_1_gate.h>
#include <Vaxi_spi_1_gate___024root.h>
#include <Vaxi_spi_4_gate.h>
#include <Vaxi_spi_4_gate___024root.h>
#include <Vaxi_spi_full_4_gate.h>
#include <Vaxi_spi_full_4_gate___024root.h>

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

struct InsideSpi : Inside {
  static constexpr bool kSpi = true;
};

template <typename Model, unsigned kChannels = 4, typename What = Inside>
std::unique_ptr<AxiModel> make(const ChipConfig& chip, std::uint64_t seed) {
  return std::make_unique<VerilatedAxi<Model, kChannels, WholeSteps<Model>, What>>(chip, seed,
                                                                                   true);
}

}  // namespace

std::unique_ptr<AxiModel> make_axi_model(const ChipConfig& chip, unsigned channels,
                                         std::uint64_t seed, bool /*plain*/) {
  if (channels > 4) throw std::runtime_error("the netlists have four channels");
  if (chip.features == kAxiFrames) return make<Vaxi_frames_4_gate>(chip, seed);
  return chip.features == kAxiFull ? make<Vaxi_full_4_gate>(chip, seed)
                                   : make<Vaxi_4_gate>(chip, seed);
}

std::unique_ptr<AxiModel> make_axi_spi_model(const ChipConfig& chip, unsigned channels,
                                             std::uint64_t seed, bool /*plain*/) {
  if (channels > 4) throw std::runtime_error("the netlists have four channels");
  if (chip.features == kAxiFrames) throw std::runtime_error("no netlist of biss_spi by frames");
  if (chip.features == kAxiFull) return make<Vaxi_spi_full_4_gate, 4, InsideSpi>(chip, seed);
  return channels == 1 ? make<Vaxi_spi_1_gate, 1, InsideSpi>(chip, seed)
                       : make<Vaxi_spi_4_gate, 4, InsideSpi>(chip, seed);
}

}  // namespace mb4::sim
