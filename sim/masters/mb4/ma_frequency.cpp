// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/ma_frequency.hpp"

#include <algorithm>

namespace mb4::sim {
namespace {

constexpr unsigned kCodes = 32;
constexpr unsigned kNotPermitted = 16;
constexpr std::uint64_t kDefaultLimit = 10'000'000;

}  // namespace

unsigned ma_divider(unsigned freqs_code) {
  if (freqs_code == kNotPermitted || freqs_code >= kCodes) return 0;
  return 2 * half_ma_clocks(freqs_code);
}

std::uint64_t ma_frequency(std::uint64_t system_hz, unsigned freqs_code) {
  const unsigned divider = ma_divider(freqs_code);
  return divider == 0 ? 0 : system_hz / divider;
}

std::optional<unsigned> freqs_code(std::uint64_t system_hz, std::uint64_t ma_hz) {
  for (unsigned code = 0; code < kCodes; ++code) {
    if (ma_divider(code) != 0 && ma_frequency(system_hz, code) == ma_hz) return code;
  }
  return std::nullopt;
}

NearestMa nearest_ma(std::uint64_t system_hz, std::uint64_t ma_hz) {
  NearestMa nearest;
  for (unsigned code = 0; code < kCodes; ++code) {
    const std::uint64_t frequency = ma_frequency(system_hz, code);
    if (frequency == 0) continue;
    if (frequency < ma_hz) nearest.below = std::max(nearest.below, frequency);
    if (frequency > ma_hz) {
      nearest.above = nearest.above == 0 ? frequency : std::min(nearest.above, frequency);
    }
  }
  return nearest;
}

std::uint64_t default_ma_frequency(std::uint64_t system_hz) {
  return nearest_ma(system_hz, kDefaultLimit + 1).below;
}

}  // namespace mb4::sim
