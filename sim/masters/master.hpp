// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The masters that a scenario can have: what each of them accepts, and how it is made.
#ifndef MB4SIM_MASTER_HPP_
#define MB4SIM_MASTER_HPP_

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sim/hosts/host_config.hpp"
#include "sim/hosts/host_pins.hpp"
#include "sim/masters/chip_config.hpp"

namespace mb4::sim {

class LiveMaster;
class TomlReader;
struct MasterSetup;
struct WaveGroup;
struct LineKind;

struct Master {
  std::string_view type;                      // value of `type` in [master]
  std::span<const HostInterface> interfaces;  // the first is the default
  const LineKind* line;                       // of all its channels
  unsigned channels;
  unsigned slaves;             // of all channels together
  unsigned slaves_shared;      // of each channel if another channel than the first is in use
  unsigned slaves_single = 0;  // of a single channel that is in use; 0: as many as `slaves`
  // Limits of f_clk_hz (but 0) and f_osc_hz.
  std::int64_t min_clk_hz;
  std::int64_t max_clk_hz;
  std::int64_t min_osc_hz;
  std::int64_t max_osc_hz;
  bool clk_needed = false;            // f_clk_hz cannot be 0 either
  std::uint64_t clk_hz = 20'000'000;  // without the key f_clk_hz
  unsigned quirks = 0;                // ChipConfig::quirks without [chip.quirks]
  // Reads the keys of [chip] that other masters do not have. Null: none.
  void (*read_chip)(TomlReader& reader, ChipConfig& chip) = nullptr;
  // Reads [chip.quirks]; `chip` has the keys of [chip].
  void (*read_quirks)(TomlReader& reader, ChipConfig& chip);
  // Reads the keys of [host] but `interface`, which is known.
  void (*read_host)(TomlReader& reader, const ChipConfig& chip, HostConfig& host);
  // Null if it has no pins.
  std::optional<Pin> (*pin_by_name)(std::string_view name);
  std::unique_ptr<LiveMaster> (*make)(const MasterSetup& setup);
  // The groups of the waveform view (sim/model/wave_view.hpp). Null if it has no waveform; none if
  // it has no waveform with this host.
  std::vector<WaveGroup> (*wave_groups)(const HostConfig& host);
  // Pins that most masters do not have: one is low after a frame with an error, the other one rises
  // at the end of a frame, before it shows the error.
  std::string_view error_pin{};
  std::string_view end_pin{};

  // Number of the first slave of a channel, from 1 on.
  constexpr unsigned first_slave(unsigned channel) const {
    return 1 + (channel - 1) * slaves_shared;
  }
};

// In the order in which they are listed to the user. The first is the default.
std::span<const Master* const> masters();
// Those that this build has not, and the option of CMake that brings each.
struct LeftOut {
  std::string_view type;
  std::string_view option;
};
std::span<const LeftOut> masters_left_out();

// A program adds a master of its own before it reads a scenario. `master` must live on.
void add_master(const Master& master);

}  // namespace mb4::sim

#endif  // MB4SIM_MASTER_HPP_
