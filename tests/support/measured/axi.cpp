// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The models of biss_axi and biss_spi with up to four channels that coverage or mutants run: takes
// the place of sim/masters/axi/axi_model.cpp and axi_spi.cpp.
#include <Vmeasured_axi_4.h>
#include <Vmeasured_axi_4___024root.h>
#include <Vmeasured_axi_frames_4.h>
#include <Vmeasured_axi_frames_4___024root.h>
#include <Vmeasured_axi_full_4.h>
#include <Vmeasured_axi_full_4___024root.h>
#include <Vmeasured_axi_spi_4.h>
#include <Vmeasured_axi_spi_4___024root.h>
#include <Vmeasured_axi_spi_frames_4.h>
#include <Vmeasured_axi_spi_frames_4___024root.h>
#include <Vmeasured_axi_spi_full_4.h>
#include <Vmeasured_axi_spi_full_4___024root.h>

#include <stdexcept>

#include "sim/masters/axi/verilated_axi.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  using Counts = NoCounts;
  template <typename Model>
  static unsigned frame(const Model& model) {
    return model.rootp->axi_core__DOT__u_start__DOT__frame_q;
  }
  template <typename Model>
  static std::vector<WaveSignal> signals(const Model& /*model*/) {
    return {};
  }
};

struct InsideSpi : Inside {
  static constexpr bool kSpi = true;
};

template <typename Model, typename What = Inside>
std::unique_ptr<AxiModel> make(const ChipConfig& chip, std::uint64_t seed) {
  return std::make_unique<VerilatedAxi<Model, 4, WholeSteps<Model>, What>>(chip, seed, true);
}

}  // namespace

std::unique_ptr<AxiModel> make_axi_model(const ChipConfig& chip, unsigned channels,
                                         std::uint64_t seed, bool /*plain*/) {
  if (channels > 4) throw std::runtime_error("the measured models have four channels");
  if (chip.features == kAxiFrames) return make<Vmeasured_axi_frames_4>(chip, seed);
  return chip.features == kAxiFull ? make<Vmeasured_axi_full_4>(chip, seed)
                                   : make<Vmeasured_axi_4>(chip, seed);
}

std::unique_ptr<AxiModel> make_axi_spi_model(const ChipConfig& chip, unsigned channels,
                                             std::uint64_t seed, bool /*plain*/) {
  if (channels > 4) throw std::runtime_error("the measured models have four channels");
  if (chip.features == kAxiFrames) return make<Vmeasured_axi_spi_frames_4, InsideSpi>(chip, seed);
  return chip.features == kAxiFull ? make<Vmeasured_axi_spi_full_4, InsideSpi>(chip, seed)
                                   : make<Vmeasured_axi_spi_4, InsideSpi>(chip, seed);
}

}  // namespace mb4::sim
