// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/dsl_model/safe_checks.hpp"

#include <utility>

namespace mb4::sim::dsl_model {

const char* name_of(SafeCheck check) {
  constexpr const char* kNames[] = {"position mismatch",
                                    "TOG2",
                                    "TEST2",
                                    "ERR2",
                                    "FIX2",
                                    "marker",
                                    "K27.7",
                                    "CRC",
                                    "CRC 2",
                                    "coding",
                                    "coding 2",
                                    "VSYNC early",
                                    "VSYNC missing",
                                    "stale",
                                    "VSYNC late"};
  return kNames[static_cast<unsigned>(check)];
}

bool positions_agree(std::uint64_t first, unsigned bits1, std::uint64_t second,
                     const SafeCheckRules& rules) {
  if (rules.bits2 == 0) return true;
  const unsigned bits2 = rules.bits2 < bits1 ? rules.bits2 : bits1;
  const std::uint64_t mask = (std::uint64_t{1} << bits2) - 1;
  const std::uint64_t difference = ((first >> (bits1 - bits2)) - ~second) & mask;
  const std::uint64_t other = (mask + 1 - difference) & mask;
  return (difference < other ? difference : other) <= rules.tolerance;
}

void VsyncWatch::frame(unsigned place, bool readable, bool vsync) {
  constexpr unsigned kLast = 7;
  if (!readable) return;
  if (place == kLast) {
    own_ = vsync ? Last::kCame : Last::kMissing;
  } else if (vsync && place == 0 && before_ == Last::kMissing) {
    late_ = true;
  } else if (vsync) {
    early_ = true;
  }
}

void VsyncWatch::judge(SafeFlags& flags) {
  flags.set(SafeCheck::kVsyncEarly, early_);
  flags.set(SafeCheck::kVsyncLate, late_);
  flags.set(SafeCheck::kVsyncMissing, before_ == Last::kMissing && !late_);
  before_ = std::exchange(own_, Last::kUnknown);
  early_ = late_ = false;
}

}  // namespace mb4::sim::dsl_model
