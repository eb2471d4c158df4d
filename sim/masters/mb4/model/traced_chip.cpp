// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model with a waveform file.
#include <Vmb4_chip_trace.h>
#include <Vmb4_chip_trace__Syms.h>

#include <fstream>
#include <memory>
#include <optional>
#include <traced_state.hpp>

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
  static unsigned freqs(const Vmb4_chip_trace& model) {
    return model.rootp
        ->mb4sim_trace_top__DOT__u_chip__DOT__u_engine__DOT__u_lines__DOT__u_timebase__DOT__len_q;
  }
};

using Chip = VerilatedChip<Vmb4_chip_trace, FstTrace, Inside, PlainSteps<Vmb4_chip_trace>>;

// Writes these signals into the model. Its next eval() computes all others, as the first one does.
void copy(const Vmb4_chip___024root& signals, Vmb4_chip_trace& model) {
  copy_state(signals, *model.rootp);
  model.rootp->vlSymsp->__Vm_didInit = false;
}

}  // namespace

std::unique_ptr<ChipModel> make_traced_chip(const ChipConfig& config, std::uint64_t seed,
                                            const TraceFile& trace) {
  return std::make_unique<Chip>(config, seed, trace);
}

std::unique_ptr<ChipModel> make_traced_chip(const ChipConfig& config, const ChipModel& chip,
                                            const TraceFile& trace) {
  const std::optional<RunningChip> running = chip.running();
  if (!running) throw TraceError(trace.path + ": this model of the chip writes no waveform");
  // Not every Verilator tells that it cannot open the file.
  if (!std::ofstream(trace.path, std::ios::app)) {
    throw TraceError(trace.path + ": cannot write the waveform");
  }
  constexpr std::uint64_t kSeed = 1;  // every flop takes its value from `running`
  auto traced = std::make_unique<Chip>(config, kSeed, trace);
  traced->go_on_from(trace.from, *running, &copy);
  if (traced->outputs() != chip.outputs()) {
    throw TraceError(trace.path + ": the model of the waveform differs from the chip");
  }
  return traced;
}

}  // namespace mb4::sim
