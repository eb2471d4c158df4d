// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/wave_groups.hpp"

#include <initializer_list>

namespace mb4::sim {
namespace {

WaveGroup host_group(const HostInterface& interface) {
  WaveGroup group{"host", true, {{"NRES", "nres_i"}, {"NCS", "ncs_i"}}, {}};
  const auto add = [&](std::initializer_list<WavePin> pins) {
    group.pins.insert(group.pins.end(), pins);
  };
  if (!interface.parallel) {
    add({{"SCLK", "ale_i"}, {"MOSI", "db_i", 0}, {"MISO", "db_o", 1}, {"MISO on", "db_oe_o", 1}});
    group.scopes = {".u_host.u_spi.u_cmd."};
  } else if (interface == HostInterface::kIntel) {
    add({{"ALE", "ale_i"}, {"NRD", "nrd_rnw_i"}, {"NWR", "nwr_e_i"}});
  } else {
    add({{"ALE", "ale_i"}, {"RNW", "nrd_rnw_i"}, {"E", "nwr_e_i"}});
  }
  if (interface == HostInterface::kSpi2) {
    add({{"NCS of SPI2", "db_i", 4},
         {"SCLK of SPI2", "db_i", 5},
         {"MOSI of SPI2", "db_i", 6},
         {"MISO of SPI2", "db_o", 7},
         {"MISO of SPI2 on", "db_oe_o", 7}});
    group.scopes.push_back(".u_spi2.u_spi.u_cmd.");
  }
  if (interface.parallel) {
    add({{"DB in", "db_i"}, {"DB out", "db_o"}, {"DB on", "db_oe_o"}});
    group.scopes = {".u_par_bus."};
  }
  add({{"EOT", "eot_o"}, {"NER", "ner_i"}, {"NER pulled", "ner_low_o"}});
  return group;
}

}  // namespace

// The groups in the order of the view. The first ones are those that a user of the chip sees.
std::vector<WaveGroup> mb4_wave_groups(const HostConfig& host) {
  if (host.interface.words) return {};
  return {
      host_group(host.interface),
      {"line", true, {{"MA1", "ma1_o"}, {"SL1", "sl1_i"}, {"MA2", "ma2_o"}, {"SL2", "sl2_i"}}, {}},
      {"slaves", true, {{"", "slaves_ma_i"}, {"", "slaves_slo_i"}, {"", "slaves_idle_i"}}, {}},
      {"control", false, {{"CLK", "clk_i"}}, {".u_control.", ".u_timebase."}},
      {"inside the lines",
       false,
       {{"MO1", "mo1_o"}, {"MO2", "mo2_o"}},
       {".gen_line[", ".u_line.", ".gen_list["}},
      {"registers", false, {}, {".u_regs."}},
      {"straps",
       false,
       {{"CFGSPI", "cfgspi_i"},
        {"INT_NMOT", "int_nmot_i"},
        {"NRD_RNW", "nrd_rnw_i"},
        {"NWR_E", "nwr_e_i"},
        {"GETSENS", "getsens_i"},
        {"oscillator", "osc_i"}},
       {}},
  };
}

}  // namespace mb4::sim
