// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model without tracing.
#include <Vmb4_chip.h>
#include <Vmb4_chip___024root.h>

#include "plain_steps.hpp"
#include "verilated_chip.hpp"

#if VERILATOR_VERSION_INTEGER == 5006000
#include "direct_steps.hpp"
#endif

namespace mb4::sim {
namespace {

struct Inside {
  // Made visible by public.vlt.
  static bool osc_selected(const Vmb4_chip& model) {
    return model.rootp->mb4_chip__DOT__clkeni != 0;
  }
  static bool clk(const Vmb4_chip& model) { return model.rootp->mb4_chip__DOT__clk != 0; }
  static bool paired(const Vmb4_chip& model) { return model.rootp->mb4_chip__DOT__paired != 0; }
  static unsigned half_clocks(const Vmb4_chip& model) {
    return model.rootp
        ->mb4_chip__DOT__u_engine__DOT__u_channels__DOT__u_lines__DOT__u_timebase__DOT__len_q;
  }
};

#if VERILATOR_VERSION_INTEGER == 5006000
using Steps = DirectSteps;
#else
using Steps = PlainSteps<Vmb4_chip>;
#endif

}  // namespace

std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed) {
  return std::make_unique<VerilatedChip<Vmb4_chip, NoTrace, Inside, Steps>>(config, seed,
                                                                            TraceFile{});
}

std::unique_ptr<ChipModel> make_plain_chip(const ChipConfig& config, std::uint64_t seed) {
  using Chip = VerilatedChip<Vmb4_chip, NoTrace, Inside, PlainSteps<Vmb4_chip>>;
  return std::make_unique<Chip>(config, seed, TraceFile{});
}

}  // namespace mb4::sim
