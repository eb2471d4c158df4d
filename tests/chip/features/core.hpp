// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The cores of the tests in this folder, and for which of them a test runs.
#ifndef TESTS_CHIP_FEATURES_CORE_HPP_
#define TESTS_CHIP_FEATURES_CORE_HPP_

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "sim/masters/mb4/model/preset_chips.hpp"

namespace mb4test {

// What a core has, and the byte at 0x7F. The presets are as docs/integration.md has them.
struct Core {
  const char* name;
  unsigned lines;
  unsigned slaves;  // data channels of a line
  bool biss_b, ssi, mo, control, gray, force, free_crc;
  unsigned banks;
  unsigned byte;

  // The core has the data channel x.
  bool channel(unsigned x) const {
    if (lines == 1 || slaves == 8) return x <= slaves;
    return x <= 4 ? x <= slaves : x <= 4 + slaves;
  }
};
inline void PrintTo(const Core& core, std::ostream* out) { *out << core.name; }

inline constexpr Core kCores[] = {
    // lines, slaves, BiSS B, SSI, MO, control, Gray, force, free CRC, banks, 0x7F
    {"full", 2, 8, true, true, true, true, true, true, true, 2, 0x00},
    {"drive", 2, 2, false, false, false, true, false, true, true, 2, 0xC7},
    {"single", 1, 1, false, false, false, true, false, true, true, 2, 0x85},
    {"reader", 1, 1, false, false, false, false, false, false, false, 2, 0x80},
    // Of all_chips.cpp: what no preset has or leaves out.
    {"one-bank", 2, 3, true, true, false, true, false, false, false, 1, 0xF6},
    {"one-line", 1, 5, true, true, true, false, true, true, true, 2, 0xBB},
};

// The cores that this program has (MB4_PRESETS) and that fit.
inline std::vector<Core> built_cores(bool (*fits)(const Core&) = [](const Core&) { return true; }) {
  std::vector<Core> found;
  for (const Core& core : kCores) {
    const auto presets = mb4::sim::chip_presets();
    const bool built = std::any_of(presets.begin(), presets.end(), [&core](const auto& each) {
      return each.name == core.name && each.built;
    });
    if (built && fits(core)) found.push_back(core);
  }
  return found;
}

// For INSTANTIATE_TEST_SUITE_P: the name of the core as that of a test.
inline std::string core_name(const testing::TestParamInfo<Core>& entry) {
  std::string name = entry.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace mb4test

#endif  // TESTS_CHIP_FEATURES_CORE_HPP_
