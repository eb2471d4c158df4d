// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the keys of a scenario that say how the host is connected. Throws ScenarioError.
#ifndef MB4SIM_HOST_KEYS_HPP_
#define MB4SIM_HOST_KEYS_HPP_

#include <cstdint>
#include <span>

#include "sim/core/toml_reader.hpp"
#include "sim/hosts/host_config.hpp"

namespace mb4::sim {

// `accepted`: the interfaces of the master, in the order in which they are listed to the user. The
// first is the default.
void read_interface(TomlReader& reader, std::span<const HostInterface> accepted, HostConfig& host);

// For a master with such hosts: the keys of SPI and SPI2, and those of the parallel bus.
void read_spi_keys(TomlReader& reader, HostConfig& host);
void read_parallel_keys(TomlReader& reader, HostConfig& host);
// Those of a bus of words, whose clock is `clk_hz` without a key.
void read_word_keys(TomlReader& reader, std::uint64_t clk_hz, HostConfig& host);
// frame_us, for a master whose frames the host starts one by one.
void read_frame_key(TomlReader& reader, HostConfig& host);

}  // namespace mb4::sim

#endif  // MB4SIM_HOST_KEYS_HPP_
