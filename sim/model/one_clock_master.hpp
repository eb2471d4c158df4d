// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A Verilated master that has one clock and is on AXI4-Lite: its clock, its rest, its accesses and
// its waveform. `Interface` is the master's own: a MasterModel and a WordManager. `Counts`: what
// moves while it is at rest (ModelRest). `Self`, the class that is made of it, evaluates the model:
//
//   void before(Time now)   before a rising edge: inputs that wait, and what the edge transfers
//   void rise()             an edge
//   void fall()             an edge
//   void passed()           clocks were left out
//   void answered()         the access has ended
//   void moved()            pins of the bus have changed, and the next edge sees it
//   void pack()             sets outputs_
//   void changed(Outputs)   an edge has changed outputs_, from these
#ifndef MB4SIM_MODEL_ONE_CLOCK_MASTER_HPP_
#define MB4SIM_MODEL_ONE_CLOCK_MASTER_HPP_

#include <verilated.h>

#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/core/trace_file.hpp"
#include "sim/model/axi_lite_manager.hpp"
#include "sim/model/clock_loop.hpp"
#include "sim/model/clock_source.hpp"
#include "sim/model/model_rest.hpp"
#include "sim/model/model_wave.hpp"
#include "sim/model/verilated_context.hpp"

namespace mb4::sim {

template <typename Self, typename Interface, typename Model, typename Counts>
class OneClockMaster : public Interface {
  using Outputs = typename Interface::Outputs;
  using Access = std::remove_cvref_t<decltype(std::declval<const Interface&>().access())>;

 public:
  Time run_clocks(Time limit) override {
    Verilated::threadContextp(context_.get());
    return wave_.on() ? run<true>(limit) : run<false>(limit);
  }
  void set_clock(Time now, std::uint64_t hz) override {
    if (this->min_clock_ == 0) return;
    rest_.stirred();
    clock_.retune(hz, now);
    this->may_run_at(hz);
  }
  std::uint64_t left_out() const override { return rest_.left_out(); }

  void begin(const Access& access) override {
    access_ = access;
    access_.done = false;
    fresh_ = true;
    rest_.stirred();
  }
  const Access& access() const override { return access_; }
  void give_up() override {
    manager_.drop(*model_);
    move();
    fresh_ = false;
    access_.done = true;
  }

  void set_probes(Time now, std::uint64_t arrived, std::uint64_t sent,
                  std::uint64_t ready) override {
    wave_.set_probes(now, {arrived, sent, ready});
  }
  void stop_wave() override { wave_.stop(); }
  void finish_trace() override { wave_.flush(); }

 protected:
  // `plain`: no clock is left out.
  OneClockMaster(std::uint64_t f_clk_hz, std::uint64_t seed, bool plain, const char* name)
      : context_(make_verilated_context(seed)),
        model_(std::make_unique<Model>(context_.get(), name)),
        clock_(f_clk_hz),
        rest_(plain) {
    this->min_clock_ = Interface::period_of(f_clk_hz);
    manager_.rest(*model_);
  }
  ~OneClockMaster() override {
    // The model's destructor uses the context of the thread, not the model's own one.
    Verilated::threadContextp(context_.get());
    model_->final();
  }

  // Only an edge resets the flops of a Verilated model, and the synchronisers must be released
  // before it. `reset(active)` sets the pins. Assertions are off meanwhile, because random values
  // are not a valid state.
  template <typename Reset>
  void reset_by_edges(Reset reset) {
    context_->assertOn(false);
    reset(false);
    for (const unsigned level : {0U, 1U, 0U, 1U, 0U}) {
      model_->clk_i = static_cast<CData>(level);
      model_->eval();
    }
    reset(true);
    self().evaluate();
    context_->assertOn(true);
    self().pack();
  }
  // A pin has changed that acts without a clock. Edges that it makes are none of a pulse.
  template <typename Change>
  void change_at_once(Time now, Change change) {
    Verilated::threadContextp(context_.get());
    const Outputs before = this->outputs_;
    change();
    self().evaluate();
    self().pack();
    this->cut_ |= this->outputs_ & ~before;
    rest_.stirred();
    show(now);
  }
  // Inputs have changed, and the next edge sees it.
  void move() {
    self().moved();
    rest_.stirred();
  }
  // An access runs, or an answer is still to come.
  bool busy() const { return !access_.done || manager_.owed(); }
  void show(Time now) { wave_.show(now); }
  // A waveform from now on, with the signals of the encoders between pins and registers.
  void begin_wave(const TraceFile& file, const char* title, std::vector<WaveSignal> signals,
                  const std::vector<WaveSignal>& encoders) {
    rest_.stirred();
    wave_.begin(file, title, std::move(signals), encoders);
  }

  std::unique_ptr<VerilatedContext> context_;
  std::unique_ptr<Model> model_;
  AxiLiteManager<Model> manager_;
  ClockSource clock_;
  ModelRest<std::remove_pointer_t<decltype(Model::rootp)>, Counts> rest_;
  ModelWave wave_;

 private:
  Self& self() { return static_cast<Self&>(*this); }

  template <bool kWave>
  Time run(Time limit) {
    return run_edges(
        clock_, limit, [ this, limit ](Time now, bool rises) __attribute__((always_inline)) {
          const bool changes = rises ? rise(now) : fall(limit, kWave);
          if constexpr (kWave) wave_.show(now);
          return changes;
        });
  }
  // True: an output has changed.
  bool rise(Time now) {
    Model& m = *model_;
    // An edge transfers the levels that the pins have before it.
    const Outputs before = this->outputs_;
    self().before(now);
    ++this->cycles_;
    const bool moves = busy();
    if (moves && manager_.before(m, access_)) {
      access_.done = true;
      self().answered();
    }
    self().rise();
    if (moves && m.rst_ni != 0) drive();
    self().pack();
    if (this->outputs_ == before) return false;
    rest_.stirred();
    self().changed(before);
    return true;
  }
  // No output changes. With a waveform each edge is shown.
  bool fall(Time limit, bool all) {
    self().fall();
    if (all) return false;
    const std::uint64_t clocks = rest_.falls(*model_->rootp, clock_, limit);
    if (clocks == 0) return false;
    this->cycles_ += clocks;
    self().passed();
    return false;
  }
  // Drives the manager's pins after an edge.
  void drive() {
    if (std::exchange(fresh_, false)) {
      manager_.begin(*model_, access_);
    } else if (!manager_.after(*model_)) {
      return;
    }
    move();
  }

  Access access_;
  bool fresh_ = false;  // the access has not been put on the pins
};

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_ONE_CLOCK_MASTER_HPP_
