// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The protocols that a slave of a scenario can have. protocols.cpp holds the only list of them. To
// add one, write its DeviceConfig and its Protocol in a room of its own and name the latter there.
#ifndef MB4SIM_PROTOCOLS_HPP_
#define MB4SIM_PROTOCOLS_HPP_

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/toml_reader.hpp"
#include "sim/lines/device.hpp"
#include "sim/lines/line_kind.hpp"
#include "sim/lines/presets.hpp"

namespace mb4::sim {

struct Protocol {
  std::string_view key;  // value of `protocol` in the scenario
  const LineKind* line;  // of its channels
  // Names every key that read() may ask for to TomlReader::know().
  void (*know_keys)(TomlReader& reader);
  // A device without a preset.
  Device (*blank)();
  // Null if the protocol has no presets, and so no key `preset`.
  std::vector<Preset> (*presets)();
  // Reads the keys of a slave but `protocol`, `preset` and `registers`. On entry `device` is the
  // preset's, or blank() with data_bits = 0: then the user must give the length. `file` becomes the
  // path of the file that the slave names, if there is one. Throws ScenarioError.
  void (*read)(TomlReader& reader, DeviceConfig& device, std::string& file);
  // The faults that only its slaves can have.
  std::span<const SlaveFault* const> faults{};
  // Tables below a slave in which read() asks for all their keys, for those who list the keys.
  std::string_view sample{};
};

// In the order in which they are listed to the user.
std::span<const Protocol* const> protocols();

// A program adds a protocol of its own before it reads a scenario. `protocol` must live on.
void add_protocol(const Protocol& protocol);

}  // namespace mb4::sim

#endif  // MB4SIM_PROTOCOLS_HPP_
