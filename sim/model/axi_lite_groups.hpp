// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Groups of the waveform view of a master with clk_i, rst_ni and AXI4-Lite.
#ifndef MB4SIM_MODEL_AXI_LITE_GROUPS_HPP_
#define MB4SIM_MODEL_AXI_LITE_GROUPS_HPP_

#include <vector>

#include "sim/model/wave_view.hpp"

namespace mb4::sim {

inline std::vector<WaveGroup> axi_lite_groups() {
  return {{"clock and reset", true, {{"", "clk_i"}, {"", "rst_ni"}}, {}},
          {"write",
           false,
           {{"", "s_axi_awvalid"},
            {"", "s_axi_awready"},
            {"", "s_axi_awaddr"},
            {"", "s_axi_wvalid"},
            {"", "s_axi_wready"},
            {"", "s_axi_wdata"},
            {"", "s_axi_wstrb"},
            {"", "s_axi_bvalid"},
            {"", "s_axi_bready"},
            {"", "s_axi_bresp"}},
           {}},
          {"read",
           false,
           {{"", "s_axi_arvalid"},
            {"", "s_axi_arready"},
            {"", "s_axi_araddr"},
            {"", "s_axi_rvalid"},
            {"", "s_axi_rready"},
            {"", "s_axi_rdata"},
            {"", "s_axi_rresp"}},
           {}}};
}

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_AXI_LITE_GROUPS_HPP_
