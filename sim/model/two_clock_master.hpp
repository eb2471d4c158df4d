// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A Verilated master whose bus has another clock than its core: its clocks, its accesses and its
// waveform. `Interface` is the master's own: a MasterModel and a WordManager. `Manager` drives the
// pins of the bus:
//
//   rest(model)            the levels without an access
//   clock(model, level)    the clock of the bus
//   reset(model, active)
//   begin(model, access)   after an edge: the access is on the pins
//   before(model, access)  before a rising edge: what the edge transfers. True: the access is done,
//                          and `access` has the answer
//   after(model)           after that edge
//   drop(model)            the manager gives the access up
//   owed()                 an answer of such an access is still to come
//
// `Self`, the class that is made of it, has
//
//   Outputs pack() const          the outputs but kAnswered
//   bool falls_quietly()          after a falling edge alone: true if it cannot change anything,
//   and
//                                 the model has been told of it
#ifndef MB4SIM_MODEL_TWO_CLOCK_MASTER_HPP_
#define MB4SIM_MODEL_TWO_CLOCK_MASTER_HPP_

#include <verilated.h>

#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include "sim/model/clock_loop.hpp"
#include "sim/model/clock_source.hpp"
#include "sim/model/model_wave.hpp"
#include "sim/model/verilated_context.hpp"

namespace mb4::sim {

template <typename Self, typename Interface, typename Model, typename Manager>
class TwoClockMaster : public Interface {
  using Access = std::remove_cvref_t<decltype(std::declval<const Interface&>().access())>;

 public:
  using Outputs = typename Interface::Outputs;

  Time run_clocks(Time limit) override {
    Verilated::threadContextp(context_.get());
    return run_edges(core_, bus_, limit, [this](Time now, bool of_core, bool of_bus) {
      Model& m = *model_;
      bool rises = false;
      if (of_bus) {
        rises = bus_.edge();
        manager_.clock(m, rises);
        if (rises && (!access_.done || manager_.owed())) take_answer();
      }
      if (of_core) {
        m.clk_i = core_.edge();
        this->cycles_ += m.clk_i;
      }
      if (!rises && !(of_core && m.clk_i != 0) && self().falls_quietly()) {
        show(now);
        return false;
      }
      context_->time(now);
      m.eval();
      if (rises) drive();
      const Outputs before = std::exchange(this->outputs_, all());
      show(now);
      return this->outputs_ != before;
    });
  }
  void set_clock(Time now, std::uint64_t hz) override {
    core_.retune(hz, now);
    this->may_run_at(hz);
  }

  void begin(const Access& access) override {
    access_ = access;
    access_.done = false;
    fresh_ = true;
  }
  const Access& access() const override { return access_; }
  void give_up() override {
    manager_.drop(*model_);
    access_.done = true;
    fresh_ = false;
  }

  void set_probes(Time now, std::uint64_t arrived, std::uint64_t sent,
                  std::uint64_t ready) override {
    wave_.set_probes(now, {arrived, sent, ready});
  }
  void finish_trace() override { wave_.flush(); }

 protected:
  TwoClockMaster(std::uint64_t core_hz, std::uint64_t bus_hz, std::uint64_t seed, const char* name)
      : context_(make_verilated_context(seed)),
        model_(std::make_unique<Model>(context_.get(), name)),
        core_(core_hz),
        bus_(bus_hz) {
    this->min_clock_ = Interface::period_of(core_hz);
    context_->timeunit(-12);
    context_->timeprecision(-12);
    manager_.rest(*model_);
  }
  ~TwoClockMaster() override {
    // The model's destructor uses the context of the thread, not the model's own one.
    Verilated::threadContextp(context_.get());
    model_->final();
  }

  // Only an edge resets the flops of a Verilated model. So the reset is off for a few clocks first.
  // `reset(active)` sets its pins. Assertions are off meanwhile, because random values are not a
  // valid state.
  template <typename Reset>
  void reset_by_edges(Reset reset) {
    Model& m = *model_;
    context_->assertOn(false);
    reset(false);
    for (unsigned i = 0; i < kConditioningEdges; ++i) {
      m.clk_i = i % 2 == 0;
      manager_.clock(m, i % 2 == 0);
      m.eval();
    }
    reset(true);
    m.eval();
    context_->assertOn(true);
  }
  // A pin has changed that acts without a clock.
  void evaluate(Time now) {
    Verilated::threadContextp(context_.get());
    context_->time(now);
    model_->eval();
    this->outputs_ = all();
    show(now);
  }
  void show(Time now) { wave_.show(now); }

  std::unique_ptr<VerilatedContext> context_;  // outlives the model
  std::unique_ptr<Model> model_;
  Manager manager_;
  ModelWave wave_;

 private:
  // After these the synchronisers of the resets have settled from any state.
  static constexpr unsigned kConditioningEdges = 32;

  Self& self() { return static_cast<Self&>(*this); }
  Outputs all() const {
    return static_cast<const Self&>(*this).pack() | (answered_ ? Interface::kAnswered : 0);
  }
  // Before a rising edge of the bus.
  void take_answer() {
    if (manager_.before(*model_, access_)) {
      access_.done = true;
      answered_ = !answered_;
    }
  }
  // After it.
  void drive() {
    manager_.after(*model_);
    if (fresh_) manager_.begin(*model_, access_);
    fresh_ = false;
  }

  ClockSource core_;
  ClockSource bus_;
  Access access_;
  bool fresh_ = false;  // the access has not been put on the pins
  bool answered_ = false;
};

}  // namespace mb4::sim

#endif  // MB4SIM_MODEL_TWO_CLOCK_MASTER_HPP_
