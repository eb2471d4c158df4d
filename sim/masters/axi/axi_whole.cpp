// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <Vaxi_1.h>
#include <verilated.h>

// Made by sim/model/signal_list.py; with PREFIX___024root.h.
#include <Vaxi_1_wave.hpp>
#if !MB4SIM_ONE_MODEL
#include <Vaxi_16.h>
#include <Vaxi_4.h>
#include <Vaxi_align_16.h>
#include <Vaxi_align_4.h>
#include <Vaxi_frames_1.h>
#include <Vaxi_frames_16.h>
#include <Vaxi_frames_4.h>
#include <Vaxi_full_1.h>
#include <Vaxi_full_16.h>
#include <Vaxi_full_4.h>

#include <Vaxi_16_wave.hpp>
#include <Vaxi_4_wave.hpp>
#include <Vaxi_align_16_wave.hpp>
#include <Vaxi_align_4_wave.hpp>
#include <Vaxi_frames_16_wave.hpp>
#include <Vaxi_frames_1_wave.hpp>
#include <Vaxi_frames_4_wave.hpp>
#include <Vaxi_full_16_wave.hpp>
#include <Vaxi_full_1_wave.hpp>
#include <Vaxi_full_4_wave.hpp>
#endif

#include "sim/masters/axi/axi_makers.hpp"

namespace mb4::sim {
namespace {

template <typename Model, unsigned kChannels>
std::unique_ptr<AxiModel> make(const ChipConfig& chip, std::uint64_t seed, bool plain) {
  return std::make_unique<VerilatedAxi<Model, kChannels, WholeSteps<Model>, InsideAxi>>(chip, seed,
                                                                                        plain);
}

#if !MB4SIM_ONE_MODEL
// The smallest model of a kind that has enough channels.
template <typename One, typename Four, typename Sixteen>
std::unique_ptr<AxiModel> make_of(const ChipConfig& chip, unsigned channels, std::uint64_t seed,
                                  bool plain) {
  if (channels <= 1) return make<One, 1>(chip, seed, plain);
  if (channels <= 4) return make<Four, 4>(chip, seed, plain);
  return make<Sixteen, kAxiChannels>(chip, seed, plain);
}
#endif

}  // namespace

std::unique_ptr<AxiModel> make_axi_whole(const ChipConfig& chip, [[maybe_unused]] unsigned channels,
                                         std::uint64_t seed, bool plain) {
#if !MB4SIM_ONE_MODEL
  if (chip.features == kAxiFull)
    return make_of<Vaxi_full_1, Vaxi_full_4, Vaxi_full_16>(chip, channels, seed, plain);
  if (chip.features == kAxiFrames)
    return make_of<Vaxi_frames_1, Vaxi_frames_4, Vaxi_frames_16>(chip, channels, seed, plain);
  if ((chip.quirks & kAxiAlignLatch) != 0)  // a single channel has nothing to be aligned to
    return make_of<Vaxi_1, Vaxi_align_4, Vaxi_align_16>(chip, channels, seed, plain);
  return make_of<Vaxi_1, Vaxi_4, Vaxi_16>(chip, channels, seed, plain);
#else
  return make<Vaxi_1, 1>(chip, seed, plain);
#endif
}

}  // namespace mb4::sim
