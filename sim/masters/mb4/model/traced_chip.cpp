// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model with a waveform file.
#include <Vmb4_chip_trace.h>
#include <Vmb4_chip_trace___024root.h>

#include <memory>

#include "plain_steps.hpp"
#include "sim/model/fst_trace.hpp"
#include "verilated_chip.hpp"

namespace mb4::sim {
namespace {

struct Inside {
  // public.vlt makes this signal visible.
  static bool osc_selected(const Vmb4_chip_trace& model) {
    return model.rootp->mb4sim_trace_top__DOT__u_chip__DOT__clkeni != 0;
  }
  static bool clk(const Vmb4_chip_trace& model) {
    return model.rootp->mb4sim_trace_top__DOT__u_chip__DOT__clk != 0;
  }
  static bool paired(const Vmb4_chip_trace& model) {
    return model.rootp->mb4sim_trace_top__DOT__u_chip__DOT__paired != 0;
  }
  static unsigned half_clocks(const Vmb4_chip_trace& model) {
    return model.rootp
        ->mb4sim_trace_top__DOT__u_chip__DOT__u_engine__DOT__u_lines__DOT__u_timebase__DOT__len_q;
  }
};

}  // namespace

std::unique_ptr<ChipModel> make_traced_chip(const ChipConfig& config, std::uint64_t seed,
                                            const TraceFile& trace) {
  using Chip = VerilatedChip<Vmb4_chip_trace, FstTrace, Inside, PlainSteps<Vmb4_chip_trace>>;
  return std::make_unique<Chip>(config, seed, trace);
}

}  // namespace mb4::sim
