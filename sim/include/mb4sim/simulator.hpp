// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One chip with its clock, reset, host and lines: the whole simulation. A process may hold any
// number of them, all used from one thread.
#ifndef MB4SIM_SIMULATOR_HPP_
#define MB4SIM_SIMULATOR_HPP_

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "mb4sim/event_queue.hpp"
#include "mb4sim/fault_injector.hpp"
#include "mb4sim/host_check.hpp"
#include "mb4sim/host_pins.hpp"
#include "mb4sim/line.hpp"
#include "mb4sim/ma_pulse_check.hpp"
#include "mb4sim/model_stopped.hpp"
#include "mb4sim/parallel_host.hpp"
#include "mb4sim/pins.hpp"
#include "mb4sim/scenario.hpp"
#include "mb4sim/slave.hpp"
#include "mb4sim/spi_host.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

class ChipModel;

struct SimulatorOptions {
  std::optional<std::uint64_t> seed;      // instead of the scenario's
  std::optional<std::string> trace_path;  // FST waveform file
  // The waveform holds only what is between these times, both included; the rest costs little.
  Time trace_from = 0;
  Time trace_to = kNever;
  // Evaluates every clock edge by Verilator's eval(), leaves out nothing: slower, same results.
  bool plain_evaluation = false;
};

class Simulator final : public HostPins {
 public:
  // Builds everything, resets the chip (NRES low for kResetLow) and returns at kReady.
  // Throws ScenarioError if the trace file cannot be written.
  explicit Simulator(const Scenario& scenario, const SimulatorOptions& options = {});
  ~Simulator();
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  static constexpr Time kResetLow = 500 * kPsPerNs;  // E08: at least 250 ns
  static constexpr Time kReady = 1000 * kPsPerNs;

  // --- time ----------------------------------------------------------------------------------
  Time now() const override { return now_; }
  // Runs up to and including `time`; nothing if it has passed. Everything that lets time pass or
  // moves a pin throws ModelStopped when an assertion in the RTL fails or a pulse at an MA pin is
  // too short (MaPulseCheck), and again at every later call. Not to be called from inside a
  // callback.
  void run_until(Time time) override;
  // Not beyond kEndOfTime.
  void advance(Time duration);
  // Runs until `done` returns true, asked after every event and every change of an output, but not
  // beyond `limit`. Returns whether it became true.
  bool run_while_waiting(const std::function<bool()>& done, Time limit);
  // Calls back at `time`, not before now().
  void at(Time time, std::function<void()> callback) { queue_.post(time, std::move(callback)); }
  // Rising edges of the chip's system clock: pin CLK or, with CLKENI = 1, the oscillator.
  std::uint64_t clk_cycles() const;
  // Those among them in which the chip was at rest and which were not simulated one by one.
  std::uint64_t clk_cycles_left_out() const;

  // --- pins ----------------------------------------------------------------------------------
  // Drives a pin from outside. It stays so until the next call. No effect on output pins, on SL of
  // a channel that the scenario has, and on CLK if it is connected. NER: false pulls it low, true
  // leaves it to the pull-up.
  void set_pin(Pin pin, bool level) override;
  // Level of any pin as a voltmeter would see it.
  bool pin(Pin pin) const override;
  // False for pins that set_pin() ignores.
  bool can_set(Pin pin) const;

  // --- hosts, lines, slaves ------------------------------------------------------------------
  // Hosts on the chip's pins. Which of them the chip listens to is a matter of the straps, which
  // the scenario's interface has set: spi() with CFGSPI = 1, spi2() beside it with NWR_E = 0, bus()
  // with CFGSPI = 0.
  SpiHost& spi() { return spi_; }
  SpiHost& spi2() { return spi2_; }
  ParallelHost& bus() { return bus_; }
  // What the host pins have done against the datasheet's limits so far.
  HostCheck& host_check() { return host_check_; }
  // Null if the scenario has no such channel (1 or 2).
  Line* line(unsigned channel);
  // Slave by the number of its SCDATAx, 1 to 8: channel 1 counts from 1; channel 2 from 5. Null if
  // there is none.
  Slave* slave(unsigned number);
  const Slave* slave(unsigned number) const;
  // Guard of pin MA of a channel (1 or 2), whether or not the scenario has that channel.
  MaPulseCheck& ma_check(unsigned channel) { return ma_checks_.at(channel - 1); }
  // Applies changed line faults (SlFaults::stick) to the SL pins now.
  void refresh_lines();

  // Faults of the scenario that have happened so far.
  const std::vector<FaultRecord>& faults() const { return injector_->records(); }

  const Scenario& scenario() const { return scenario_; }
  std::uint64_t seed() const { return seed_; }
  // Completes the waveform file as far as time has gone.
  void flush_trace();

 private:
  struct SlPin {
    Simulator* simulator;
    Pin pin;
  };
  static void on_probe(Time now, void* receiver);
  static void on_sl(Time now, void* receiver, bool level);

  void set_straps();
  bool step(Time limit);
  void drive_chip(Pin pin, bool level);
  void settle();
  void drive_line(std::size_t index, unsigned changed, unsigned outputs, unsigned ma, unsigned mo);
  void check_ma(std::size_t index, bool level);
  void check_alive() const;

  Scenario scenario_;
  std::uint64_t seed_;
  EventQueue queue_;
  std::unique_ptr<ChipModel> chip_;
  std::array<SlPin, 2> sl_pins_;
  std::array<std::unique_ptr<Line>, 2> lines_;
  std::array<MaPulseCheck, 2> ma_checks_;
  SpiHost spi_;
  SpiHost spi2_;
  ParallelHost bus_;
  HostCheck host_check_;
  std::unique_ptr<FaultInjector> injector_;
  Time now_ = 0;
  unsigned seen_ = 0;  // watched outputs that have been acted upon
  bool settling_ = false;
  bool paired_ = false;            // MA2 is the inverse of MA1 (CFGIF)
  bool ner_pulled_ = false;        // by something outside
  std::array<bool, 32> levels_{};  // of input pins, by Pin
  std::optional<ModelStopped> stopped_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_SIMULATOR_HPP_
