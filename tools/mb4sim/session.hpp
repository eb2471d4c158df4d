// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A scenario with a host that reads all its slaves through the driver, frame by frame: what `run`
// and `regress` have in common.
#ifndef MB4SIM_TOOL_SESSION_HPP_
#define MB4SIM_TOOL_SESSION_HPP_

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chip_setup.hpp"
#include "mb4/device.hpp"
#include "mb4sim/simulator.hpp"
#include "report/fault_report.hpp"
#include "report/frame_report.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim_bus.hpp"

namespace mb4::tool {

struct SessionFrame {
  std::uint64_t number = 1;
  sim::Time begin = 0;  // when the host asked for it
  sim::Time end = 0;    // when the host had the results
  // By slave, in the order of Session::slaves().
  std::vector<Result<Reading>> results;
  std::vector<std::optional<std::uint64_t>> sent;  // the slave's word, where it is known

  SlaveOutcome::Kind kind(std::size_t index) const;
  bool bad() const;
  std::vector<SlaveOutcome> outcomes(const std::vector<ConnectedSlave>& slaves) const;
};

class Session {
 public:
  // Throws sim::ScenarioError, sim::TraceError, sim::ModelStopped, as every call.
  Session(const sim::Scenario& scenario, const sim::SimulatorOptions& options,
          bool bus_log = false);

  Result<void> configure() { return device_.configure(config_); }
  SessionFrame read(std::uint64_t number);
  // Adds a frame to the report, and makes the register access that a fault of an ID needs.
  void report(const SessionFrame& frame, FaultReport& faults);

  const std::vector<ConnectedSlave>& slaves() const { return slaves_; }
  sim::Simulator& simulator() { return simulator_; }
  RunSummary summary() const;
  // What the driver has sent and received since the last call.
  std::string take_bus_log() { return std::exchange(bus_log_, {}); }

 private:
  std::string check_id(unsigned slave);
  // nullptr: the slave is a sensor.
  const sim::Actuator* actuator(const ConnectedSlave& slave) const;
  Result<void> write_actuators();
  void wait_for_actuators();

  Config config_;
  sim::Simulator simulator_;
  std::vector<ConnectedSlave> slaves_;
  std::array<std::uint64_t, kSlaves + 1> set_points_{};  // of actuators, by slave
  std::string bus_log_;
  SimBus bus_;
  SimClock clock_;
  Device<SimBus, SimClock> device_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_SESSION_HPP_
