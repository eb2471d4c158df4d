// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scenario/scenario_channel.hpp"

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/number_text.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/scenario/scenario_slave.hpp"

namespace mb4::sim {
namespace {

constexpr double kMaxDelayNs = 1e6;
constexpr double kNsPerMetre = 5.3;  // each way
constexpr double kMaxNsPerMetre = 100;
constexpr double kMaxCableM = 10'000;
constexpr double kMaxEdgeNs = 1e5;  // transceivers, jitter, skew, glitches
constexpr double kDefaultGlitchNs = 10;
constexpr double kMinGlitchNs = 0.001;
constexpr std::int64_t kMaxGlitchesPerS = 10'000'000;
constexpr double kMaxEventUs = 1e9;
constexpr std::int64_t kMaxFlipBit = 4095;

Time read_delay(TomlReader& reader) {
  const auto delay = reader.number("delay_ns", 0, kMaxDelayNs);
  const auto cable = reader.number("cable_m", 0, kMaxCableM);
  const auto ns_per_m = reader.number("ns_per_m", 0, kMaxNsPerMetre);
  if (delay && cable) reader.fail("cable_m", "cannot be given together with delay_ns");
  if (ns_per_m && !cable) reader.fail("ns_per_m", "only together with cable_m");
  Time round_trip = 0;
  if (delay) round_trip = from_ns(*delay);
  if (cable) round_trip = 2 * from_ns(*cable * ns_per_m.value_or(kNsPerMetre));
  if (const auto ns = reader.number("transceiver_ns", 0, kMaxEdgeNs)) {
    round_trip += 2 * from_ns(*ns);
  }
  return round_trip;
}

std::int64_t signed_ps(double ns) { return std::llround(ns * 1e3); }

// Keys of the way out begin with "ma_". Keys of the way back have no prefix.
WireFaults read_faults(TomlReader& reader, const std::string& prefix) {
  WireFaults faults;
  if (const auto ns = reader.number(prefix + "jitter_ns", 0, kMaxEdgeNs)) {
    faults.jitter = from_ns(*ns);
  }
  if (const auto ns = reader.number(prefix + "skew_ns", -kMaxEdgeNs, kMaxEdgeNs)) {
    faults.skew = signed_ps(*ns);
  }
  if (const auto rate = reader.integer(prefix + "glitches_per_s", 0, kMaxGlitchesPerS)) {
    faults.glitches_per_s = static_cast<std::uint64_t>(*rate);
  }
  faults.glitch_width = from_ns(kDefaultGlitchNs);
  return faults;
}

// flips = [[frame, bit, ...], ...]
void read_flips(TomlReader& reader, ChannelConfig& channel) {
  const toml::node* node = reader.node("flips");
  if (node == nullptr) return;
  const std::string wanted = "expected lists of a frame from 1 on and bits of 0 to 4095";
  const toml::array* frames = node->as_array();
  if (frames == nullptr) reader.fail("flips", wanted);
  for (const toml::node& each : *frames) {
    const toml::array* list = each.as_array();
    if (list == nullptr || list->size() < 2) reader.fail_at(each.source(), "flips", wanted);
    std::vector<std::int64_t> numbers;
    for (const toml::node& item : *list) {
      const auto* number = item.as_integer();
      const bool is_frame = numbers.empty();
      if (number == nullptr || number->get() < (is_frame ? 1 : 0) ||
          (!is_frame && number->get() > kMaxFlipBit)) {
        reader.fail_at(item.source(), "flips", wanted);
      }
      numbers.push_back(number->get());
    }
    auto& bits = channel.flips[static_cast<std::uint64_t>(numbers[0])];
    for (std::size_t i = 1; i < numbers.size(); ++i) {
      bits.push_back(static_cast<unsigned>(numbers[i]));
    }
  }
}

struct ActionName {
  CableEvent::Action action;
  std::string_view name;
};
constexpr ActionName kActions[] = {
    {CableEvent::Action::kUnplug, "unplug"},  {CableEvent::Action::kPlug, "plug"},
    {CableEvent::Action::kSlLow, "sl-low"},   {CableEvent::Action::kSlHigh, "sl-high"},
    {CableEvent::Action::kSlFree, "sl-free"}, {CableEvent::Action::kMaLow, "ma-low"},
    {CableEvent::Action::kMaHigh, "ma-high"}, {CableEvent::Action::kMaFree, "ma-free"},
};

CableEvent read_event(const toml::table& table, TomlFile& file) {
  TomlReader reader(table, file);
  CableEvent event;
  const auto at = reader.number("at_us", 0, kMaxEventUs);
  if (!at) reader.missing("at_us");
  event.time = from_us(at.value_or(0));
  std::vector<std::string_view> names;
  for (const ActionName& each : kActions) names.push_back(each.name);
  const auto action = reader.choice("action", names);
  if (!action) reader.missing("action");
  event.action = kActions[action.value_or(0)].action;
  reader.finish();
  return event;
}

CableConfig read_cable(TomlReader& reader) {
  CableConfig cable;
  cable.sl = read_faults(reader, "");
  cable.ma = read_faults(reader, "ma_");
  if (const auto ns = reader.number("glitch_ns", kMinGlitchNs, kMaxEdgeNs)) {
    if (cable.sl.glitches_per_s == 0 && cable.ma.glitches_per_s == 0) {
      reader.fail("glitch_ns", "only together with glitches_per_s or ma_glitches_per_s");
    }
    cable.sl.glitch_width = cable.ma.glitch_width = from_ns(*ns);
  }
  cable.open_level = reader.integer("open_level", 0, 1).value_or(1) != 0;
  cable.mo = reader.boolean("mo").value_or(false);
  cable.events = read_events(reader);
  return cable;
}

// The key states the delay of one way. The simulator needs how much later MO is than MA.
void read_mo_delay(TomlReader& reader, ChannelConfig& channel) {
  const auto ns = reader.number("mo_delay_ns", 0, kMaxDelayNs);
  if (!ns) return;
  if (!channel.cable.mo) reader.fail("mo_delay_ns", "only together with mo = true");
  const Time ma = channel.delay / 2;
  if (from_ns(*ns) < ma) {
    reader.fail("mo_delay_ns",
                "MO must not overtake MA, which takes " + plain(to_ns(ma)) + " ns one way");
  }
  channel.cable.mo_late = from_ns(*ns) - ma;
}

// Checks whether the newest slave of a channel fits the others.
void check_slave(const TomlReader& reader, const ChannelConfig& channel,
                 const toml::source_region& where) {
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
  if (newest.actuator && !channel.cable.mo) {
    reader.fail_at(where, "actuator", "an actuator needs mo = true on its channel");
  }
}

// Each slave learns how many IDs are behind it.
void set_ids(ChannelConfig& channel) {
  unsigned ids = 0;
  for (auto slave = channel.slaves.rbegin(); slave != channel.slaves.rend(); ++slave) {
    ids += slave->device->set_ids_behind(ids);
  }
}

}  // namespace

std::vector<CableEvent> read_events(TomlReader& channel) {
  std::vector<CableEvent> events;
  if (const auto* tables = channel.tables("event")) {
    for (const auto& node : *tables) events.push_back(read_event(*node.as_table(), channel.file()));
  }
  return events;
}

ChannelConfig read_channel(const toml::table& table, TomlFile& file, const Master& master) {
  TomlReader reader(table, file);
  ChannelConfig channel;
  const auto number = reader.integer("number", 1, master.channels);
  if (!number) reader.missing("number");
  channel.number = static_cast<unsigned>(number.value_or(1));
  channel.delay = read_delay(reader);
  channel.cable = read_cable(reader);
  read_flips(reader, channel);
  read_mo_delay(reader, channel);
  if (const auto* slaves = reader.tables("slave")) {
    for (const auto& node : *slaves) {
      const unsigned most = master.chain == 0 ? master.slaves : master.chain;
      if (channel.slaves.size() == most) {
        reader.fail_at(node.source(), "slave",
                       "more than " + std::to_string(most) + (most == 1 ? " slave" : " slaves") +
                           " on a channel");
      }
      channel.slaves.push_back(read_slave(*node.as_table(), file));
      check_slave(reader, channel, node.source());
    }
  }
  set_ids(channel);
  reader.finish();
  channel.source = reader.source();
  return channel;
}

}  // namespace mb4::sim
