// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "scenario_fault.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "number_text.hpp"
#include "toml_reader.hpp"

namespace mb4::sim {
namespace {

constexpr double kMaxTimeUs = 1e9;
constexpr double kMaxWidthNs = 1e5;
constexpr double kMinWidthNs = 0.001;
constexpr double kMinPerS = 1e-6;
constexpr double kMaxPerS = 1e7;
constexpr std::int64_t kMaxBit = 4095;

bool is_line(FaultKind kind) {
  return kind == FaultKind::kBitFlip || kind == FaultKind::kGlitch || kind == FaultKind::kStuck ||
         kind == FaultKind::kJitter;
}

bool is_slave(FaultKind kind) {
  return kind == FaultKind::kSilent || kind == FaultKind::kBusy || kind == FaultKind::kWrongCrc ||
         kind == FaultKind::kWrongId || kind == FaultKind::kUnplug;
}

// The fault of a slave of this kind, which is not kUnplug.
SlaveFault slave_fault(FaultKind kind) {
  return kind == FaultKind::kSilent     ? SlaveFault::kSilent
         : kind == FaultKind::kBusy     ? SlaveFault::kBusy
         : kind == FaultKind::kWrongCrc ? SlaveFault::kWrongCrc
                                        : SlaveFault::kWrongId;
}

// Number of bits of a frame that a random bit-flip may hit: start bit, CDS, data and CRC of all
// slaves.
unsigned frame_bits(const ChannelConfig& channel) {
  unsigned bits = channel.protocol().leading_bits();
  for (const SlaveConfig& slave : channel.slaves) bits += slave.data_bits() + slave.crc().width();
  return std::max(bits, 1U);
}

// Refuses a key that only other kinds of fault have.
void refuse(TomlReader& reader, FaultKind kind, const char* key) {
  if (!reader.has(key)) return;
  reader.fail(key, "a fault of kind '" + std::string(to_string(kind)) + "' has no such key");
}

std::vector<unsigned> read_bits(TomlReader& reader, const char* key, std::int64_t minimum) {
  std::vector<unsigned> bits;
  const toml::node* node = reader.node(key);
  if (node == nullptr) return bits;
  const std::string wanted = "expected a list of " + std::to_string(minimum) + " to 4095";
  const toml::array* list = node->as_array();
  if (list == nullptr || list->empty()) reader.fail(key, wanted);
  for (const toml::node& item : *list) {
    const auto* number = item.as_integer();
    if (number == nullptr || number->get() < minimum || number->get() > kMaxBit) {
      reader.fail_at(item.source(), key, wanted);
    }
    bits.push_back(static_cast<unsigned>(number->get()));
  }
  return bits;
}

void read_line(TomlReader& reader, const Scenario& scenario, FaultConfig& fault) {
  const auto number = reader.integer("channel", 1, scenario.master->channels);
  if (!number && scenario.channels.size() > 1) reader.missing("channel", "missing: there are two");
  if (!number && scenario.channels.empty()) reader.fail("channel", "the scenario has none");
  fault.channel = number ? static_cast<unsigned>(*number) : scenario.channels.front().number;
  const ChannelConfig* channel = scenario.channel(fault.channel);
  if (channel == nullptr) {
    reader.fail("channel", "the scenario has no channel " + std::to_string(fault.channel));
  }
  if (fault.kind == FaultKind::kBitFlip) {
    fault.bits = read_bits(reader, "bits", 0);
    fault.frame_bits = frame_bits(*channel);
  } else {
    fault.on_ma = reader.choice("on", {"sl", "ma"}).value_or(0) == 1;
  }
  if (fault.kind == FaultKind::kStuck) {
    const auto level = reader.integer("level", 0, 1);
    if (!level) reader.missing("level");
    fault.level = level == 1;
  }
  if (fault.kind == FaultKind::kGlitch || fault.kind == FaultKind::kJitter) {
    const char* const key = fault.kind == FaultKind::kGlitch ? "width_ns" : "jitter_ns";
    const auto width = reader.number(key, kMinWidthNs, kMaxWidthNs);
    if (!width) reader.missing(key);
    fault.width = from_ns(width.value_or(1));
  }
}

void read_slave_fault(TomlReader& reader, const Scenario& scenario, FaultConfig& fault) {
  const auto number = reader.integer("slave", 1, scenario.master->slaves);
  if (!number) return reader.missing("slave");
  fault.slave = static_cast<unsigned>(*number);
  fault.channel = scenario.channel_of(fault.slave);
  const SlaveConfig* slave = scenario.slave(fault.slave);
  if (slave == nullptr) {
    reader.fail("slave", "the scenario has no slave " + std::to_string(fault.slave));
  }
  if (fault.kind == FaultKind::kUnplug) return;
  const std::string_view refusal = slave->device->refuses(slave_fault(fault.kind));
  if (!refusal.empty()) reader.fail("slave", std::string(refusal));
}

void read_device(TomlReader& reader, const Scenario& scenario, FaultConfig& fault) {
  if (is_line(fault.kind)) {
    read_line(reader, scenario, fault);
  } else if (is_slave(fault.kind)) {
    read_slave_fault(reader, scenario, fault);
  } else if (fault.kind == FaultKind::kAbort) {
    const std::string_view refusal = host_kind(scenario.host.interface).refuses_abort;
    if (!refusal.empty()) reader.fail("kind", std::string(refusal));
    if (const auto bits = reader.integer("after_clocks", 1, kMaxBit)) {
      fault.bits.push_back(static_cast<unsigned>(*bits));
    }
  } else {
    if (scenario.chip.f_clk_hz == 0) reader.fail("kind", "there is no clock at pin CLK");
    if (fault.kind != FaultKind::kClockFrequency) return;
    const auto hz = reader.integer("hz", scenario.master->min_clk_hz, scenario.master->max_clk_hz);
    if (!hz) reader.missing("hz");
    fault.hz = static_cast<std::uint64_t>(hz.value_or(1));
  }
}

// Reads a time or a list of times.
void read_at(TomlReader& reader, FaultConfig& fault) {
  const toml::node* node = reader.node("at_us");
  const auto add = [&](const toml::node& item) {
    const auto value = item.value<double>();
    if (!item.is_number() || !(*value >= 0 && *value <= kMaxTimeUs)) {
      reader.fail_at(item.source(), "at_us",
                     "expected microseconds of 0 to " + plain(kMaxTimeUs) + ", or a list of them");
    }
    fault.at.push_back(from_us(*value));
  };
  if (const toml::array* list = node->as_array()) {
    if (list->empty()) reader.fail("at_us", "the list is empty");
    for (const toml::node& item : *list) add(item);
  } else {
    add(*node);
  }
}

void read_when(TomlReader& reader, FaultConfig& fault) {
  const char* const one = "one of at_us (fixed times) and per_s (random) is needed";
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
  if (is_momentary(fault.kind)) {
    refuse(reader, fault.kind, "for_us");
    return;
  }
  if (const auto us = reader.number("for_us", 0.001, kMaxTimeUs)) {
    fault.duration = from_us(*us);
  } else if (fault.at.empty()) {
    reader.missing("for_us", "missing: how long does each of them last?");
  }
}

}  // namespace

FaultConfig read_fault(const toml::table& table, const Scenario& scenario, TomlFile& file) {
  TomlReader reader(table, file);
  FaultConfig fault;
  // The order is that of FaultKind.
  const auto kind =
      reader.choice("kind", {"bit-flip", "glitch", "stuck", "jitter", "silent", "busy", "wrong-crc",
                             "wrong-id", "unplug", "abort", "clock-frequency", "clock-stop"});
  if (!kind) {
    reader.missing("kind");
    reader.know({"channel", "bits", "on", "level", "width_ns", "jitter_ns", "slave", "after_clocks",
                 "hz", "at_us", "per_s", "from_us", "to_us", "for_us"});
    reader.finish();
    return fault;
  }
  fault.kind = static_cast<FaultKind>(*kind);
  read_device(reader, scenario, fault);
  read_when(reader, fault);
  reader.finish();
  fault.line = reader.source().table.line;
  return fault;
}

}  // namespace mb4::sim
