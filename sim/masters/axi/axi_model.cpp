// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/axi/axi_model.hpp"

#include <Vaxi_1.h>
#include <Vaxi_16.h>
#include <Vaxi_16___024root.h>
#include <Vaxi_1___024root.h>
#include <Vaxi_4.h>
#include <Vaxi_4___024root.h>
#include <Vaxi_full_1.h>
#include <Vaxi_full_16.h>
#include <Vaxi_full_16___024root.h>
#include <Vaxi_full_1___024root.h>
#include <Vaxi_full_4.h>
#include <Vaxi_full_4___024root.h>
#include <verilated.h>

#include <iterator>
#include <type_traits>
#include <utility>

#include "sim/masters/axi/axi_steps.hpp"
#include "sim/model/clock_source.hpp"
#include "sim/model/verilated_context.hpp"

// Some packages of Verilator leave this number empty. The headers hold what 5.006 writes.
#if VERILATOR_VERSION_INTEGER + 0 == 5006000
#include <Vaxi_1_edge.hpp>
#ifndef MODEL_RUNS_WHOLE
#define MB4_AXI_1_IN_PARTS
#endif
#undef MODEL_RUNS_WHOLE
#include <Vaxi_4_edge.hpp>
#ifndef MODEL_RUNS_WHOLE
#define MB4_AXI_4_IN_PARTS
#endif
#undef MODEL_RUNS_WHOLE
#endif

namespace mb4::sim {
namespace {

// Place of half_len in axi_pkg::frame_t.
constexpr unsigned kHalfLenLsb = 16;

#ifdef MB4_AXI_1_IN_PARTS
struct Edge1 {
  using Kept = axi_1::Kept;
  static void rise(Vaxi_1___024root* root, Kept& kept) { axi_1::rise(root, kept); }
  static void fall(Vaxi_1___024root* root, Kept& kept) { axi_1::fall(root, kept); }
  static void slo(Vaxi_1___024root* root, Kept& kept) {
    axi_1::follow_slo(root, kept);
    axi_1::slo_has_changed(kept);
  }
};
using Steps1 = AxiPartSteps<Vaxi_1, Edge1>;
#else
using Steps1 = AxiWholeSteps<Vaxi_1>;
#endif
#ifdef MB4_AXI_4_IN_PARTS
struct Edge4 {
  using Kept = axi_4::Kept;
  static void rise(Vaxi_4___024root* root, Kept& kept) { axi_4::rise(root, kept); }
  static void fall(Vaxi_4___024root* root, Kept& kept) { axi_4::fall(root, kept); }
  static void slo(Vaxi_4___024root* root, Kept& kept) {
    axi_4::follow_slo(root, kept);
    axi_4::slo_has_changed(kept);
  }
};
using Steps4 = AxiPartSteps<Vaxi_4, Edge4>;
#else
using Steps4 = AxiWholeSteps<Vaxi_4>;
#endif
using Steps16 = AxiWholeSteps<Vaxi_16>;

template <typename Model, unsigned kChannels, typename Steps>
class VerilatedAxi final : public AxiModel {
  using Slo = std::conditional_t<(kChannels > 8), SData, CData>;

 public:
  VerilatedAxi(const ChipConfig& chip, std::uint64_t seed)
      : context_(make_verilated_context(seed)), clock_(chip.f_clk_hz) {
    min_clock_ = period_of(chip.f_clk_hz);
    model_ = std::make_unique<Model>(context_.get(), "biss_axi");
    Model& m = *model_;
    m.clk_i = 0;
    m.switches_i = static_cast<CData>(chip.quirks);
    m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
    m.s_axi_bready = m.s_axi_rready = 1;
    m.s_axis_tready = 1;
    m.slo_i = static_cast<Slo>((1U << kChannels) - 1);
    m.ext_sample_clk_i = 0;
    m.sample_en_i = 1;
    // Only an edge resets the flops of a Verilated model.
    context_->assertOn(false);
    m.rst_ni = 1;
    m.eval();
    m.rst_ni = 0;
    steps_.inputs(m);
    context_->assertOn(true);
    pack();
  }

  ~VerilatedAxi() override {
    // The model's destructor uses the context of the thread, not the model's own one.
    Verilated::threadContextp(context_.get());
    model_->final();
  }

  Time run_clocks(Time limit) override {
    Verilated::threadContextp(context_.get());
    Model& m = *model_;
    while (clock_.next() <= limit) {
      const Time now = clock_.next();
      if (!clock_.edge()) {
        steps_.fall(m);
        continue;
      }
      if (std::exchange(moved_, false)) steps_.inputs(m);
      ++cycles_;
      // An edge transfers the levels that the pins have before it.
      const Outputs before = outputs_;
      const bool valid = m.s_axis_tvalid != 0;
      if (valid && m.rst_ni != 0) take_beat(now);
      const bool moves = !access_.done || late_ != 0;
      if (moves) look_at_answer();
      steps_.rise(m);
      if (moves && m.rst_ni != 0) drive();
      pack();
      if (outputs_ != before) return now;
    }
    return kNever;
  }

  void set_sl(Time /*now*/, unsigned line, bool level) override {
    if (line >= kChannels) return;
    const auto bit = static_cast<Slo>(1U << line);
    model_->slo_i = static_cast<Slo>(level ? model_->slo_i | bit : model_->slo_i & ~bit);
    steps_.slo(*model_);
  }
  void set_clock(Time now, std::uint64_t hz) override {
    if (min_clock_ == 0) return;
    clock_.retune(hz, now);
    may_run_at(hz);
  }
  unsigned half_clocks(unsigned /*line*/) const override {
    const unsigned half =
        (model_->rootp->axi_core__DOT__u_start__DOT__frame_q >> kHalfLenLsb) & 0xFFU;
    return half == 0 ? 1 : half;
  }

  unsigned channels() const override { return kChannels; }
  void set_reset(bool active) override {
    Verilated::threadContextp(context_.get());
    model_->rst_ni = active ? 0 : 1;
    late_ = 0;
    taken_ = false;
    steps_.inputs(*model_);
    pack();
  }
  void set_ext_sample_clk(bool level) override {
    model_->ext_sample_clk_i = level ? 1 : 0;
    moved_ = true;
  }
  void set_sample_en(bool level) override {
    model_->sample_en_i = level ? 1 : 0;
    moved_ = true;
  }
  void give_up() override {
    Model& m = *model_;
    m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
    moved_ = true;
    if (taken_) ++late_;
    taken_ = handed_ = fresh_ = false;
    access_.done = true;
  }
  bool ext_sample_clk() const override { return model_->ext_sample_clk_i != 0; }
  bool sample_en() const override { return model_->sample_en_i != 0; }
  bool slo(unsigned line) const override { return ((model_->slo_i >> line) & 1U) != 0; }

 private:
  void take_beat(Time now) {
    if (beats_.size() == kMostBeats) {
      beats_.pop_front();
      ++beats_dropped_;
    }
    StreamBeat& beat = beats_.emplace_back();
    beat.time = now;
    const auto& data = model_->s_axis_tdata;
    if constexpr (std::is_same_v<std::decay_t<decltype(data)>, IData>) {
      beat.words = {data};
    } else if constexpr (std::is_same_v<std::decay_t<decltype(data)>, QData>) {
      beat.words = {static_cast<std::uint32_t>(data), static_cast<std::uint32_t>(data >> 32U)};
    } else {
      beat.words.assign(std::begin(data.m_storage), std::end(data.m_storage));
    }
    beat.user = model_->s_axis_tuser;
    beat.last = model_->s_axis_tlast != 0;
    beat_ = !beat_;
  }

  // Looks, before an edge, at what the edge takes. BREADY and RREADY are always 1.
  void look_at_answer() {
    const Model& m = *model_;
    handed_ = (m.s_axi_awvalid != 0 && m.s_axi_awready != 0) ||
              (m.s_axi_arvalid != 0 && m.s_axi_arready != 0);
    taken_ = taken_ || handed_;
    if (m.s_axi_bvalid == 0 && m.s_axi_rvalid == 0) return;
    if (late_ != 0) {
      --late_;
      return;
    }
    taken_ = false;
    access_.answer = m.s_axi_bvalid != 0 ? m.s_axi_bresp : m.s_axi_rresp;
    if (!access_.write) access_.data = m.s_axi_rdata;
    access_.done = true;
    done_ = !done_;
  }

  // Drives the manager's pins after an edge.
  void drive() {
    Model& m = *model_;
    if (fresh_) {
      m.s_axi_awaddr = m.s_axi_araddr = access_.address;
      m.s_axi_wdata = access_.data;
      m.s_axi_wstrb = access_.strobe;
      m.s_axi_awvalid = m.s_axi_wvalid = access_.write ? 1 : 0;
      m.s_axi_arvalid = access_.write ? 0 : 1;
      fresh_ = false;
      moved_ = true;
    } else if (handed_) {
      m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
      handed_ = false;
      moved_ = true;
    }
  }

  void pack() {
    const Model& m = *model_;
    Outputs out = kAbsent;
    for (unsigned line = 0; line < kChannels; ++line) {
      if (((m.ma_o >> line) & 1U) != 0) out |= ma_of(line);
    }
    if (m.error_no != 0) out |= kError;
    if (m.warn_no != 0) out |= kWarn;
    if (m.sample_clk_o != 0) out |= kSampleClk;
    if (m.irq_o != 0) out |= kIrq;
    if (done_) out |= kDone;
    if (beat_) out |= kBeat;
    outputs_ = out;
  }

  // MA of lines that the model does not have.
  static constexpr Outputs kAbsent = [] {
    Outputs out = 0;
    for (unsigned line = kChannels; line < kAxiChannels; ++line) out |= ma_of(line);
    return out;
  }();

  std::unique_ptr<VerilatedContext> context_;
  std::unique_ptr<Model> model_;
  Steps steps_;
  ClockSource clock_;
  bool moved_ = false;   // inputs have changed since the last edge, beside SLO
  bool handed_ = false;  // the edge that is about to come takes address and data
  bool taken_ = false;   // the running access has been taken
  unsigned late_ = 0;    // answers of accesses that have been given up
  bool done_ = false;
  bool beat_ = false;
};

template <typename Model, unsigned kChannels, typename Steps>
std::unique_ptr<AxiModel> make(const ChipConfig& chip, std::uint64_t seed, bool plain) {
  if (plain) {
    return std::make_unique<VerilatedAxi<Model, kChannels, AxiWholeSteps<Model>>>(chip, seed);
  }
  return std::make_unique<VerilatedAxi<Model, kChannels, Steps>>(chip, seed);
}

}  // namespace

std::unique_ptr<AxiModel> make_axi_model(const ChipConfig& chip, unsigned channels,
                                         std::uint64_t seed, bool plain) {
  if (chip.features == kAxiFull) {
    if (channels <= 1) return make<Vaxi_full_1, 1, AxiWholeSteps<Vaxi_full_1>>(chip, seed, plain);
    if (channels <= 4) return make<Vaxi_full_4, 4, AxiWholeSteps<Vaxi_full_4>>(chip, seed, plain);
    return make<Vaxi_full_16, kAxiChannels, AxiWholeSteps<Vaxi_full_16>>(chip, seed, plain);
  }
  if (channels <= 1) return make<Vaxi_1, 1, Steps1>(chip, seed, plain);
  if (channels <= 4) return make<Vaxi_4, 4, Steps4>(chip, seed, plain);
  return make<Vaxi_16, kAxiChannels, Steps16>(chip, seed, plain);
}

}  // namespace mb4::sim
