// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scenario/scenario_channel.hpp"

#include <string>

#include "sim/core/toml_reader.hpp"
#include "sim/lines/line_kind.hpp"
#include "sim/scenario/scenario_slave.hpp"

namespace mb4::sim {
namespace {

// Checks whether the newest slave of a channel fits the others.
void check_slave(const TomlReader& reader, const ChannelConfig& channel, const LineKind& line,
                 const SourcePos& where) {
  const DeviceTraits newest = channel.slaves.back().traits();
  if (channel.slaves.size() > 1) {
    const DeviceTraits first = channel.slaves.front().traits();
    for (const DeviceTraits& each : {newest, first}) {
      if (!each.alone.empty()) {
        reader.fail_at(where, "protocol",
                       std::string(each.alone) + " must be alone on its channel");
      }
    }
    if (newest.protocol != first.protocol) {
      reader.fail_at(where, "protocol", "all slaves of a channel must have the same protocol");
    }
  }
  if (line.check != nullptr) line.check(reader, *channel.cable, newest, where);
}

// Each slave learns how many IDs are behind it.
void set_ids(ChannelConfig& channel) {
  unsigned ids = 0;
  for (auto slave = channel.slaves.rbegin(); slave != channel.slaves.rend(); ++slave) {
    ids += slave->device->set_ids_behind(ids);
  }
}

}  // namespace

ChannelConfig read_channel(const TomlValue& table, TomlFile& file, const Master& master,
                           unsigned place) {
  TomlReader reader(table, file);
  ChannelConfig channel;
  const auto number = reader.integer("number", 1, master.channels);
  if (!number && place > master.channels) {
    reader.fail("number", "the master has no channel " + std::to_string(place));
  }
  channel.number = number ? static_cast<unsigned>(*number) : place;
  channel.cable = master.line->read(reader);
  if (const auto* slaves = reader.tables("slave")) {
    for (const auto& node : *slaves) {
      const unsigned most = master.slaves_single == 0 ? master.slaves : master.slaves_single;
      if (channel.slaves.size() == most) {
        reader.fail_at(node.where, "slave",
                       "more than " + std::to_string(most) + (most == 1 ? " slave" : " slaves") +
                           " on a channel");
      }
      channel.slaves.push_back(read_slave(node, file, master));
      check_slave(reader, channel, *master.line, node.where);
    }
  }
  set_ids(channel);
  reader.finish();
  channel.source = reader.source();
  return channel;
}

}  // namespace mb4::sim
