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

// One way to connect a host. A master lists the ways that it has; it may define one of its own.
struct HostInterface {
  std::string_view key;  // value of `interface` in the scenario
  bool parallel = false;
  std::string_view refuses_abort = "";  // why the host cannot abort a transfer; empty: it can
  bool words = false;                   // a bus of 32-bit words (word_host.hpp)
  std::string_view left_out = "";       // not in this build: the option of CMake that brings it

  constexpr bool operator==(const HostInterface& other) const { return key == other.key; }

  // Those of the hosts in this folder. kSpi2: SPI with the second serial interface enabled.
  static const HostInterface kSpi;
  static const HostInterface kSpi2;
  static const HostInterface kIntel;
  static const HostInterface kMotorola;
};

inline constexpr std::string_view kNoAbort = "only an SPI host aborts frames";
inline constexpr HostInterface HostInterface::kSpi{"spi"};
inline constexpr HostInterface HostInterface::kSpi2{"spi2"};
inline constexpr HostInterface HostInterface::kIntel{"intel", true, kNoAbort};
inline constexpr HostInterface HostInterface::kMotorola{"motorola", true, kNoAbort};

struct HostConfig {
  HostInterface interface = HostInterface::kSpi;
  std::uint64_t sclk_hz = 10'000'000;   // SPI
  std::uint64_t sclk2_hz = 10'000'000;  // SPI2
  Time cycle = 1000 * kPsPerNs;         // of the parallel bus, ps
  std::uint64_t bus_hz = 0;             // clock of a bus of words

  bool parallel() const { return interface.parallel; }
  bool serial() const { return !interface.parallel && !interface.words; }
  // MA frequency that `mb4sim run` sets up. The master can always make it.
  std::uint64_t ma_hz = 10'000'000;
  // Time from the begin of a frame to that of the next one in `mb4sim run`, ps. 0: the next one
  // begins when the host has read the one before.
  Time frame = 0;
  // For a line that has to be trained: how long the host waits for it, ps.
  Time link_wait = 100'000 * kPsPerUs;
  TableSource source;
};

}  // namespace mb4::sim

#endif  // MB4SIM_HOST_CONFIG_HPP_
