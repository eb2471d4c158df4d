// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model without tracing, with faults (mutate.py): takes the place of sim/model/fast_chip.cpp.
#include <Vmb4_mutant.h>
#include <Vmb4_mutant___024root.h>

#include "plain_steps.hpp"
#include "verilated_chip.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  // Made visible by sim/model/public.vlt.
  static bool osc_selected(const Vmb4_mutant& model) {
    return model.rootp->mb4_chip__DOT__clkeni != 0;
  }
  static bool clk(const Vmb4_mutant& model) { return model.rootp->mb4_chip__DOT__clk != 0; }
  static bool paired(const Vmb4_mutant& model) { return model.rootp->mb4_chip__DOT__paired != 0; }
  static unsigned half_clocks(const Vmb4_mutant& model) {
    return model.rootp
        ->mb4_chip__DOT__u_engine__DOT__u_channels__DOT__u_lines__DOT__u_timebase__DOT__len_q;
  }
};

}  // namespace

std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed) {
  return std::make_unique<VerilatedChip<Vmb4_mutant, NoTrace, Inside, PlainSteps<Vmb4_mutant>>>(
      config, seed, TraceFile{});
}

}  // namespace mb4::sim
