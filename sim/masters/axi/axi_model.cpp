// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/axi/axi_model.hpp"

#include "sim/core/scenario_error.hpp"
#include "sim/masters/axi/axi_makers.hpp"

namespace mb4::sim {

std::unique_ptr<AxiModel> make_axi_model(const ChipConfig& chip, unsigned channels,
                                         std::uint64_t seed, bool plain) {
  if (MB4SIM_ONE_MODEL && channels > 1) {
    throw ScenarioError(left_out("biss_axi with more than one channel", "-DMB4_ONE_MODEL=OFF"));
  }
  // A single channel has nothing to be aligned to.
  const bool aligned = channels > 1 && (chip.quirks & kAxiAlignLatch) != 0;
  if (plain || aligned || chip.features != kAxiDocument || channels > 4) {
    return make_axi_whole(chip, channels, seed, plain);
  }
  return make_axi_in_parts(chip, channels, seed);
}

}  // namespace mb4::sim
