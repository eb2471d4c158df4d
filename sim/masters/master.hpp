// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The masters that a scenario can have, and what each of them accepts. masters.cpp holds the only
// list of them.
#ifndef MB4SIM_MASTER_HPP_
#define MB4SIM_MASTER_HPP_

#include <cstdint>
#include <span>
#include <string_view>

#include "sim/hosts/host_config.hpp"
#include "sim/masters/chip_config.hpp"

namespace mb4::sim {

class TomlReader;

struct Master {
  std::string_view type;                      // value of `type` in [master]
  std::span<const HostInterface> interfaces;  // the first is the default
  unsigned channels;
  unsigned slaves;         // of all channels together
  unsigned slaves_shared;  // of each channel if another channel than the first is in use
  // Limits of f_clk_hz (but 0) and f_osc_hz.
  std::int64_t min_clk_hz;
  std::int64_t max_clk_hz;
  std::int64_t min_osc_hz;
  std::int64_t max_osc_hz;
  // Reads [chip.quirks].
  void (*read_quirks)(TomlReader& reader, ChipConfig& chip);
  // Reads the keys of [host] that are not about its interface.
  void (*read_host)(TomlReader& reader, const ChipConfig& chip, HostConfig& host);

  // Number of the first slave of a channel, from 1 on.
  constexpr unsigned first_slave(unsigned channel) const {
    return 1 + (channel - 1) * slaves_shared;
  }
};

// In the order in which they are listed to the user. The first is the default.
std::span<const Master* const> masters();

}  // namespace mb4::sim

#endif  // MB4SIM_MASTER_HPP_
