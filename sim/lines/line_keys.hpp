// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Keys of a channel that lines of every kind have.
#ifndef MB4SIM_LINE_KEYS_HPP_
#define MB4SIM_LINE_KEYS_HPP_

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "sim/core/time.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/core/wire_faults.hpp"
#include "sim/lines/line.hpp"
#include "sim/lines/line_kind.hpp"

namespace mb4::sim {

// Each throws ScenarioError.

// delay_ns, cable_m, ns_per_m, transceiver_ns: the round trip, ps.
Time read_delay(TomlReader& reader);
// A delay in ns by `key`, of the same range.
std::optional<Time> read_delay(TomlReader& reader, const char* key);
// Jitter, skew and glitches of a wire whose keys begin with `prefix`.
WireFaults read_wire_faults(TomlReader& reader, const std::string& prefix);
// glitch_ns, which needs glitches on one of two wires, whose keys begin with `prefix` or without.
void read_glitch_width(TomlReader& reader, WireFaults& plain, WireFaults& prefixed,
                       const std::string& prefix);
// flips = [[frame, bit, ...], ...]
std::map<std::uint64_t, std::vector<unsigned>> read_flips(TomlReader& reader);
// Tables [[channel.event]].
std::vector<LineEvent> read_events(TomlReader& reader, std::span<const WireName> wires);

}  // namespace mb4::sim

#endif  // MB4SIM_LINE_KEYS_HPP_
