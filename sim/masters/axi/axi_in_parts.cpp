// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <Vaxi_1.h>
#include <verilated.h>

// Made by sim/model/signal_list.py; with PREFIX___024root.h.
#include <Vaxi_1_wave.hpp>
#if !MB4SIM_ONE_MODEL
#include <Vaxi_4.h>

#include <Vaxi_4_wave.hpp>
#endif

#include "sim/masters/axi/axi_makers.hpp"
#include "sim/model/whole_models.hpp"

// Some packages of Verilator leave this number empty. The headers hold what 5.006 writes.
#if VERILATOR_VERSION_INTEGER + 0 == 5006000
#include <Vaxi_1_edge.hpp>
#ifndef MODEL_RUNS_WHOLE
#define MB4_AXI_1_IN_PARTS
#endif
#undef MODEL_RUNS_WHOLE
#if !MB4SIM_ONE_MODEL
#include <Vaxi_4_edge.hpp>
#ifndef MODEL_RUNS_WHOLE
#define MB4_AXI_4_IN_PARTS
#endif
#undef MODEL_RUNS_WHOLE
#endif
#endif

namespace mb4::sim {
namespace {

#ifdef MB4_AXI_1_IN_PARTS
struct Edge1 {
  using Kept = axi_1::Kept;
  static void rise(Vaxi_1___024root* root, Kept& kept) { axi_1::rise(root, kept); }
  static void fall(Vaxi_1___024root* root, Kept& kept) { axi_1::fall(root, kept); }
  static void line(Vaxi_1___024root* root, Kept& kept) {
    axi_1::follow_slo(root, kept);
    axi_1::slo_has_changed(kept);
  }
  static void time(Kept& kept) { axi_1::time_has_changed(kept); }
};
using Steps1 = PartSteps<Vaxi_1, Edge1>;
#else
using Steps1 = WholeSteps<Vaxi_1>;
const WholeModel kAxi1IsWhole("biss_axi with one channel");
#endif
#if !MB4SIM_ONE_MODEL
#ifdef MB4_AXI_4_IN_PARTS
struct Edge4 {
  using Kept = axi_4::Kept;
  static void rise(Vaxi_4___024root* root, Kept& kept) { axi_4::rise(root, kept); }
  static void fall(Vaxi_4___024root* root, Kept& kept) { axi_4::fall(root, kept); }
  static void line(Vaxi_4___024root* root, Kept& kept) {
    axi_4::follow_slo(root, kept);
    axi_4::slo_has_changed(kept);
  }
  static void time(Kept& kept) { axi_4::time_has_changed(kept); }
};
using Steps4 = PartSteps<Vaxi_4, Edge4>;
#else
using Steps4 = WholeSteps<Vaxi_4>;
const WholeModel kAxi4IsWhole("biss_axi with four channels");
#endif
#endif

}  // namespace

std::unique_ptr<AxiModel> make_axi_in_parts(const ChipConfig& chip,
                                            [[maybe_unused]] unsigned channels,
                                            std::uint64_t seed) {
#if !MB4SIM_ONE_MODEL
  if (channels > 1) {
    return std::make_unique<VerilatedAxi<Vaxi_4, 4, Steps4, InsideAxi>>(chip, seed, false);
  }
#endif
  return std::make_unique<VerilatedAxi<Vaxi_1, 1, Steps1, InsideAxi>>(chip, seed, false);
}

}  // namespace mb4::sim
