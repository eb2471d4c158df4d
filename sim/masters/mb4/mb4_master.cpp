// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/mb4_master.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/toml_advice.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/hosts/host_keys.hpp"
#include "sim/lines/clocked/clocked_lines.hpp"
#include "sim/masters/mb4/live_mb4.hpp"
#include "sim/masters/mb4/ma_frequency.hpp"
#include "sim/masters/mb4/model/preset_chips.hpp"
#include "sim/masters/mb4/pins.hpp"
#include "sim/masters/mb4/wave_groups.hpp"
#include "sim/masters/mb4/words/live_words.hpp"

namespace mb4::sim {
namespace {

constexpr std::string_view kWordsLeftOut = !MB4SIM_WITH_AXI   ? "-DMB4_AXI=ON"
                                           : MB4SIM_ONE_MODEL ? "-DMB4_ONE_MODEL=OFF"
                                                              : "";
constexpr HostInterface kInterfaces[] = {
    HostInterface::kSpi,
    HostInterface::kSpi2,
    HostInterface::kIntel,
    HostInterface::kMotorola,
    {"axi", false, "an AXI access is never aborted", true, kWordsLeftOut},
    {"wb", false, "a Wishbone cycle is never aborted", true, kWordsLeftOut},
};
constexpr std::int64_t kMaxClkHz = 200'000'000;

// Bits of quirks_i, as in mb4_pkg.
constexpr std::pair<const char*, unsigned> kQuirkBits[] = {{"IDA_TEST_INVERT", 0},
                                                           {"AGSERR_ON_INSTR_WRITE", 1},
                                                           {"AGSERR_ON_HOLDBANK", 2},
                                                           {"AGS_CLEARED_ON_ERROR", 3}};
constexpr unsigned kQuirkRevisionBit = 4;
constexpr std::pair<std::int64_t, unsigned> kRevisions[] = {{0x20, 0}, {0x10, 1}, {0x11, 2}};

void read_chip(TomlReader& reader, ChipConfig& chip) {
  std::vector<std::string_view> names;
  for (const ChipPreset& each : chip_presets()) names.push_back(each.name);
  const auto found = reader.choice("features", names);
  if (!found) return;
  const ChipPreset& preset = chip_presets()[*found];
  if (!preset.built) {
    const std::string name(preset.name);
    reader.fail("features",
                left_out(name, name == "single" ? "-DMB4_PRESETS=single"
                                                : "-DMB4_PRESETS='single;" + name + "'"));
  }
  chip.features = preset.features;
}

void read_quirks(TomlReader& reader, ChipConfig& chip) {
  for (const auto& [name, bit] : kQuirkBits) {
    if (const auto on = reader.boolean(name)) {
      chip.quirks = (chip.quirks & ~(1U << bit)) | (static_cast<unsigned>(*on) << bit);
    }
  }
  if (const auto revision = reader.integer("REVISION", 0, 0xFF)) {
    const auto* found = std::find_if(std::begin(kRevisions), std::end(kRevisions),
                                     [&](const auto& entry) { return entry.first == *revision; });
    if (found == std::end(kRevisions)) {
      reader.fail("REVISION", "expected 0x20 (Y), 0x10 (Z) or 0x11 (Z1)");
    }
    chip.quirks |= found->second << kQuirkRevisionBit;
  }
}

// "; the range is 62500 to 10000000" where `hz` lies outside. Megahertz are a usual mistake.
std::string outside(std::uint64_t system_hz, const NearestMa& nearest, std::uint64_t hz) {
  if (nearest.below != 0 && nearest.above != 0) return "";
  const std::uint64_t lowest = nearest_ma(system_hz, 1).above;
  const std::uint64_t highest = nearest_ma(system_hz, kMaxClkHz).below;
  constexpr std::uint64_t kMega = 1'000'000;
  std::string text = "; the range is " + std::to_string(lowest) + " to " + std::to_string(highest);
  if (hz * kMega <= highest && freqs_code(system_hz, hz * kMega)) {
    text += "; write ma_hz = " + toml_number(static_cast<double>(hz * kMega)) + " for megahertz";
  }
  return text;
}

void read_host(TomlReader& reader, const ChipConfig& chip, HostConfig& host) {
  read_spi_keys(reader, host);
  read_parallel_keys(reader, host);
  read_word_keys(reader, chip.f_clk_hz, host);
  if (host.interface.words && chip.f_clk_hz == 0) {
    reader.fail("interface", "a bus of words has no oscillator: f_clk_hz must not be 0");
  }
  host.ma_hz = default_ma_frequency(chip.system_hz());
  if (const auto hz = reader.integer("ma_hz", 1, kMaxClkHz)) {
    host.ma_hz = static_cast<std::uint64_t>(*hz);
    if (!freqs_code(chip.system_hz(), host.ma_hz)) {
      const NearestMa nearest = nearest_ma(chip.system_hz(), host.ma_hz);
      std::string choice;
      if (nearest.below != 0) choice = std::to_string(nearest.below);
      if (nearest.above != 0) {
        choice += (choice.empty() ? "" : " and ") + std::to_string(nearest.above);
      }
      reader.fail("ma_hz", "the chip cannot make " + std::to_string(host.ma_hz) + " Hz from " +
                               std::to_string(chip.system_hz()) + " Hz; nearest: " + choice +
                               outside(chip.system_hz(), nearest, host.ma_hz));
    }
  }
}

std::unique_ptr<LiveMaster> make(const MasterSetup& setup) {
#if MB4SIM_WITH_AXI && !MB4SIM_ONE_MODEL
  if (setup.host.interface.words) return std::make_unique<LiveWords>(setup);
#endif
  return std::make_unique<LiveMb4>(setup);
}

}  // namespace

// SCDATA1 to SCDATA8. With SLAVELOC5 the last four are those of channel 2.
const Master kMb4Master{.type = "ic-mb4",
                        .interfaces = kInterfaces,
                        .line = &kClockedLines,
                        .channels = 2,
                        .slaves = 8,
                        .slaves_shared = 4,
                        .min_clk_hz = 1'000,
                        .max_clk_hz = kMaxClkHz,
                        .min_osc_hz = 10'000'000,
                        .max_osc_hz = 25'000'000,
                        .read_chip = read_chip,
                        .read_quirks = read_quirks,
                        .read_host = read_host,
                        .pin_by_name = pin_by_name,
                        .make = make,
                        .wave_groups = mb4_wave_groups,
                        .error_pin = "NER",
                        .end_pin = "EOT"};

}  // namespace mb4::sim
