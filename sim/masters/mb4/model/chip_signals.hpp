// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The signals that VerilatedChip reads inside a model whose top is mb4_chip. public.vlt makes them
// visible.
#ifndef MB4SIM_MB4_CHIP_SIGNALS_HPP_
#define MB4SIM_MB4_CHIP_SIGNALS_HPP_

namespace mb4::sim {

template <typename Model>
struct ChipSignals {
  static bool osc_selected(const Model& model) { return model.rootp->mb4_chip__DOT__clkeni != 0; }
  static bool clk(const Model& model) { return model.rootp->mb4_chip__DOT__clk != 0; }
  static bool paired(const Model& model) { return model.rootp->mb4_chip__DOT__paired != 0; }
  static unsigned freqs(const Model& model) {
    return model.rootp->mb4_chip__DOT__u_engine__DOT__u_lines__DOT__u_timebase__DOT__len_q;
  }
};

}  // namespace mb4::sim

#endif  // MB4SIM_MB4_CHIP_SIGNALS_HPP_
