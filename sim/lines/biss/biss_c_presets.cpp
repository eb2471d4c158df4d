// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "sim/lines/biss/biss_c_slave.hpp"
#include "sim/lines/biss/biss_presets.hpp"

namespace mb4::sim {
namespace {

// Position length, two flags (nE, nW; high = no error), CRC6 0x43, adaptive timeout.
BissCSlaveConfig encoder(std::string_view name, unsigned position_bits) {
  BissCSlaveConfig config;
  config.name = std::string(name);
  config.data_bits = position_bits + 2;
  return config;
}

// An electronic data sheet (BiSS EDS, offsets as in iC-Haus and NXP drivers). The common page names
// one data channel and the bank of the channel's page. Fields whose unit is not known here are 0.
constexpr std::uint8_t kEdsBank = 2;
constexpr std::uint8_t kChannelBank = 3;

void add_eds_sensor(BissCSlaveConfig& config) {
  config.crc.polynomial = 0x25;  // profile BP0
  RegisterFile::Bank& common = config.control.banks[kEdsBank];
  common = {};
  common[0x00] = 1;  // version
  common[0x01] = 1;  // length in banks
  common[0x10] = 1;  // number of data channels
  common[0x11] = 1;  // number of slave IDs
  common[0x14] = kChannelBank;
  common[0x15] = static_cast<std::uint8_t>(config.data_bits);
  common[0x16] = 0;     // sensor, right aligned, no stop bit
  common[0x17] = 0x25;  // CRC
  RegisterFile::Bank& channel = config.control.banks[kChannelBank];
  channel = {};
  channel[0x1F] = 0x25;  // CRC polynomial, 0x1C to 0x1F, high byte first
  for (unsigned address = 0x41; address <= 0x47; ++address) {
    config.control.write_protected.set(address);
  }
  for (unsigned address = 0x78; address <= 0x7F; ++address) {
    config.control.write_protected.set(address);
  }
}

using Runs = std::vector<Preset::RegisterRun>;

}  // namespace

std::vector<Preset> biss_c_presets() {
  std::vector<Preset> list;
  list.reserve(24);  // add() returns references into the list
  const auto add = [&list](std::string_view name, std::string_view description,
                           unsigned position_bits, Runs registers = {}) -> BissCSlaveConfig& {
    list.push_back({name, description, encoder(name, position_bits), std::move(registers)});
    return list.back().device.as<BissCSlaveConfig>();
  };
  const auto unidirectional = [](BissCSlaveConfig& config) { config.control.present = false; };
  // Renishaw L-9709-9005: 18, 26, 32 or 36 bits, unidirectional.
  unidirectional(add("resolute-18", "Renishaw RESOLUTE, 18 bits", 18));
  unidirectional(add("resolute-26", "Renishaw RESOLUTE, 26 bits", 26));
  unidirectional(add("resolute-32", "Renishaw RESOLUTE, 32 bits", 32));
  unidirectional(add("resolute-36", "Renishaw RESOLUTE, 36 bits", 36));
  // The makers publish nothing about registers.
  unidirectional(add("lma10", "RLS/Renishaw LMA10, 26 bits", 26));
  // Lenz BISS-C interface sheet: acknowledge of four periods, timeout 12.6 to 13.2 us.
  BissCSlaveConfig& lenz = add("lenz-irs", "Lenz IRS/SAB/SIB, 24 bits", 24);
  lenz.busy_periods = 3;
  lenz.timeout.fixed = from_us(12.9);
  add("lika-sma1", "Lika SMA1, 24 bits", 24,
      {{0x42, {0x28, 0x14}}, {0x55, {0x06}}, {0x78, {'S', 'M', 'A', '1'}}});
  // Order code or configuration sets the length, so the scenario must give data_bits.
  // 0x7C: type of timeout, 4 = adaptive.
  add("lika-amm36", "Lika AMM36, give data_bits", 0, {{0x78, {'A', 'M', 'M', '3'}}, {0x7C, {0x04}}})
      .data_bits = 0;
  add("ic-mu", "iC-MU, give data_bits", 0).data_bits = 0;
  // iC-NQC: 13 bits angle and 24 bits period counter, flags E1 and E0, timeout 20 us.
  BissCSlaveConfig& nqc = add("ic-nqc", "iC-NQC, 24 bits period and 13 bits angle", 37);
  nqc.timeout.fixed = from_us(20);
  // iC-PVS Rev A2: absolute data, commands 00 and 01; adaptive timeout or 20 us.
  add("ic-pvs", "iC-PVS, give data_bits", 0).data_bits = 0;
  // Festo SFC-LAC: motor encoder of 12 bits cycle counter and 11 bits angle, flags E1 and E0.
  add("festo-sfc-lac", "Festo SFC-LAC motor encoder, 12 bits cycles and 11 bits angle", 23);
  // iC-MR: up to 32 banks of 64 bytes.
  for (BissCSlaveConfig* mr :
       {&add("ic-mr", "iC-MR, 24 bits single turn", 24),
        &add("ic-mr-mt", "iC-MR, 24 bits multiturn and 24 bits single turn", 48)}) {
    for (std::uint8_t bank = 1; bank < 32; ++bank) mr->control.banks[bank] = {};
  }
  // TI TIDEP0022 design guide, test data: 12 bits single turn; register values of its
  // table 11.
  add("wachendorff-wdgf58m", "Wachendorff WDGF58M, 12 bits single turn", 12,
      {{0x44, {0x00, 0xD9, 0x01, 0x32}},
       {0x60, {0x0B}},
       {0x67, {0x5F}},
       {0x78, {0x46, 0x3A, 0xC0, 0x0C, 0x00, 0x01}},
       {0x7E, {0x57, 0x41}}});
  add_eds_sensor(add("eds-sensor", "no product: profile BP0 with an EDS, 24 bits", 24,
                     {{0x41, {kEdsBank}},
                      {0x42, {26, 0x00}},  // BP0: length of the data in bits 12 to 8, sensor
                      {0x44, {0x00, 0x00, 0x00, 0x01}},
                      {0x78, {'M', 'B', '4', 'S', 'I', 'M'}},
                      {0x7E, {'M', '4'}}}));
  // BiSS Safety (BP3): two words of one sensor. Both hold position, nE and nW, in this order from
  // the highest bit; the second one ends in the sign of life, which counts from 0 to 63.
  add("bp3-cpw", "no product: BiSS Safety, control position word, 26 bits", 26);
  BissCSlaveConfig& spw =
      add("bp3-spw", "no product: BiSS Safety, safety position word, 26 bits", 26);
  spw.life_counter.bits = 6;
  spw.data_bits += spw.life_counter.bits;
  spw.flag_bits += spw.life_counter.bits;
  spw.flags <<= spw.life_counter.bits;
  spw.crc.polynomial = 0x190D9;
  return list;
}

}  // namespace mb4::sim
