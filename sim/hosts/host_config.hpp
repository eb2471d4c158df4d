// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// How a host is connected to a master: the part [host] of a scenario.
#ifndef MB4SIM_HOST_CONFIG_HPP_
#define MB4SIM_HOST_CONFIG_HPP_

#include <cstdint>
#include <string_view>

#include "sim/core/scenario_error.hpp"
#include "sim/core/time.hpp"

namespace mb4::sim {

// The connection of the host. kSpi2: SPI with the second serial interface enabled.
enum class HostInterface { kSpi, kSpi2, kIntel, kMotorola };

// One connection and what it can do.
struct HostKind {
  HostInterface interface;
  std::string_view key;  // value of `interface` in the scenario
  bool parallel;
  std::string_view refuses_abort;  // why the host cannot abort a transfer; empty: it can
};

const HostKind& host_kind(HostInterface interface);

struct HostConfig {
  HostInterface interface = HostInterface::kSpi;
  std::uint64_t sclk_hz = 10'000'000;   // SPI
  std::uint64_t sclk2_hz = 10'000'000;  // SPI2
  Time cycle = 1000 * kPsPerNs;         // of the parallel bus, ps

  bool parallel() const { return host_kind(interface).parallel; }
  // MA frequency that `mb4sim run` sets up. The master can always make it.
  std::uint64_t ma_hz = 10'000'000;
  TableSource source;
};

}  // namespace mb4::sim

#endif  // MB4SIM_HOST_CONFIG_HPP_
