// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/presets.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace mb4::sim {
namespace {

// Position length, two flags (nE, nW; high = no error), CRC6 0x43, adaptive timeout.
BissCSlaveConfig encoder(std::string_view name, unsigned position_bits) {
  BissCSlaveConfig config;
  config.name = std::string(name);
  config.data_bits = position_bits + 2;
  return config;
}

std::vector<Preset> make_presets() {
  std::vector<Preset> list;
  list.reserve(16);  // add() hands out references
  const auto add = [&list](std::string_view name, std::string_view description,
                           unsigned position_bits,
                           std::vector<Preset::RegisterRun> registers = {}) -> Preset& {
    list.push_back({name, description, encoder(name, position_bits), std::move(registers)});
    return list.back();
  };
  // Renishaw L-9709-9005: 18, 26, 32 or 36 bits, unidirectional.
  add("resolute-18", "Renishaw RESOLUTE, 18 bits", 18);
  add("resolute-26", "Renishaw RESOLUTE, 26 bits", 26);
  add("resolute-32", "Renishaw RESOLUTE, 32 bits", 32);
  add("resolute-36", "Renishaw RESOLUTE, 36 bits", 36);
  add("lma10", "RLS/Renishaw LMA10, 26 bits", 26);
  // Lenz BISS-C interface sheet: acknowledge of four periods, timeout 12.6 to 13.2 us.
  Preset& lenz = add("lenz-irs", "Lenz IRS/SAB/SIB, 24 bits", 24);
  lenz.config.busy_periods = 3;
  lenz.config.timeout.fixed = from_us(12.9);
  add("lika-sma1", "Lika SMA1, 24 bits", 24,
      {{0x42, {0x28, 0x14}}, {0x55, {0x06}}, {0x78, {'S', 'M', 'A', '1'}}});
  // Lengths by order code or configuration: the scenario must give data_bits.
  add("lika-amm36", "Lika AMM36, give data_bits", 0).config.data_bits = 0;
  add("ic-mu", "iC-MU, give data_bits", 0).config.data_bits = 0;
  // iC-NQC: 13 bits angle and 24 bits period counter, flags E1 and E0, timeout 20 us.
  Preset& nqc = add("ic-nqc", "iC-NQC, 24 bits period and 13 bits angle", 37);
  nqc.config.timeout.fixed = from_us(20);
  add("ic-mr", "iC-MR, 24 bits single turn", 24);
  add("ic-mr-mt", "iC-MR, 24 bits multiturn and 24 bits single turn", 48);
  // TI TIDEP0022 design guide, test data: 12 bits single turn; register values of its
  // table 11.
  add("wachendorff-wdgf58m", "Wachendorff WDGF58M, 12 bits single turn", 12,
      {{0x44, {0x00, 0xD9, 0x01, 0x32}},
       {0x60, {0x0B}},
       {0x67, {0x5F}},
       {0x78, {0x46, 0x3A, 0xC0, 0x0C, 0x00, 0x01}},
       {0x7E, {0x57, 0x41}}});
  return list;
}

}  // namespace

std::span<const Preset> presets() {
  static const std::vector<Preset> list = make_presets();
  return list;
}

const Preset* preset_by_name(std::string_view name) {
  const auto all = presets();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Preset& p) { return p.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace mb4::sim
