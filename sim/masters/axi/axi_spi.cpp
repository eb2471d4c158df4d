// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The models of biss_axi behind SPI.
#include <verilated.h>

#include "sim/core/scenario_error.hpp"
#include "sim/masters/axi/axi_makers.hpp"

#if !MB4SIM_ONE_MODEL
#include <Vaxi_spi_1.h>
#include <Vaxi_spi_4.h>
#include <Vaxi_spi_frames_4.h>
#include <Vaxi_spi_full_4.h>

#include <Vaxi_spi_1_wave.hpp>
#include <Vaxi_spi_4_wave.hpp>
#include <Vaxi_spi_frames_4_wave.hpp>
#include <Vaxi_spi_full_4_wave.hpp>
#endif

namespace mb4::sim {
namespace {

struct InsideSpi : InsideAxi {
  static constexpr bool kSpi = true;
};

template <typename Model, unsigned kChannels>
[[maybe_unused]] std::unique_ptr<AxiModel> make(const ChipConfig& chip, std::uint64_t seed,
                                                bool plain) {
  return std::make_unique<VerilatedAxi<Model, kChannels, WholeSteps<Model>, InsideSpi>>(chip, seed,
                                                                                        plain);
}

}  // namespace

std::unique_ptr<AxiModel> make_axi_spi_model([[maybe_unused]] const ChipConfig& chip,
                                             [[maybe_unused]] unsigned channels,
                                             [[maybe_unused]] std::uint64_t seed,
                                             [[maybe_unused]] bool plain) {
#if !MB4SIM_ONE_MODEL
  if (channels > kAxiSpiChannels) {
    throw ScenarioError("biss_spi has at most 4 channels; interface = \"axi\" has 16");
  }
  if ((chip.quirks & kAxiPorPin) != 0) throw ScenarioError("biss_spi has no POR_PIN");
  if (chip.features == kAxiFull) return make<Vaxi_spi_full_4, 4>(chip, seed, plain);
  if (chip.features == kAxiFrames) return make<Vaxi_spi_frames_4, 4>(chip, seed, plain);
  if (channels > 1 && (chip.quirks & kAxiAlignLatch) != 0) {
    throw ScenarioError(
        "biss_spi with ALIGN_LATCH is simulated with features = \"full\" or \"frames\" only");
  }
  if (channels <= 1) return make<Vaxi_spi_1, 1>(chip, seed, plain);
  return make<Vaxi_spi_4, 4>(chip, seed, plain);
#else
  throw ScenarioError(left_out("biss_spi", "-DMB4_ONE_MODEL=OFF"));
#endif
}

}  // namespace mb4::sim
