// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A kind of line: how a channel of a scenario is read, what a master drives, how the line is made,
// and its wires, from which its actions and faults follow. A master has one kind for all its lines
// (Master::line), and so has a protocol (Protocol::line).
#ifndef MB4SIM_LINE_KIND_HPP_
#define MB4SIM_LINE_KIND_HPP_

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "sim/core/copied.hpp"
#include "sim/core/event_queue.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/lines/device.hpp"
#include "sim/lines/line.hpp"

namespace mb4::sim {

// What a line is made from. All references outlive the line.
struct LineSetup {
  EventQueue& queue;
  const LineConfig& config;
  LineProtocol protocol;
  std::uint64_t seed;
  LineMaster& master;
  unsigned index;  // number of the channel - 1
};

struct LineKind {
  std::string_view key;  // for the user
  // Levels of the bits that a master drives on each line, before it drives any.
  unsigned rest;
  // The first is the one that a fault without `on` concerns.
  std::span<const WireName> wires;
  // Reads the keys of a channel but `number` and `slave`. Throws ScenarioError.
  Copied<LineConfig> (*read)(TomlReader& reader);
  // Refuses a device that does not fit the cable. Null: all do.
  void (*check)(const TomlReader& reader, const LineConfig& config, const DeviceTraits& device,
                const SourcePos& where);
  // A cable without devices; add() of the kind's class takes them.
  std::unique_ptr<Line> (*make)(const LineSetup& setup);
  // Appends a device at the end away from the master. The device must be one of this kind.
  void (*add)(Line& line, std::unique_ptr<Slave> slave);
  // The end of a channel that the scenario does not have.
  std::unique_ptr<LineEnd> (*make_open)(LineMaster& master, unsigned index);
};

}  // namespace mb4::sim

#endif  // MB4SIM_LINE_KIND_HPP_
