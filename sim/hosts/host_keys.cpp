// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/hosts/host_keys.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <vector>

namespace mb4::sim {
namespace {

constexpr std::int64_t kMinSclkHz = 1'000;
constexpr std::int64_t kMaxSclkHz = 50'000'000;  // I203, I204: 10 ns each
constexpr std::int64_t kMinCycleNs = 110;        // 15 + 15 + 54 + 25 ns of a read
constexpr std::int64_t kMaxCycleNs = 1'000'000;

constexpr std::string_view kNoAbort = "only an SPI host aborts frames";
// The only list of the hosts.
constexpr HostKind kKinds[] = {{HostInterface::kSpi, "spi", false, ""},
                               {HostInterface::kSpi2, "spi2", false, ""},
                               {HostInterface::kIntel, "intel", true, kNoAbort},
                               {HostInterface::kMotorola, "motorola", true, kNoAbort}};

}  // namespace

const HostKind& host_kind(HostInterface interface) {
  return *std::find_if(std::begin(kKinds), std::end(kKinds),
                       [&](const HostKind& kind) { return kind.interface == interface; });
}

void read_host_keys(TomlReader& reader, std::span<const HostInterface> accepted, HostConfig& host) {
  std::vector<std::string_view> names;
  for (const HostInterface each : accepted) names.push_back(host_kind(each).key);
  host.interface = accepted[reader.choice("interface", names).value_or(0)];
  if (const auto hz = reader.integer("sclk_hz", kMinSclkHz, kMaxSclkHz)) {
    host.sclk_hz = host.sclk2_hz = static_cast<std::uint64_t>(*hz);
  }
  if (const auto hz = reader.integer("sclk2_hz", kMinSclkHz, kMaxSclkHz)) {
    host.sclk2_hz = static_cast<std::uint64_t>(*hz);
  }
  if (const auto ns = reader.integer("cycle_ns", kMinCycleNs, kMaxCycleNs)) {
    host.cycle = static_cast<Time>(*ns) * kPsPerNs;
  }
}

}  // namespace mb4::sim
