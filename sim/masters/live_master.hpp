// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A master in a simulation: its model, its pins, and the hosts that it offers.
#ifndef MB4SIM_LIVE_MASTER_HPP_
#define MB4SIM_LIVE_MASTER_HPP_

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "sim/core/trace_error.hpp"
#include "sim/core/trace_file.hpp"
#include "sim/hosts/host_check.hpp"
#include "sim/hosts/host_config.hpp"
#include "sim/hosts/host_pins.hpp"
#include "sim/masters/chip_config.hpp"
#include "sim/masters/hint.hpp"
#include "sim/masters/master_model.hpp"

namespace mb4::sim {

// The time that a model is in reset before it starts.
inline constexpr Time kResetLow = 500 * kPsPerNs;

// What a master is made from. `outside`, the scenario's parts and the file live as long as the
// master.
struct MasterSetup {
  const ChipConfig& chip;
  const HostConfig& host;
  // All bits of the lines that the scenario has.
  MasterModel::Outputs lines;
  // Time and pins for its hosts. Must not be used before power_on().
  HostPins& outside;
  std::uint64_t seed;
  const TraceFile* trace;  // null: no waveform
  bool plain;              // evaluate every clock in the simplest way
};

class LiveMaster {
 public:
  LiveMaster() = default;
  LiveMaster(const LiveMaster&) = delete;
  LiveMaster& operator=(const LiveMaster&) = delete;
  virtual ~LiveMaster() = default;

  virtual MasterModel& model() = 0;
  // Sets straps and ends the reset, through `outside`. It returns before Simulator::kReady.
  virtual void power_on() = 0;

  // --- pins: only those that pin_by_name() of the master names -----------------------------------
  // False for pins that set_pin() ignores.
  virtual bool can_set(Pin /*pin*/) const { return false; }
  virtual void set_pin(Time /*now*/, Pin /*pin*/, bool /*level*/) {}
  virtual bool pin(Pin /*pin*/) const { return false; }
  // Bits of the master's own in outputs() have changed.
  virtual void own_outputs_changed(Time /*now*/, MasterModel::Outputs /*changed*/) {}

  // See Simulator::set_observer().
  virtual void set_observer(PinObserver* /*observer*/) {}

  // --- waveform of a part of the run -------------------------------------------------------------
  // From now on model() is another one. Throws TraceError if the file cannot be written, or if the
  // master has no waveform; then nothing has changed.
  virtual void start_trace(const TraceFile& file) {
    throw TraceError(file.path + ": this master writes no waveform");
  }
  // Completes the file. model() is another one again.
  virtual void stop_trace() {}

  // --- hosts -------------------------------------------------------------------------------------
  // The host of a name, for example "spi". Null if the master has none of this name.
  virtual HostModel* host(std::string_view name) = 0;
  // What the host has done wrong at the pins so far.
  virtual HostCheck& host_check() { return nothing_wrong_; }
  // What the host has told the master that does not fit its lines (hint.hpp). Bit n of `missed`:
  // the host wants the words of slave n + 1 and has not got them. Without any bit a master assumes
  // that the host wants what it has asked the master for.
  virtual std::vector<Hint> hints(std::span<const HintLine> /*lines*/, std::uint64_t /*missed*/) {
    return {};
  }
  // A fault: the host's next transfer ends after `bits` clocks. For interfaces that can abort.
  virtual void abort_transfer(std::uint64_t /*bits*/) {}

 private:
  HostCheck nothing_wrong_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_LIVE_MASTER_HPP_
