// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/data_source.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mb4::sim {
namespace {

std::uint64_t low_bits(std::uint64_t value, unsigned bits) {
  return bits >= 64 ? value : value & ((std::uint64_t{1} << bits) - 1U);
}

}  // namespace

std::uint64_t DataSource::word(Time now, std::uint64_t frames, unsigned data_bits,
                               unsigned flag_bits, std::uint64_t flags) const {
  std::uint64_t position = 0;
  switch (kind) {
    case Kind::kConstant:
      return low_bits(constant, data_bits);
    case Kind::kList:
      if (words.empty()) return 0;
      return low_bits(
          words[repeat ? frames % words.size() : std::min<std::uint64_t>(frames, words.size() - 1)],
          data_bits);
    case Kind::kRamp:
      position = static_cast<std::uint64_t>(start) + static_cast<std::uint64_t>(step) * frames;
      break;
    case Kind::kSine: {
      const double turns = static_cast<double>(now % period) / static_cast<double>(period);
      const double value = offset + amplitude * std::sin(2 * std::numbers::pi * turns);
      position = static_cast<std::uint64_t>(std::llround(value));
      break;
    }
  }
  const std::uint64_t raw = (flag_bits >= 64 ? 0 : position << flag_bits);
  return low_bits(raw | low_bits(flags, flag_bits), data_bits);
}

}  // namespace mb4::sim
