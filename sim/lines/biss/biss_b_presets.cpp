// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "sim/lines/biss/biss_b_slave.hpp"
#include "sim/lines/biss/biss_presets.hpp"

namespace mb4::sim {

std::vector<Preset> biss_b_presets() {
  std::vector<Preset> list;
  const auto add = [&list](std::string_view name, std::string_view description,
                           BissBSlaveConfig config,
                           std::vector<Preset::RegisterRun> registers = {}) {
    config.name = std::string(name);
    list.push_back({name, description, std::move(config), std::move(registers)});
  };
  // iC-NQ Rev D1: lengths as iC-NQC. The timeouts of 16 us (sensor) and 256 us (register) are two
  // of the values that can be set.
  BissBSlaveConfig nq;
  nq.data_bits = 39;
  nq.timeout.fixed = from_us(16);
  nq.register_timeout = from_us(256);
  add("ic-nq", "iC-NQ, BiSS B, 24 bits period and 13 bits angle", nq);
  BissBSlaveConfig lika;
  lika.data_bits = 26;
  add("lika-sma1-b", "Lika SMA1 in BiSS B, 24 bits", lika,
      {{0x42, {0x28, 0x14}}, {0x55, {0x06}}, {0x78, {'S', 'M', 'A', '1'}}});
  // Hengstler: two IDs widen the register address to eight bits.
  BissBSlaveConfig acuro;
  acuro.data_bits = 0;
  acuro.access.ids = 2;
  add("acuro", "Hengstler ACURO, BiSS B, give data_bits", acuro);
  return list;
}

}  // namespace mb4::sim
