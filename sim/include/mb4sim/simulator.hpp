// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole simulation: one chip with its clock, reset, host and lines. A process may hold any
// number of simulators. All of them are used from one thread.
#ifndef MB4SIM_SIMULATOR_HPP_
#define MB4SIM_SIMULATOR_HPP_

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "mb4sim/model_stopped.hpp"
#include "sim/core/event_queue.hpp"
#include "sim/core/time.hpp"
#include "sim/faults/fault_injector.hpp"
#include "sim/hosts/host_check.hpp"
#include "sim/hosts/host_pins.hpp"
#include "sim/hosts/parallel_host.hpp"
#include "sim/hosts/pins.hpp"
#include "sim/hosts/spi_host.hpp"
#include "sim/lines/line.hpp"
#include "sim/lines/ma_pulse_check.hpp"
#include "sim/lines/slave.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::sim {

class ChipModel;
class SimulatorFaults;

struct SimulatorOptions {
  std::optional<std::uint64_t> seed;      // replaces the scenario's seed
  std::optional<std::string> trace_path;  // FST waveform file
  // The waveform holds only the time between these two, both included. The rest costs little.
  Time trace_from = 0;
  Time trace_to = kNever;
  // true: Verilator's eval() evaluates every clock edge and nothing is left out. This is slower and
  // gives the same results.
  bool plain_evaluation = false;
};

class Simulator final : public HostPins {
 public:
  // Builds everything, resets the chip (NRES low for kResetLow) and returns at time kReady.
  // Throws TraceError if the trace file cannot be written.
  explicit Simulator(const Scenario& scenario, const SimulatorOptions& options = {});
  ~Simulator();
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  static constexpr Time kResetLow = 500 * kPsPerNs;  // E08: at least 250 ns
  static constexpr Time kReady = 1000 * kPsPerNs;

  // --- time ----------------------------------------------------------------------------------
  // Time since power-on, ps.
  Time now() const override { return now_; }
  // Runs up to and including `time`. Does nothing if `time` has passed. Must not be called from
  // inside a callback.
  //
  // Every call that lets time pass or moves a pin throws ModelStopped when an assertion in the RTL
  // fails or a pulse at an MA pin is too short (MaPulseCheck). Every later such call throws it
  // again.
  void run_until(Time time) override;
  // Lets `duration` ps pass, but not beyond kEndOfTime.
  void advance(Time duration);
  // Runs until `done` returns true, at most up to `limit`. `done` is called after every event and
  // every change of an output. Returns whether `done` became true.
  bool run_while_waiting(const std::function<bool()>& done, Time limit);
  // Calls `callback` at `time`, which must not be before now().
  void at(Time time, std::function<void()> callback) { queue_.post(time, std::move(callback)); }
  // Number of rising edges of the chip's system clock, which is pin CLK or, with CLKENI = 1, the
  // oscillator.
  std::uint64_t clk_cycles() const;
  // Number of those edges that were not simulated one by one because the chip was at rest.
  std::uint64_t clk_cycles_left_out() const;

  // --- pins ----------------------------------------------------------------------------------
  // Drives a pin from outside. The pin keeps this level until the next call. The call has no effect
  // on output pins, on SL of a channel that the scenario has, and on CLK if it is connected. At NER
  // false pulls the pin low and true leaves it to the pull-up. With CFGIF = 10 or 11 channel 1 also
  // drives SL2_NSL1 with the inverse of SL1, unless the scenario has channel 2.
  void set_pin(Pin pin, bool level) override;
  // Level of any pin as a voltmeter would show it.
  bool pin(Pin pin) const override;
  // True if CFGIF makes the pins of line 2 the inverse of those of line 1. Then nothing of channel
  // 2 is connected.
  bool paired() const { return paired_; }
  // False for pins that set_pin() ignores.
  bool can_set(Pin pin) const;
  // Tells the observer the levels of all pins that set_pin() drives and of EOT, at once and then at
  // every change. Null: nobody. The observer must live as long as it is set.
  void set_observer(PinObserver* observer);

  // --- hosts, lines, slaves ------------------------------------------------------------------
  // Hosts on the chip's pins. The straps, which the scenario's interface has set, decide which of
  // them the chip listens to: spi() with CFGSPI = 1, spi2() in addition with NWR_E = 0, bus() with
  // CFGSPI = 0.
  SpiHost& spi() { return spi_; }
  SpiHost& spi2() { return spi2_; }
  ParallelHost& bus() { return bus_; }
  // Violations of the datasheet's limits at the host pins so far.
  HostCheck& host_check() { return host_check_; }
  // The line of channel 1 or 2. Null if the scenario does not have this channel.
  Line* line(unsigned channel);
  // A slave by the number of its SCDATAx, 1 to 8. Channel 1 counts from 1, channel 2 from 5. Null
  // if there is no such slave.
  Slave* slave(unsigned number);
  const Slave* slave(unsigned number) const;
  // Guard of pin MA of a channel (1 or 2). It exists also for a channel that the scenario does not
  // have.
  MaPulseCheck& ma_check(unsigned channel) { return ma_checks_.at(channel - 1); }
  // Applies changed line faults (SlFaults::stick) to the SL pins at once.
  void refresh_lines();

  // Faults of the scenario that have happened so far.
  const std::vector<FaultRecord>& faults() const { return injector_->records(); }

  const Scenario& scenario() const { return scenario_; }
  std::uint64_t seed() const { return seed_; }
  // Writes the waveform file completely up to the present time.
  void flush_trace();

 private:
  friend class SimulatorFaults;
  struct SlPin {
    Simulator* simulator;
    Pin pin;
  };
  static void on_probe(Time now, void* receiver);
  static void on_sl(Time now, void* receiver, bool level);
  bool drives_pair() const { return paired_ && lines_[0] != nullptr && lines_[1] == nullptr; }
  void drive_sl(Pin pin, bool level);

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
  std::unique_ptr<SimulatorFaults> fault_target_;
  std::unique_ptr<FaultInjector> injector_;
  Time now_ = 0;
  PinObserver* observer_ = nullptr;
  unsigned seen_ = 0;  // watched outputs that have been handled
  bool settling_ = false;
  bool paired_ = false;            // MA2 is the inverse of MA1 (CFGIF)
  bool ner_pulled_ = false;        // by something outside
  std::array<bool, 32> levels_{};  // of input pins, index is Pin
  std::optional<ModelStopped> stopped_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_SIMULATOR_HPP_
