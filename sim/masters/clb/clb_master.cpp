// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/clb/clb_master.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "sim/core/toml_reader.hpp"
#include "sim/hosts/host_keys.hpp"
#include "sim/lines/clocked/clocked_lines.hpp"
#include "sim/masters/clb/live_clb.hpp"
#include "sim/model/axi_lite_groups.hpp"

namespace mb4::sim {
namespace {

constexpr HostInterface kClbInterfaces[] = {{"axi", false, "an AXI access is never aborted", true}};
constexpr std::uint64_t kClbClkHz = 200'000'000;
constexpr std::int64_t kClbMaxClkHz = 500'000'000;
constexpr std::uint64_t kClbMaxMaHz = 10'000'000;

// Without the key the highest frequency up to 10 MHz.
void read_clb_host(TomlReader& reader, const ChipConfig& chip, HostConfig& host) {
  const std::uint64_t clk = chip.f_clk_hz;
  const std::uint64_t half =
      std::max(kClbShortestHalf, (clk + 2 * kClbMaxMaHz - 1) / (2 * kClbMaxMaHz));
  host.ma_hz = clk == 0 ? kClbMaxMaHz : std::max<std::uint64_t>(clk / (2 * half), 1);
  read_frame_key(reader, host);
  const auto hz = reader.integer("ma_hz", 1, kClbMaxClkHz);
  if (!hz) return;
  host.ma_hz = static_cast<std::uint64_t>(*hz);
  const std::uint64_t wanted = clb_half(clk, host.ma_hz);
  if (clk != 0 && (wanted < kClbShortestHalf || wanted > kClbLongestHalf)) {
    reader.fail("ma_hz", "the master cannot make " + std::to_string(host.ma_hz) + " Hz from " +
                             std::to_string(clk) + " Hz: half a period of MA is " +
                             std::to_string(kClbShortestHalf) + " to " +
                             std::to_string(kClbLongestHalf) + " clocks");
  }
}

// Bus, line with its encoder, then the inside.
std::vector<WaveGroup> clb_wave_groups(const HostConfig& /*host*/) {
  std::vector<WaveGroup> groups = axi_lite_groups();
  groups.insert(groups.end(), {{"line",
                                true,
                                {{"", "ma_o"},
                                 {"", "encoder_ma"},
                                 {"", "encoder_slo"},
                                 {"", "sl_i"},
                                 {"", "encoder_ready"},
                                 {"", "spi_clk_o"},
                                 {"", "txen_o"},
                                 {"", "irq_o"}},
                                {"u_state."}},
                               {"receiver", true, {}, {"u_receive.", "u_fifo."}},
                               {"frame", false, {}, {"u_frame."}},
                               {"registers", false, {}, {"u_regs."}},
                               {"page", false, {}, {"u_page."}}});
  return groups;
}

}  // namespace

const Master kClbMaster{.type = "clb",
                        .interfaces = kClbInterfaces,
                        .line = &kClockedLines,
                        .channels = 1,
                        .slaves = 1,
                        .slaves_shared = 1,
                        .min_clk_hz = 1'000,
                        .max_clk_hz = kClbMaxClkHz,
                        .min_osc_hz = 0,
                        .max_osc_hz = 0,
                        .clk_hz = kClbClkHz,
                        .read_quirks = [](TomlReader& /*reader*/, ChipConfig& /*chip*/) {},
                        .read_host = read_clb_host,
                        .pin_by_name = clb_pin_by_name,
                        .make = [](const MasterSetup& setup) -> std::unique_ptr<LiveMaster> {
                          return std::make_unique<LiveClb>(setup);
                        },
                        .wave_groups = clb_wave_groups};

}  // namespace mb4::sim
