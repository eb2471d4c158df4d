// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole simulation: one master with its clock, reset, hosts and lines. A process may hold any
// number of simulators. All of them are used from one thread.
#ifndef MB4SIM_SIMULATOR_HPP_
#define MB4SIM_SIMULATOR_HPP_

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <typeinfo>
#include <utility>
#include <vector>

#include "mb4sim/model_stopped.hpp"
#include "sim/core/event_queue.hpp"
#include "sim/core/time.hpp"
#include "sim/faults/fault_injector.hpp"
#include "sim/hosts/host_check.hpp"
#include "sim/hosts/host_pins.hpp"
#include "sim/hosts/parallel_host.hpp"
#include "sim/hosts/spi_host.hpp"
#include "sim/hosts/word_host.hpp"
#include "sim/lines/line.hpp"
#include "sim/lines/slave.hpp"
#include "sim/masters/live_master.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4::sim {

class SimulatorFaults;

struct SimulatorOptions {
  std::optional<std::uint64_t> seed;      // replaces the scenario's seed
  std::optional<std::string> trace_path;  // FST waveform file
  // The waveform holds only the time between these two, both included. The rest costs little.
  Time trace_from = 0;
  Time trace_to = kNever;
  // true: every clock edge is evaluated and nothing is left out. This is slower and gives the same
  // results.
  bool plain_evaluation = false;
};

class Simulator final : public HostPins, private LineMaster {
 public:
  // Builds everything, resets the master and returns at time kReady.
  // Throws TraceError if the trace file cannot be written.
  explicit Simulator(const Scenario& scenario, const SimulatorOptions& options = {});
  ~Simulator();
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  static constexpr Time kReady = 1000 * kPsPerNs;

  // --- time ----------------------------------------------------------------------------------
  // Time since power-on, ps.
  Time now() const override { return now_; }
  // Runs up to and including `time`. Does nothing if `time` has passed. Must not be called from
  // inside a callback.
  //
  // Every call that lets time pass or moves a pin throws ModelStopped when an assertion in the RTL
  // fails or the master breaks a rule of a line (LineMaster::stop()). Every later such call throws
  // it again.
  void run_until(Time time) override;
  // Lets `duration` ps pass, but not beyond kEndOfTime.
  void advance(Time duration);
  // Runs until `done` returns true, at most up to `limit`. `done` is called after every event and
  // every change of an output. Returns whether `done` became true.
  bool run_while_waiting(const std::function<bool()>& done, Time limit);
  // Calls `callback` at `time`, which must not be before now().
  void at(Time time, std::function<void()> callback) { queue_.post(time, std::move(callback)); }
  // Number of rising edges of the master's system clock, whatever its source is.
  std::uint64_t clk_cycles() const;
  // Number of those edges that were not simulated one by one because the master was at rest.
  std::uint64_t clk_cycles_left_out() const;

  // --- pins ----------------------------------------------------------------------------------
  // Each master has pins of its own (Master::pin_by_name).
  std::optional<Pin> pin_by_name(std::string_view name) const;
  // Drives a pin from outside. The pin keeps this level until the next call. The call has no effect
  // on pins that something else drives, for example the input from a line of the scenario.
  void set_pin(Pin pin, bool level) override;
  // Level of any pin as a voltmeter would show it.
  bool pin(Pin pin) const override;
  // True if the pins of a line are the inverse of those of another one, a differential pair. Then
  // nothing of that channel is connected.
  bool paired() const { return followers_ != 0; }
  // False for pins that set_pin() ignores.
  bool can_set(Pin pin) const;
  // Tells the observer the levels of all pins that set_pin() drives and of Master::end_pin, at once
  // and then at every change. Null: no observer. The observer must live as long as it is set.
  void set_observer(PinObserver* observer);

  // --- hosts, lines, slaves ------------------------------------------------------------------
  // A host that the master offers, by its name and class. Null if there is none.
  template <typename Host>
  Host* find_host(std::string_view name) {
    return dynamic_cast<Host*>(master_->host(name));
  }
  // The same for callers that know the master. Throws std::bad_cast if there is none.
  template <typename Host>
  Host& host(std::string_view name) {
    auto* found = find_host<Host>(name);
    if (found == nullptr) throw std::bad_cast();
    return *found;
  }
  // The hosts whose names most masters share.
  SpiHost& spi() { return host<SpiHost>("spi"); }
  SpiHost& spi2() { return host<SpiHost>("spi2"); }
  ParallelHost& bus() { return host<ParallelHost>("bus"); }
  // The host on the bus of 32-bit words that the scenario's interface names. Null if it is none.
  // "words": words that another host carries.
  WordHost* word_bus() {
    auto* found = find_host<WordHost>(scenario_.host.interface.key);
    return found != nullptr ? found : find_host<WordHost>("words");
  }
  // Violations of the master's limits at the host pins so far.
  HostCheck& host_check() { return master_->host_check(); }
  // What does not fit between the master, as its host has told it, and the lines as they are now.
  // Bit n of `missed`: the host wants the word of slave n + 1 and has not got it right.
  std::vector<Hint> hints(std::uint64_t missed = 0);
  // The line of a channel, from 1 on. Null if the scenario does not have this channel.
  Line* line(unsigned channel);
  // A slave by its number from 1 on: Master::first_slave() says where a channel begins. Null if
  // there is no such slave.
  Slave* slave(unsigned number);
  const Slave* slave(unsigned number) const;
  // The master's end of a channel, 1 to the number of the master's channels. It exists also for a
  // channel that the scenario does not have.
  LineEnd& line_end(unsigned channel) { return *lines_.at(channel - 1).end; }
  // What the master drives on a channel: the bits of its kind of line.
  unsigned outputs(unsigned channel) const {
    return static_cast<unsigned>(model_->outputs() >> MasterModel::kBitsOfLine * (channel - 1)) &
           MasterModel::kLevels;
  }
  // Applies at once the faults of lines that were set without a time.
  void refresh_lines();

  // Faults of the scenario that have happened so far.
  const std::vector<FaultRecord>& faults() const { return injector_->records(); }
  // Adds the faults and cable events of a text (parse_injection()). Its times count from now().
  // They become part of scenario().faults. Throws ScenarioError, and then adds nothing. Must not be
  // called from inside a callback.
  void inject(std::string_view text);

  const Scenario& scenario() const { return scenario_; }
  std::uint64_t seed() const { return seed_; }
  // Writes the waveform file completely up to the present time.
  void flush_trace();
  // Begins a waveform now, in a simulator without SimulatorOptions::trace_path. It changes nothing
  // in the simulation, which is slower meanwhile. Throws TraceError if the file cannot be written,
  // if the master or this build writes no waveform, and if one is being written; then nothing has
  // changed. Must not be called from inside a callback.
  void start_trace(const std::string& path);
  // Ends that waveform and completes its file. Returns false if there is none.
  bool stop_trace();

 private:
  friend class SimulatorFaults;
  // A channel of the master.
  struct Place {
    std::unique_ptr<LineEnd> end;
    Line* line = nullptr;  // the same; null if the scenario does not have this channel
  };
  static void on_probe(Time now, void* receiver);
  void set_probes(Line::Probe probe);
  void set_inputs(Time now, unsigned line, unsigned levels) override;
  [[noreturn]] void stop(const std::string& reason) override;

  bool step(Time limit);
  void settle();
  void use_model();
  void change_followers();
  void lines_changed(MasterModel::Outputs changed, MasterModel::Outputs levels);
  void check_alive() const;

  Scenario scenario_;
  std::uint64_t seed_;
  EventQueue queue_;
  std::vector<Place> lines_;
  TraceFile trace_;
  std::unique_ptr<LiveMaster> master_;
  MasterModel* model_ = nullptr;  // of master_
  std::unique_ptr<SimulatorFaults> fault_target_;
  std::unique_ptr<FaultInjector> injector_;
  Time now_ = 0;
  MasterModel::Outputs seen_ = 0;  // outputs that have been handled
  MasterModel::Outputs followers_ = 0;
  bool settling_ = false;
  bool tracing_ = false;  // a waveform is being written
  bool part_ = false;     // it is one of start_trace()
  std::optional<ModelStopped> stopped_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_SIMULATOR_HPP_
