// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl/dsl_rtl.hpp"

#include <Vdsl.h>
#include <Vdsl___024root.h>
#include <verilated.h>

// Made by sim/model/signal_list.py.
#include <Vdsl_wave.hpp>
#include <algorithm>
#include <vector>

#include "sim/core/trace_error.hpp"
#include "sim/masters/dsl_model/frame_plan.hpp"
#include "sim/model/axi_manager.hpp"
#include "sim/model/two_clock_master.hpp"

namespace mb4::sim {
namespace {

class VerilatedDsl final : public TwoClockMaster<VerilatedDsl, DslRtl, Vdsl, AxiManager<Vdsl>> {
  using Base = TwoClockMaster<VerilatedDsl, DslRtl, Vdsl, AxiManager<Vdsl>>;
  friend Base;

 public:
  VerilatedDsl(const ChipConfig& chip, std::uint64_t bus_hz, std::uint64_t seed)
      : Base(chip.f_clk_hz, bus_hz, seed, "dsl") {
    model_->quirks_i = chip.quirks;
    model_->dsl_in_i = 1;
    reset_by_edges([this](bool active) {
      model_->rst_ni = active ? 0 : 1;
      manager_.reset(*model_, active);
    });
    evaluate(0);
  }

  // No output depends on the line before a clock edge.
  void set_inputs(Time now, unsigned /*line*/, unsigned levels) override {
    model_->dsl_in_i = levels & 1U;
    show(now);
  }
  unsigned half_clocks(unsigned /*line*/) const override { return dsl_model::kTicksPerBit / 2; }
  void set_probes(Time now, std::uint64_t arrived, std::uint64_t sent,
                  std::uint64_t ready) override {
    probes_ = {arrived, sent, ready};
    show(now);
  }

  void set_core_reset(Time now, bool active) override {
    model_->rst_ni = active ? 0 : 1;
    evaluate(now);
  }
  void set_bus_reset(Time now, bool active) override {
    manager_.reset(*model_, active);
    evaluate(now);
  }
  bool in() const override { return model_->dsl_in_i != 0; }

  void start_wave(const TraceFile& file) override {
    std::vector<WaveSignal> signals = wave_signals(*model_->rootp);
    if (signals.empty()) throw TraceError(file.path + ": this model writes no waveform");
    signals.insert(signals.begin(),
                   {{"encoder_line", &probes_.line, sizeof probes_.line, 0, 1},
                    {"encoder_out", &probes_.sent, sizeof probes_.sent, 0, 1},
                    {"encoder_ready", &probes_.ready, sizeof probes_.ready, 0, 1}});
    wave_ = std::make_unique<SignalWave>(file, "mb4sim.dsl_bus", signals);
    wave_->show(file.from);
  }
  void stop_wave() override { wave_.reset(); }

 private:
  // What TwoClockMaster asks for.
  Outputs pack() const {
    const Vdsl& m = *model_;
    return of_line(0, m.dsl_out_o * kOut | m.dsl_en_o * kEnable) | m.irq_o * kIrq |
           m.link_o * kLink | m.sample_edge_o * kSampleEdge | m.position_ready_o * kReady;
  }

  // Levels at the encoder, for the waveform.
  struct Probes {
    std::uint64_t line = ~std::uint64_t{0};
    std::uint64_t sent = ~std::uint64_t{0};
    std::uint64_t ready = ~std::uint64_t{0};
  };
  Probes probes_;
};

}  // namespace

std::unique_ptr<DslRtl> make_dsl_rtl(const ChipConfig& chip, std::uint64_t bus_hz,
                                     std::uint64_t seed) {
  return std::make_unique<VerilatedDsl>(chip, bus_hz, seed);
}

}  // namespace mb4::sim
