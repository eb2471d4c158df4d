// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/axi/axi_master.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "sim/core/toml_reader.hpp"
#include "sim/hosts/host_keys.hpp"
#include "sim/lines/clocked/clocked_lines.hpp"
#include "sim/masters/axi/live_axi.hpp"
#include "sim/masters/axi/wave_groups.hpp"

namespace mb4::sim {
namespace {

constexpr HostInterface kInterfaces[] = {
    {"axi", false, "an AXI access is never aborted", true},
    {"spi", false, "", false, MB4SIM_ONE_MODEL ? "-DMB4_ONE_MODEL=OFF" : ""}};
constexpr std::int64_t kMinSclkHz = 1'000;
constexpr std::int64_t kMaxSclkHz = 50'000'000;
constexpr std::uint64_t kUsualSclkHz = 10'000'000;
constexpr std::int64_t kMaxClkHz = 500'000'000;
constexpr std::uint64_t kAxiMaxMaHz = 10'000'000;
constexpr std::uint64_t kLongestHalf = 255;  // clocks of half an MA period

constexpr std::pair<const char*, unsigned> kSwitches[] = {
    {"VALID_UNTIL_REQUEST", kAxiValidUntilRequest},
    {"ALIGN_LATCH", kAxiAlignLatch},
    {"CRC_BIT_IGNORES", kAxiCrcBitIgnores},
    {"ENABLE_ACTIVE_LOW", kAxiEnableActiveLow},
    {"POR_PIN", kAxiPorPin}};
constexpr unsigned kDefaultSwitches = kAxiValidUntilRequest;

// In the order of kAxiDocument, kAxiFull, kAxiFrames.
constexpr std::string_view kFeatures[] = {"document", "full", "frames"};

void read_chip(TomlReader& reader, ChipConfig& chip) {
  chip.features = static_cast<std::uint32_t>(reader.choice("features", kFeatures).value_or(0));
  if (MB4SIM_ONE_MODEL && chip.features != kAxiDocument) {
    reader.fail("features", left_out(kFeatures[chip.features], "-DMB4_ONE_MODEL=OFF"));
  }
}

void read_quirks(TomlReader& reader, ChipConfig& chip) {
  for (const auto& [name, bit] : kSwitches) {
    if (const auto on = reader.boolean(name)) {
      chip.quirks = *on ? chip.quirks | bit : chip.quirks & ~bit;
    }
  }
}

// SCLK is at most a quarter of the clock; without the key an eighth, and no more than 10 MHz.
void read_sclk(TomlReader& reader, std::uint64_t clk, HostConfig& host) {
  if (host.interface != HostInterface::kSpi) return;
  host.sclk_hz = clk == 0 ? kUsualSclkHz : std::clamp<std::uint64_t>(clk / 8, 1, kUsualSclkHz);
  const auto hz = reader.integer("sclk_hz", kMinSclkHz, kMaxSclkHz);
  if (!hz) return;
  host.sclk_hz = static_cast<std::uint64_t>(*hz);
  if (clk != 0 && host.sclk_hz > clk / 4) {
    reader.fail("sclk_hz", "the master takes at most a quarter of its clock, " +
                               std::to_string(clk / 4) + " Hz");
  }
}

// MA is the clock divided by twice 1 to 255.
void read_host(TomlReader& reader, const ChipConfig& chip, HostConfig& host) {
  const std::uint64_t clk = chip.f_clk_hz;
  const std::uint64_t half = (clk + 2 * kAxiMaxMaHz - 1) / (2 * kAxiMaxMaHz);
  host.ma_hz = clk == 0 ? kAxiMaxMaHz : clk / (2 * (half == 0 ? 1 : half));
  read_frame_key(reader, host);
  read_sclk(reader, clk, host);
  const auto hz = reader.integer("ma_hz", 1, kMaxClkHz);
  if (!hz) return;
  host.ma_hz = static_cast<std::uint64_t>(*hz);
  const std::uint64_t wanted = clk / (2 * host.ma_hz);
  if (wanted < 1 || wanted > kLongestHalf || clk % (2 * host.ma_hz) != 0) {
    reader.fail("ma_hz", "the master cannot make " + std::to_string(host.ma_hz) + " Hz from " +
                             std::to_string(clk) +
                             " Hz: MA is the clock divided by 2 to 510, even");
  }
}

}  // namespace

const Master kAxiMaster{.type = "axi",
                        .interfaces = kInterfaces,
                        .line = &kClockedLines,
                        .channels = kAxiChannels,
                        .slaves = kAxiChannels,
                        .slaves_shared = 1,
                        .slaves_single = 1,
                        .min_clk_hz = 1'000,
                        .max_clk_hz = kMaxClkHz,
                        .min_osc_hz = 0,
                        .max_osc_hz = 0,
                        .quirks = kDefaultSwitches,
                        .read_chip = read_chip,
                        .read_quirks = read_quirks,
                        .read_host = read_host,
                        .pin_by_name = axi_pin_by_name,
                        .make = [](const MasterSetup& setup) -> std::unique_ptr<LiveMaster> {
                          return std::make_unique<LiveAxi>(setup);
                        },
                        .wave_groups = axi_wave_groups};

}  // namespace mb4::sim
