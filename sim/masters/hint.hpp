// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Hints: what a master was told by its host, held against what stands on its lines. A hint compares
// set-ups only. So a line that fits gives none, whatever faults it has.
#ifndef MB4SIM_HINT_HPP_
#define MB4SIM_HINT_HPP_

#include <string>
#include <string_view>
#include <vector>

#include "sim/core/time.hpp"

namespace mb4::sim {

struct DeviceConfig;

struct Hint {
  std::string_view kind;  // one word that stays: "length", "crc" (sim/README.md lists them)
  std::string place;      // "slave 1", "channel 2", "chip", "host"
  std::string text;       // the whole sentence

  bool operator==(const Hint&) const = default;
};

// A device on a line.
struct HintDevice {
  unsigned number;             // of the slave, from 1 on
  const DeviceConfig* config;  // what it is
  bool sends;                  // false: it has been told to leave its data out
};

// A line of the scenario as it is now.
struct HintLine {
  unsigned channel;           // from 1 on
  Time round_trip;            // ps
  std::string_view protocol;  // key and title of the protocol of its devices
  std::string_view protocol_title;
  std::vector<HintDevice> devices;  // the nearest to the master first
};

}  // namespace mb4::sim

#endif  // MB4SIM_HINT_HPP_
