// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/hosts/host_keys.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace mb4::sim {
namespace {

constexpr std::int64_t kMinSclkHz = 1'000;
constexpr std::int64_t kMaxSclkHz = 50'000'000;  // I203, I204: 10 ns each
constexpr std::int64_t kMinCycleNs = 60;         // 15 + 15 + 15 + 15 ns of a write
constexpr std::int64_t kMaxCycleNs = 1'000'000;
constexpr std::int64_t kMinBusHz = 1'000;
constexpr std::int64_t kMaxBusHz = 500'000'000;
constexpr double kMaxFrameUs = 1e6;

}  // namespace

void read_interface(TomlReader& reader, std::span<const HostInterface> accepted, HostConfig& host) {
  std::vector<std::string_view> names;
  for (const HostInterface& each : accepted) names.push_back(each.key);
  host.interface = accepted[reader.choice("interface", names).value_or(0)];
  if (!host.interface.left_out.empty()) {
    reader.fail("interface", left_out(host.interface.key, host.interface.left_out));
  }
}

void read_spi_keys(TomlReader& reader, HostConfig& host) {
  if (const auto hz = reader.integer("sclk_hz", kMinSclkHz, kMaxSclkHz)) {
    host.sclk_hz = host.sclk2_hz = static_cast<std::uint64_t>(*hz);
  }
  if (const auto hz = reader.integer("sclk2_hz", kMinSclkHz, kMaxSclkHz)) {
    host.sclk2_hz = static_cast<std::uint64_t>(*hz);
  }
}

void read_parallel_keys(TomlReader& reader, HostConfig& host) {
  if (const auto ns = reader.integer("cycle_ns", kMinCycleNs, kMaxCycleNs)) {
    host.cycle = static_cast<Time>(*ns) * kPsPerNs;
  }
}

void read_word_keys(TomlReader& reader, std::uint64_t clk_hz, HostConfig& host) {
  host.bus_hz = clk_hz;
  if (const auto hz = reader.integer("bus_hz", kMinBusHz, kMaxBusHz)) {
    host.bus_hz = static_cast<std::uint64_t>(*hz);
  }
}

void read_frame_key(TomlReader& reader, HostConfig& host) {
  if (const auto us = reader.number("frame_us", 0.001, kMaxFrameUs)) host.frame = from_us(*us);
}

}  // namespace mb4::sim
