// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The manager of AXI4-Lite for a model whose bus has a clock of its own (TwoClockMaster).
#ifndef MB4SIM_MODEL_AXI_MANAGER_HPP_
#define MB4SIM_MODEL_AXI_MANAGER_HPP_

#include "sim/model/axi_lite_manager.hpp"

namespace mb4::sim {

template <typename Model>
class AxiManager : public AxiLiteManager<Model> {
 public:
  void clock(Model& m, bool level) { m.s_axi_aclk = level; }
  void reset(Model& m, bool active) {
    m.s_axi_aresetn = !active;
    this->forget();
  }
};

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_AXI_MANAGER_HPP_
