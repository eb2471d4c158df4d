// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/axi/axi_model.hpp"

#include <Vaxi_1.h>
#include <Vaxi_16.h>
#include <Vaxi_4.h>
#include <Vaxi_align_16.h>
#include <Vaxi_align_4.h>
#include <Vaxi_full_1.h>
#include <Vaxi_full_16.h>
#include <Vaxi_full_4.h>
#include <verilated.h>

// Made by sim/model/signal_list.py; with PREFIX___024root.h.
#include <Vaxi_16_wave.hpp>
#include <Vaxi_1_wave.hpp>
#include <Vaxi_4_wave.hpp>
#include <Vaxi_align_16_wave.hpp>
#include <Vaxi_align_4_wave.hpp>
#include <Vaxi_full_16_wave.hpp>
#include <Vaxi_full_1_wave.hpp>
#include <Vaxi_full_4_wave.hpp>

#include "sim/masters/axi/verilated_axi.hpp"

// Some packages of Verilator leave this number empty. The headers hold what 5.006 writes.
#if VERILATOR_VERSION_INTEGER + 0 == 5006000
#include <Vaxi_1_edge.hpp>
#ifndef MODEL_RUNS_WHOLE
#define MB4_AXI_1_IN_PARTS
#endif
#undef MODEL_RUNS_WHOLE
#include <Vaxi_4_edge.hpp>
#ifndef MODEL_RUNS_WHOLE
#define MB4_AXI_4_IN_PARTS
#endif
#undef MODEL_RUNS_WHOLE
#endif

namespace mb4::sim {
namespace {

struct Inside {
  template <typename Model>
  static unsigned frame(const Model& model) {
    return model.rootp->axi_core__DOT__u_start__DOT__frame_q;
  }
  template <typename Model>
  static std::vector<WaveSignal> signals(const Model& model) {
    return wave_signals(*model.rootp);
  }
};

#ifdef MB4_AXI_1_IN_PARTS
struct Edge1 {
  using Kept = axi_1::Kept;
  static void rise(Vaxi_1___024root* root, Kept& kept) { axi_1::rise(root, kept); }
  static void fall(Vaxi_1___024root* root, Kept& kept) { axi_1::fall(root, kept); }
  static void slo(Vaxi_1___024root* root, Kept& kept) {
    axi_1::follow_slo(root, kept);
    axi_1::slo_has_changed(kept);
  }
};
using Steps1 = AxiPartSteps<Vaxi_1, Edge1>;
#else
using Steps1 = AxiWholeSteps<Vaxi_1>;
#endif
#ifdef MB4_AXI_4_IN_PARTS
struct Edge4 {
  using Kept = axi_4::Kept;
  static void rise(Vaxi_4___024root* root, Kept& kept) { axi_4::rise(root, kept); }
  static void fall(Vaxi_4___024root* root, Kept& kept) { axi_4::fall(root, kept); }
  static void slo(Vaxi_4___024root* root, Kept& kept) {
    axi_4::follow_slo(root, kept);
    axi_4::slo_has_changed(kept);
  }
};
using Steps4 = AxiPartSteps<Vaxi_4, Edge4>;
#else
using Steps4 = AxiWholeSteps<Vaxi_4>;
#endif
using Steps16 = AxiWholeSteps<Vaxi_16>;

template <typename Model, unsigned kChannels, typename Steps>
std::unique_ptr<AxiModel> make(const ChipConfig& chip, std::uint64_t seed, bool plain) {
  if (plain) {
    return std::make_unique<VerilatedAxi<Model, kChannels, AxiWholeSteps<Model>, Inside>>(chip,
                                                                                          seed);
  }
  return std::make_unique<VerilatedAxi<Model, kChannels, Steps, Inside>>(chip, seed);
}

}  // namespace

std::unique_ptr<AxiModel> make_axi_model(const ChipConfig& chip, unsigned channels,
                                         std::uint64_t seed, bool plain) {
  if (chip.features == kAxiFull) {
    if (channels <= 1) return make<Vaxi_full_1, 1, AxiWholeSteps<Vaxi_full_1>>(chip, seed, plain);
    if (channels <= 4) return make<Vaxi_full_4, 4, AxiWholeSteps<Vaxi_full_4>>(chip, seed, plain);
    return make<Vaxi_full_16, kAxiChannels, AxiWholeSteps<Vaxi_full_16>>(chip, seed, plain);
  }
  if (channels <= 1) return make<Vaxi_1, 1, Steps1>(chip, seed, plain);
  // A single channel has nothing to be aligned to.
  if ((chip.quirks & kAxiAlignLatch) != 0) {
    if (channels <= 4) {
      return make<Vaxi_align_4, 4, AxiWholeSteps<Vaxi_align_4>>(chip, seed, plain);
    }
    return make<Vaxi_align_16, kAxiChannels, AxiWholeSteps<Vaxi_align_16>>(chip, seed, plain);
  }
  if (channels <= 4) return make<Vaxi_4, 4, Steps4>(chip, seed, plain);
  return make<Vaxi_16, kAxiChannels, Steps16>(chip, seed, plain);
}

}  // namespace mb4::sim
