// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/pru/pru_master.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/toml_reader.hpp"
#include "sim/hosts/host_keys.hpp"
#include "sim/lines/clocked/clocked_lines.hpp"
#include "sim/masters/pru/live_pru.hpp"
#include "sim/model/axi_lite_groups.hpp"

namespace mb4::sim {
namespace {

constexpr HostInterface kPruInterfaces[] = {{"axi", false, "an AXI access is never aborted", true}};
constexpr std::uint64_t kPruHzOfMhz = 1'000'000;
constexpr std::uint64_t kPruMaxMaHz = 10 * kPruHzOfMhz;
constexpr std::uint64_t kPruLongestPeriod = 0xFF'FFFF;  // clocks, TRIGGER_PERIOD

constexpr std::pair<const char*, unsigned> kPruSwitches[] = {
    {"SMA_WRAP", kPruSmaWrap}, {"FIRST_LOW", kPruFirstLow}, {"EXTRA_10", kPruExtra10}};

void read_pru_chip(TomlReader& reader, ChipConfig& chip) {
  if (chip.f_clk_hz != kPruSlowHz && chip.f_clk_hz != kPruFastHz) {
    reader.fail("f_clk_hz", std::to_string(chip.f_clk_hz) + ": the master is made for " +
                                std::to_string(kPruSlowHz) + " and " + std::to_string(kPruFastHz));
  }
  if (MB4SIM_ONE_MODEL && chip.f_clk_hz != kPruFastHz) {
    reader.fail("f_clk_hz", left_out(std::to_string(kPruSlowHz), "-DMB4_ONE_MODEL=OFF"));
  }
}

void read_pru_quirks(TomlReader& reader, ChipConfig& chip) {
  for (const auto& [name, bit] : kPruSwitches) {
    if (const auto on = reader.boolean(name)) {
      chip.quirks = *on ? chip.quirks | bit : chip.quirks & ~bit;
    }
  }
}

void read_pru_host(TomlReader& reader, const ChipConfig& chip, HostConfig& host) {
  host.ma_hz = kPruMaxMaHz;
  read_frame_key(reader, host);
  const Time longest = kPruLongestPeriod * (kPsPerSecond / chip.f_clk_hz);
  if (host.frame > longest) {
    reader.fail("frame_us", "the longest period of frames is " +
                                std::to_string(longest / kPsPerUs) + " us at this f_clk_hz");
  }
  const auto hz = reader.integer("ma_hz", 1, static_cast<std::int64_t>(kPruMaxMaHz));
  if (!hz) return;
  host.ma_hz = static_cast<std::uint64_t>(*hz);
  if (host.ma_hz % kPruHzOfMhz != 0 || !pru_has_frequency(host.ma_hz / kPruHzOfMhz)) {
    reader.fail("ma_hz",
                "the master makes 1, 2, 5 and 10 MHz, not " + std::to_string(host.ma_hz) + " Hz");
  }
}

// Bus, line with its encoder, then the inside.
std::vector<WaveGroup> pru_wave_groups(const HostConfig& /*host*/) {
  std::vector<WaveGroup> groups = axi_lite_groups();
  groups.insert(groups.end(), {{"line",
                                true,
                                {{"", "trigger_i"},
                                 {"", "ma_o"},
                                 {"", "encoder_ma"},
                                 {"", "encoder_slo"},
                                 {"", "sl_i"},
                                 {"", "encoder_ready"},
                                 {"", "irq_o"}},
                                {}},
                               {"pace", true, {}, {"u_pace."}},
                               {"frame", true, {}, {"u_frame."}},
                               {"control frame", false, {}, {"u_control."}},
                               {"memory", false, {}, {"u_memory."}},
                               {"registers", false, {}, {"u_regs."}}});
  return groups;
}

}  // namespace

const Master kPruMaster{.type = "pru",
                        .interfaces = kPruInterfaces,
                        .line = &kClockedLines,
                        .channels = 1,
                        .slaves = 1,
                        .slaves_shared = 1,
                        .min_clk_hz = kPruSlowHz,
                        .max_clk_hz = kPruFastHz,
                        .min_osc_hz = 0,
                        .max_osc_hz = 0,
                        .clk_needed = true,
                        .clk_hz = kPruFastHz,
                        .quirks = kPruExtra10,
                        .read_chip = read_pru_chip,
                        .read_quirks = read_pru_quirks,
                        .read_host = read_pru_host,
                        .pin_by_name = pru_pin_by_name,
                        .make = [](const MasterSetup& setup) -> std::unique_ptr<LiveMaster> {
                          return std::make_unique<LivePru>(setup);
                        },
                        .wave_groups = pru_wave_groups};

}  // namespace mb4::sim
