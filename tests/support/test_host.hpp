// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Which host the whole-chip tests use. They run once for each of them (tests/chip/CMakeLists.txt
// sets MB4_HOST); a scenario that names another interface than SPI keeps it. MB4_FEATURES is the
// preset of the chip ([chip] features) for the scenarios that name none.
#ifndef TESTS_SUPPORT_TEST_HOST_HPP_
#define TESTS_SUPPORT_TEST_HOST_HPP_

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "mb4_regs.hpp"
#include "sim/masters/master.hpp"
#include "sim/masters/mb4/model/preset_chips.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4test {

// Registers and bits in tests: reg::kAddrInstr, reg::INSTR::kMask, reg::kInstrCdm0.
namespace reg = mb4::regs;

// "spi", "intel", "motorola", "axi" or "wb".
inline std::string test_host() {
  const char* const name = std::getenv("MB4_HOST");
  return name == nullptr ? "spi" : name;
}

// Tests look at the flags right after an instruction, as SPI lets them: five clocks must pass
// meanwhile.
// What the shortest cycles do is shown in host_test.cpp. A scenario may ask for longer ones.
inline constexpr mb4::sim::Time kTestCycle = 1000 * mb4::sim::kPsPerNs;

// The same for a scenario's text, whose table [host] names no interface.
inline std::string with_test_host(std::string text) {
  const std::string table = "[host]\n";
  return text.replace(text.find(table), table.size(),
                      table + "interface = \"" + test_host() + "\"\ncycle_ns = 1000\n");
}

// The word of the preset that MB4_FEATURES names; 0 is the full chip.
inline std::uint32_t test_features() {
  const char* const name = std::getenv("MB4_FEATURES");
  if (name == nullptr) return 0;
  for (const mb4::sim::ChipPreset& preset : mb4::sim::chip_presets()) {
    if (preset.name == name && preset.built) return preset.features;
  }
  std::fprintf(stderr, "MB4_FEATURES: this build has no %s\n", name);
  std::exit(EXIT_FAILURE);
}

inline mb4::sim::Scenario with_test_host(mb4::sim::Scenario scenario) {
  using mb4::sim::HostInterface;
  if (scenario.chip.features == 0) scenario.chip.features = test_features();
  if (scenario.host.interface != HostInterface::kSpi) return scenario;
  const std::string name = test_host();
  scenario.host.cycle = std::max(scenario.host.cycle, kTestCycle);
  for (const HostInterface& each : scenario.master->interfaces) {
    if (each.key != name) continue;
    scenario.host.interface = each;
    // "axi": one clock; "wb": two, near each other, because each edge of either costs time.
    if (name == "wb" || scenario.host.bus_hz == 0) scenario.host.bus_hz = 33'000'000;
    return scenario;
  }
  std::fprintf(stderr, "MB4_HOST: the chip has no host %s\n", name.c_str());
  std::exit(EXIT_FAILURE);
}

}  // namespace mb4test

#endif  // TESTS_SUPPORT_TEST_HOST_HPP_
