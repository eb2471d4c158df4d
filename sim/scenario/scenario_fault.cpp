// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scenario/scenario_fault.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/number_text.hpp"
#include "sim/core/toml_reader.hpp"
#include "sim/faults/fault_types.hpp"
#include "sim/lines/line_kind.hpp"

namespace mb4::sim {
namespace {

constexpr double kMaxTimeUs = 1e9;
constexpr double kMinPerS = 1e-6;
constexpr double kMaxPerS = 1e7;

// Number of bits of a frame that a random bit-flip may hit: start bit, CDS, data and CRC of all
// slaves, or those of an answer.
unsigned frame_bits(const ChannelConfig& channel) {
  if (channel.protocol().answer_bits != 0) return channel.protocol().answer_bits;
  unsigned bits = channel.protocol().leading_bits();
  for (const SlaveConfig& slave : channel.slaves) bits += slave.data_bits() + slave.crc().width();
  return std::max(bits, 1U);
}

// Refuses a key that only other kinds of fault have.
void refuse(TomlReader& reader, const FaultType& kind, const char* key) {
  if (!reader.has(key)) return;
  reader.fail(key, "a fault of kind '" + std::string(kind.name) + "' has no such key");
}

void read_line(TomlReader& reader, const Scenario& scenario, FaultConfig& fault) {
  const auto number = reader.integer("channel", 1, scenario.master->channels);
  if (!number && scenario.channels.size() > 1) {
    const std::size_t count = scenario.channels.size();
    const std::string there = count == 2 ? "two" : std::to_string(count);
    reader.missing("channel", "missing: there are " + there);
  }
  if (!number && scenario.channels.empty()) reader.fail("channel", "the scenario has none");
  fault.channel = number ? static_cast<unsigned>(*number) : scenario.channels.front().number;
  const ChannelConfig* channel = scenario.channel(fault.channel);
  if (channel == nullptr) {
    const std::string there = std::to_string(
        scenario.channels.empty() ? fault.channel : scenario.channels.front().number);
    const std::string asked = std::to_string(fault.channel);
    reader.fail("channel", "the scenario has no channel " + asked + "; write channel = " + there +
                               ", or [[channel]] with number = " + asked);
  }
  fault.frame_bits = frame_bits(*channel);
  fault.answer_bits = channel->protocol().answer_bits;
}

// Numbers of the slaves, in the order of the file.
std::vector<unsigned> slaves_of(const Scenario& scenario) {
  std::vector<unsigned> numbers;
  for (const ChannelConfig& channel : scenario.channels) {
    const unsigned first = scenario.master->first_slave(channel.number);
    for (unsigned i = 0; i < channel.slaves.size(); ++i) numbers.push_back(first + i);
  }
  return numbers;
}

// "; it has 1, 2, 5": those that there are. Users also count the slaves of all channels in a row.
std::string others(const std::vector<unsigned>& there, const FaultConfig& fault) {
  std::string text;
  for (const unsigned each : there)
    text += (text.empty() ? "; it has " : ", ") + std::to_string(each);
  if (fault.slave == 0 || fault.slave > there.size()) return text;
  const std::string place = std::to_string(fault.slave);
  return text + "; the one in place " + place +
         " of the file is slave = " + std::to_string(there[fault.slave - 1]);
}

void read_slave_fault(TomlReader& reader, const Scenario& scenario, FaultConfig& fault) {
  const std::vector<unsigned> there = slaves_of(scenario);
  const auto number = reader.integer("slave", 1, scenario.master->slaves);
  if (!number && there.size() != 1) return reader.missing("slave");
  fault.slave = number ? static_cast<unsigned>(*number) : there.front();
  fault.channel = scenario.channel_of(fault.slave);
  const SlaveConfig* slave = scenario.slave(fault.slave);
  if (slave == nullptr) {
    reader.fail("slave",
                "the scenario has no slave " + std::to_string(fault.slave) + others(there, fault));
  }
  const SlaveFault* of_slave = fault.kind->of_slave;
  if (of_slave == nullptr) return;
  const std::string_view refusal = slave->device->refuses(*of_slave);
  if (!refusal.empty()) reader.fail("slave", std::string(refusal));
  if (of_slave->needs_next && (scenario.slave(fault.slave + 1) == nullptr ||
                               scenario.channel_of(fault.slave + 1) != fault.channel)) {
    reader.fail("slave", "there is no slave behind it");
  }
}

void read_place(TomlReader& reader, const Scenario& scenario, FaultConfig& fault) {
  switch (fault.kind->place) {
    case FaultPlace::kLine:
      return read_line(reader, scenario, fault);
    case FaultPlace::kSlave:
      return read_slave_fault(reader, scenario, fault);
    case FaultPlace::kHost: {
      const std::string_view refusal = scenario.host.interface.refuses_abort;
      if (!refusal.empty()) reader.fail("kind", std::string(refusal));
      return;
    }
    case FaultPlace::kClock:
      if (scenario.chip.f_clk_hz == 0) reader.fail("kind", "there is no clock at pin CLK");
      return;
  }
}

// Reads a time or a list of times.
void read_at(TomlReader& reader, FaultConfig& fault) {
  const TomlValue* value = reader.value("at_us", {"number", "array"});
  const auto add = [&](const TomlValue& item) {
    if (!item.is_number() || !(item.number >= 0 && item.number <= kMaxTimeUs)) {
      reader.fail_at(item.where, "at_us",
                     "expected microseconds of 0 to " + plain(kMaxTimeUs) + ", or a list of them");
    }
    fault.at.push_back(from_us(item.number));
  };
  if (value->is(TomlValue::Kind::kArray)) {
    if (value->items.empty()) reader.fail("at_us", "the list is empty");
    for (const TomlValue& item : value->items) add(item);
  } else {
    add(*value);
  }
}

void read_when(TomlReader& reader, FaultConfig& fault) {
  if (fault.frame != 0) {
    for (const char* key : {"at_us", "per_s", "from_us", "to_us", "for_us"}) {
      if (reader.has(key)) reader.fail(key, "cannot be given together with frame");
    }
    fault.at.push_back(0);
    return;
  }
  const char* const one = fault.kind->by_frame
                              ? "one of at_us (fixed times), per_s (random) and frame is needed"
                              : "one of at_us (fixed times) and per_s (random) is needed";
  if (reader.has("at_us") && reader.has("per_s")) reader.fail("at_us", one);
  if (!reader.has("at_us") && !reader.has("per_s")) {
    reader.missing("at_us", one);
    reader.know({"per_s", "from_us", "to_us"});
  } else if (reader.has("at_us")) {
    read_at(reader, fault);
    for (const char* key : {"from_us", "to_us"}) {
      if (reader.has(key)) reader.fail(key, "only together with per_s");
    }
  } else {
    fault.per_s = *reader.number("per_s", kMinPerS, kMaxPerS);
    fault.from = from_us(reader.number("from_us", 0, kMaxTimeUs).value_or(0));
    if (const auto to = reader.number("to_us", 0, kMaxTimeUs)) fault.to = from_us(*to);
    if (fault.to < fault.from) reader.fail("to_us", "is before from_us");
  }
  if (fault.kind->momentary) {
    refuse(reader, *fault.kind, "for_us");
    return;
  }
  if (const auto us = reader.number("for_us", 0.001, kMaxTimeUs)) {
    fault.duration = from_us(*us);
  } else if (fault.at.empty()) {
    reader.missing("for_us", "missing: how long does each of them last?");
  }
}

}  // namespace

FaultConfig read_fault(const TomlValue& table, const Scenario& scenario, TomlFile& file) {
  TomlReader reader(table, file);
  FaultConfig fault;
  std::vector<std::string_view> names;
  for (const FaultType& type : fault_types()) names.push_back(type.name);
  const auto kind = reader.choice("kind", names);
  if (!kind) {
    reader.missing("kind");
    reader.know({"channel", "bits", "on", "level", "width_ns", "jitter_ns", "slave", "after_clocks",
                 "hz", "frame", "answer_bit", "at_us", "per_s", "from_us", "to_us", "for_us"});
    reader.finish();
    return fault;
  }
  const FaultType& type = fault_types()[*kind];
  fault.kind = &type;
  read_place(reader, scenario, fault);
  type.read(
      reader,
      {scenario.master->min_clk_hz, scenario.master->max_clk_hz, scenario.master->line->wires},
      fault);
  read_when(reader, fault);
  reader.finish();
  fault.scenario_line = reader.source().table.line;
  return fault;
}

}  // namespace mb4::sim
