// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bridge's protocol (docs/bridge.md) on one connection: it takes bytes of requests and returns
// bytes of answers. It does not use sockets; bytes may come in portions of any size.
#ifndef MB4SIM_TOOL_BRIDGE_SESSION_HPP_
#define MB4SIM_TOOL_BRIDGE_SESSION_HPP_

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bridge/spi_port.hpp"
#include "masters/mb4/sim_bus.hpp"
#include "mb4sim/simulator.hpp"
#include "report/pair_warning.hpp"

namespace mb4::tool {

// How simulated time passes in addition to the time of the requests.
enum class Pace {
  kRequests,  // not at all
  kGaps,      // kRequestGap before each request, as a system call would take
  kWall,      // as the program's real time: from each answer to the next request
};

// The chip that all connections share.
class BridgeChip {
 public:
  static constexpr sim::Time kRequestGap = 10 * sim::kPsPerUs;

  BridgeChip(sim::Simulator& simulator, Pace pace);

  // Lets the time of `pace` pass before a request that drives pins or frames (P, S, X, T, M).
  void keep_pace();
  void answered() {
    last_answer_ = std::chrono::steady_clock::now();
    pairs_.look();
  }

  sim::Simulator& simulator() { return simulator_; }
  SimBus& bus() { return bus_; }
  // Throws RefusedValue on a parallel bus.
  SpiPort& port();
  // The text of the assertion that has ended the simulation.
  const std::optional<std::string>& stopped() const { return stopped_; }
  void set_stopped(const std::string& text) { stopped_ = text; }

 private:
  sim::Simulator& simulator_;
  Pace pace_;
  SimBus bus_;
  SpiPort port_;
  std::chrono::steady_clock::time_point last_answer_;
  std::optional<std::string> stopped_;
  PairWarning pairs_;
};

class BridgeSession {
 public:
  enum class Status : std::uint8_t {
    kDone = 0,
    kMalformed = 1,  // unknown request or wrong length
    kRefused = 2,    // a value that is not possible
    kStopped = 3,    // an assertion in the RTL has ended the simulation
  };
  static constexpr std::size_t kHeader = 3;  // request or status, length, low byte first
  static constexpr std::size_t kMaxPayload = 0xFFFF;
  static constexpr std::uint16_t kVersion = 1;

  explicit BridgeSession(BridgeChip& chip) : chip_(chip) {}

  // Takes bytes and carries out every request that is complete. Returns the answers.
  std::vector<std::uint8_t> feed(std::span<const std::uint8_t> bytes);
  // After the connection was closed: ends a frame that it has left open.
  void close();

 private:
  using Payload = std::span<const std::uint8_t>;

  void execute(char request, Payload payload, std::vector<std::uint8_t>& answer);
  void set_pin(Payload payload);
  void read_pin(Payload payload, std::vector<std::uint8_t>& answer);
  void select(Payload payload);
  void bytes(Payload payload, std::vector<std::uint8_t>& answer);
  void set(Payload payload);
  void message(Payload payload, std::vector<std::uint8_t>& answer);

  BridgeChip& chip_;
  std::vector<std::uint8_t> waiting_;  // the beginning of a request
  bool open_ = false;                  // this connection has left NCS low
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_BRIDGE_SESSION_HPP_
