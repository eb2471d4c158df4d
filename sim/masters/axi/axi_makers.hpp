// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// How make_axi_model() makes a model of a width. The models in parts and the whole ones stand in
// files of their own, because together they take long to compile.
#ifndef MB4SIM_MASTERS_AXI_AXI_MAKERS_HPP_
#define MB4SIM_MASTERS_AXI_AXI_MAKERS_HPP_

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/masters/axi/axi_model.hpp"
#include "sim/masters/axi/verilated_axi.hpp"

namespace mb4::sim {

struct InsideAxi {
  template <typename Model>
  static unsigned frame(const Model& model) {
    return model.rootp->axi_core__DOT__u_start__DOT__frame_q;
  }
  template <typename Model>
  static std::vector<WaveSignal> signals(const Model& model) {
    return wave_signals(*model.rootp);
  }
};

// One or four channels without extras, of which an edge evaluates only what it changes.
std::unique_ptr<AxiModel> make_axi_in_parts(const ChipConfig& chip, unsigned channels,
                                            std::uint64_t seed);
// The model whole: any configuration.
std::unique_ptr<AxiModel> make_axi_whole(const ChipConfig& chip, unsigned channels,
                                         std::uint64_t seed);

}  // namespace mb4::sim

#endif  // MB4SIM_MASTERS_AXI_AXI_MAKERS_HPP_
