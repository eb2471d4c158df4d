// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#ifndef TESTS_UNIT_LINES_REGISTERS_PRESET_SLAVE_HPP_
#define TESTS_UNIT_LINES_REGISTERS_PRESET_SLAVE_HPP_

#include <string_view>

#include "sim/lines/biss/biss_c_slave.hpp"
#include "sim/lines/presets.hpp"
#include "tests/unit/lines/registers/control_bench.hpp"

namespace mb4test {

using namespace mb4::sim;

// A slave as the preset of this name describes it, registers included.
inline BissCSlave& add_preset(ControlBench& bench, std::string_view name) {
  const Preset* preset = preset_by_name(name);
  BissCSlave& slave = bench.add(preset->device.as<BissCSlaveConfig>());
  for (const auto& run : preset->registers) {
    std::uint8_t address = run.address;
    for (const std::uint8_t value : run.values) slave.reg_write(address++, value);
  }
  return slave;
}

}  // namespace mb4test

#endif  // TESTS_UNIT_LINES_REGISTERS_PRESET_SLAVE_HPP_
