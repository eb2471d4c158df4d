// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/line_keys.hpp"

#include <cmath>
#include <string_view>

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

std::int64_t signed_ps(double ns) { return std::llround(ns * 1e3); }

// The names of the actions, in their order: unplug, plug, then three of each wire.
std::vector<std::string> action_names(std::span<const WireName> wires) {
  std::vector<std::string> names{"unplug", "plug"};
  for (const WireName& wire : wires) {
    for (const char* end : {"-low", "-high", "-free"}) names.push_back(std::string(wire.key) + end);
  }
  return names;
}

LineAction action_of(unsigned place) {
  using What = LineAction::What;
  if (place < 2) return {place == 0 ? What::kUnplug : What::kPlug, 0};
  constexpr What kOfWire[] = {What::kLow, What::kHigh, What::kFree};
  return {kOfWire[(place - 2) % 3], (place - 2) / 3};
}

LineEvent read_event(const TomlValue& table, TomlFile& file,
                     const std::vector<std::string_view>& names) {
  TomlReader reader(table, file);
  LineEvent event;
  const auto at = reader.number("at_us", 0, kMaxEventUs);
  if (!at) reader.missing("at_us");
  event.time = from_us(at.value_or(0));
  const auto action = reader.choice("action", names);
  if (!action) reader.missing("action");
  event.action = action_of(static_cast<unsigned>(action.value_or(0)));
  reader.finish();
  return event;
}

}  // namespace

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

std::optional<Time> read_delay(TomlReader& reader, const char* key) {
  const auto ns = reader.number(key, 0, kMaxDelayNs);
  return ns ? std::optional(from_ns(*ns)) : std::nullopt;
}

WireFaults read_wire_faults(TomlReader& reader, const std::string& prefix) {
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

void read_glitch_width(TomlReader& reader, WireFaults& plain, WireFaults& prefixed,
                       const std::string& prefix) {
  const auto ns = reader.number("glitch_ns", kMinGlitchNs, kMaxEdgeNs);
  if (!ns) return;
  if (plain.glitches_per_s == 0 && prefixed.glitches_per_s == 0) {
    reader.fail("glitch_ns", "only together with glitches_per_s or " + prefix + "glitches_per_s");
  }
  plain.glitch_width = prefixed.glitch_width = from_ns(*ns);
}

std::map<std::uint64_t, std::vector<unsigned>> read_flips(TomlReader& reader) {
  std::map<std::uint64_t, std::vector<unsigned>> flips;
  const TomlValue* frames = reader.value("flips", {"array"});
  if (frames == nullptr) return flips;
  const std::string wanted = "expected lists of a frame from 1 on and bits of 0 to 4095";
  if (!frames->is(TomlValue::Kind::kArray)) reader.fail("flips", wanted);
  for (const TomlValue& each : frames->items) {
    const std::vector<TomlValue>& numbers = each.items;
    if (numbers.size() < 2) reader.fail_at(each.where, "flips", wanted);
    if (!numbers[0].within(1, std::numeric_limits<std::int64_t>::max()))
      reader.fail_at(numbers[0].where, "flips", wanted);
    auto& bits = flips[static_cast<std::uint64_t>(numbers[0].integer)];
    for (std::size_t i = 1; i < numbers.size(); ++i) {
      if (!numbers[i].within(0, kMaxFlipBit)) reader.fail_at(numbers[i].where, "flips", wanted);
      bits.push_back(static_cast<unsigned>(numbers[i].integer));
    }
  }
  return flips;
}

std::vector<LineEvent> read_events(TomlReader& reader, std::span<const WireName> wires) {
  std::vector<LineEvent> events;
  const std::vector<std::string> names = action_names(wires);
  if (const auto* tables = reader.tables("event")) {
    for (const auto& node : *tables) {
      events.push_back(read_event(node, reader.file(), {names.begin(), names.end()}));
    }
  }
  return events;
}

}  // namespace mb4::sim
