// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/dsl/dsl_protocol.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "sim/lines/dsl/dsl_faults.hpp"
#include "sim/lines/dsl/dsl_slave.hpp"
#include "sim/lines/duplex/duplex_lines.hpp"
#include "sim/lines/sensor_keys.hpp"

namespace mb4::sim {
namespace {

constexpr unsigned kLeastPosition = 12;
constexpr unsigned kMostPosition = 40;
constexpr double kMaxLatencyNs = 1e4;
constexpr double kMaxPpm = 1000;
constexpr std::string_view kFollows[] = {"ignore", "follow"};

void know_keys(TomlReader& reader) {
  know_source_keys(reader);
  reader.know({"position_bits",
               "acceleration_bits",
               "index",
               "signed",
               "summary",
               "safe2_bits",
               "pipeline",
               "s_par_bits",
               "sync_frames",
               "vsync_after",
               "msync",
               "first",
               "vsync_phase",
               "start_disparity",
               "direction_bit",
               "lead_ns",
               "lead_level",
               "status2_k28",
               "latency_ns",
               "clock_ppm",
               "broken_identity",
               "wrong_pattern",
               "identity_flip",
               "vertical_k28",
               "resource",
               "turn_bits",
               "access_level",
               "hardware_version",
               "short_latency_frames",
               "status_latency_frames",
               "long_latency_frames",
               "late_frames",
               "short_inside_long",
               "write_answer_data"});
}

void read_number(TomlReader& reader, const char* key, unsigned least, unsigned most,
                 unsigned& value) {
  if (const auto number = reader.integer(key, least, most)) value = static_cast<unsigned>(*number);
}

void read_byte(TomlReader& reader, const char* key, std::uint8_t& value) {
  if (const auto number = reader.integer(key, 0, 255)) value = static_cast<std::uint8_t>(*number);
}

// ---- Speed --------------------------------------------------------------------------------------
//
// A master finds its speed by two safe positions eight frames apart. It takes their difference for
// a signed number of the position's width, and keeps its speed in 24 bits. A higher speed would
// pass its check at the end of each eight frames and give wrong positions between them.

constexpr unsigned kApartBits = 3;  // eight frames
constexpr unsigned kSpeedBits = 24;
constexpr double kLongestFrameUs = 11.52 * 1.001;  // the slowest clock of a master

std::int64_t too_fast(unsigned position_bits) {
  return std::int64_t{1} << (std::min(position_bits - kApartBits, kSpeedBits) - 1);
}

// A step of the position: it wraps.
std::int64_t step_of(std::uint64_t difference, unsigned bits) {
  const unsigned above = 64 - bits;
  return static_cast<std::int64_t>(difference << above) >> above;
}

// The highest speed that words of a list hold. One that a step is too large to lead to is marked by
// the encoder, and none.
std::int64_t top_speed(const std::vector<std::uint64_t>& words, const DslSlaveConfig& config) {
  const std::int64_t most = std::int64_t{1} << (config.acceleration_bits - 1);
  const std::size_t count = words.size();
  if (count == 0) return 0;  // the file is missing, which has been said
  const auto speed_to = [&](std::size_t i) {
    if (i == 0 && !config.source.repeat) return std::int64_t{0};
    return step_of(words[i] - words[(i + count - 1) % count], config.data_bits);
  };
  std::int64_t top = 0;
  std::int64_t before = speed_to(config.source.repeat ? count - 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t speed = speed_to(i);
    if (speed - before >= -most && speed - before < most) top = std::max(top, std::abs(speed));
    before = speed;
  }
  return top;
}

void check_speed(TomlReader& reader, const DslSlaveConfig& config) {
  const DataSource& source = config.source;
  const char* key = "file";
  double speed = 0;
  switch (source.kind) {
    case DataSource::Kind::kConstant:
      return;
    case DataSource::Kind::kRamp:
      key = "step";
      speed = std::abs(
          static_cast<double>(step_of(static_cast<std::uint64_t>(source.step), config.data_bits)));
      break;
    case DataSource::Kind::kSine: {
      key = "amplitude";
      const double turns = kLongestFrameUs / to_us(source.period);
      speed = 2 * source.amplitude * (turns < 0.5 ? std::sin(std::numbers::pi * turns) : 1) + 1;
      break;
    }
    case DataSource::Kind::kList:
      speed = static_cast<double>(top_speed(source.words, config));
      break;
  }
  const std::int64_t limit = too_fast(config.data_bits);
  if (speed < static_cast<double>(limit)) return;
  reader.fail(key, "too fast for a position of " + std::to_string(config.data_bits) +
                       " bits: its speed must stay below " + std::to_string(limit) +
                       " steps a frame");
}

// ---- Messages -----------------------------------------------------------------------------------

constexpr unsigned kMaxFrames = 100'000;
constexpr std::size_t kMaxBytes = 0x7FFF;

using dsl::Resource;
using dsl::ResourceType;

constexpr std::string_view kTypeNames[] = {"node", "void",   "bit",      "u8",  "u16",
                                           "u32",  "u64",    "i8",       "i16", "i32",
                                           "i64",  "string", "structure"};

// The key `value`: a number, a text, or a list of bytes.
void read_value(TomlReader& reader, Resource& resource) {
  const unsigned bytes = dsl::bytes_of(resource.type);
  if (bytes != 0) {
    const TomlValue* value = reader.value("value", {"integer"});
    if (value != nullptr && !value->is(TomlValue::Kind::kInteger)) {
      reader.fail("value", "expected an integer");
    }
    const std::int64_t number = value == nullptr ? 0 : value->integer;
    const bool is_signed = resource.type >= ResourceType::kI8;
    const unsigned bits = resource.type == ResourceType::kBit ? 1 : 8 * bytes;
    const std::int64_t above = bits == 64 ? 0 : number >> (is_signed ? bits - 1 : bits);
    if (above != 0 && !(is_signed && above == -1)) {
      reader.fail("value", "does not fit into " + std::to_string(bits) + " bits");
    }
    for (unsigned i = bytes; i-- > 0;) {
      resource.value.push_back(
          static_cast<std::uint8_t>(static_cast<std::uint64_t>(number) >> 8U * i));
    }
    return;
  }
  if (resource.type != ResourceType::kString && resource.type != ResourceType::kStructure) return;
  const TomlValue* value = reader.value("value", {"string", "array"});
  if (value == nullptr) return reader.missing("value");
  if (value->is(TomlValue::Kind::kText)) {
    resource.value.assign(value->text.begin(), value->text.end());
  } else if (value->is(TomlValue::Kind::kArray)) {
    for (const TomlValue& item : value->items) {
      if (!item.within(0, 255)) reader.fail_at(item.where, "value", "expected bytes");
      resource.value.push_back(static_cast<std::uint8_t>(item.integer));
    }
  } else {
    reader.fail("value", "expected text or a list of bytes");
  }
  if (resource.value.empty() || resource.value.size() > kMaxBytes) {
    reader.fail("value", "expected 1 to " + std::to_string(kMaxBytes) + " bytes");
  }
}

Resource read_resource(const TomlValue& table, TomlFile& file) {
  constexpr ResourceType kTypes[] = {
      ResourceType::kNode,     ResourceType::kVoid, ResourceType::kBit, ResourceType::kU8,
      ResourceType::kU16,      ResourceType::kU32,  ResourceType::kU64, ResourceType::kI8,
      ResourceType::kI16,      ResourceType::kI32,  ResourceType::kI64, ResourceType::kString,
      ResourceType::kStructure};
  constexpr unsigned kMaxTimeout = 0xFFFF;
  TomlReader reader(table, file);
  Resource resource;
  if (!reader.has("id")) reader.missing("id");
  read_number(reader, "id", 1, Resource::kMaxId, resource.id);
  if (const auto name = reader.text("name")) {
    resource.name = *name;
    if (name->empty() || name->size() > Resource::kMaxName) {
      reader.fail("name", "expected 1 to " + std::to_string(Resource::kMaxName) + " characters");
    }
  } else {
    reader.missing("name");
  }
  const auto type = reader.choice("type", kTypeNames);
  if (!type) reader.missing("type");
  resource.type = kTypes[type.value_or(1)];
  read_value(reader, resource);
  read_number(reader, "parent", 0, Resource::kMaxId, resource.parent);
  read_number(reader, "read_level", 0, Resource::kNever, resource.read_level);
  read_number(reader, "write_level", 0, Resource::kNever, resource.write_level);
  read_number(reader, "timeout_ms", 0, kMaxTimeout, resource.timeout_ms);
  if (const auto frames = reader.integer("latency_frames", 0, kMaxFrames)) {
    resource.latency = static_cast<unsigned>(*frames);
  }
  reader.finish();
  return resource;
}

void read_messages(TomlReader& reader, const DslSlaveConfig& encoder, dsl::MessageConfig& config) {
  if (const auto* tables = reader.tables("resource")) {
    for (const TomlValue& table : *tables) {
      config.resources.push_back(read_resource(table, reader.file()));
      const auto same = [&](const Resource& each) {
        return &each != &config.resources.back() && each.id == config.resources.back().id;
      };
      if (std::any_of(config.resources.begin(), config.resources.end(), same)) {
        reader.fail_at(table.where, "resource",
                       "there are two with id = " + std::to_string(config.resources.back().id));
      }
    }
  }
  read_number(reader, "turn_bits", 1, std::min(encoder.data_bits, 31U), config.turn_bits);
  read_number(reader, "access_level", 0, Resource::kNever - 1, config.access_level);
  read_byte(reader, "hardware_version", config.hardware_version);
  read_number(reader, "short_latency_frames", 0, kMaxFrames, config.short_latency);
  read_number(reader, "status_latency_frames", 0, kMaxFrames, config.status_latency);
  read_number(reader, "long_latency_frames", 0, kMaxFrames, config.long_latency);
  read_number(reader, "late_frames", 1, kMaxFrames, config.late);
  config.short_inside_long = reader.boolean("short_inside_long").value_or(true);
  config.write_answer_data = reader.boolean("write_answer_data").value_or(true);
}

void read(TomlReader& reader, DeviceConfig& device, std::string& file) {
  auto& config = static_cast<DslSlaveConfig&>(device);
  config.data_bits = 32;
  config.flag_bits = 0;
  config.flags = 0;
  read_number(reader, "position_bits", kLeastPosition, kMostPosition, config.data_bits);
  read_source(reader, config, file, "position_bits");
  read_number(reader, "acceleration_bits", 8, 11, config.acceleration_bits);
  check_speed(reader, config);
  read_number(reader, "index", 0, 15, config.index);
  config.is_signed = reader.boolean("signed").value_or(false);
  read_byte(reader, "summary", config.summary);
  read_number(reader, "safe2_bits", 1, config.data_bits, config.safe2_bits);
  read_byte(reader, "pipeline", config.pipeline);
  read_number(reader, "s_par_bits", 0, 3, config.s_par_bits);
  read_number(reader, "sync_frames", 0, 100, config.sync_frames);
  read_number(reader, "vsync_after", 1, 1000, config.vsync_after);
  const auto follow = [&](const char* key) {
    return reader.choice(key, kFollows).value_or(0) == 1 ? DslFollow::kFollow : DslFollow::kIgnore;
  };
  config.msync = follow("msync");
  config.first = follow("first");
  if (reader.has("vsync_phase") && config.msync == DslFollow::kIgnore) {
    reader.fail("vsync_phase", "only together with msync = \"follow\"");
  }
  read_number(reader, "vsync_phase", 0, 7, config.vsync_phase);
  if (const auto disparity = reader.integer("start_disparity", -1, 1)) {
    if (*disparity == 0) reader.fail("start_disparity", "expected -1 or 1");
    config.positive = *disparity > 0;
  }
  if (const TomlValue* value = reader.value("direction_bit", {"\"opposite\"", "0", "1"})) {
    const bool text = value->is(TomlValue::Kind::kText);
    if (text ? value->text != "opposite" : !value->within(0, 1)) {
      reader.fail("direction_bit", "expected \"opposite\", 0 or 1");
    }
    if (!text) config.direction = value->integer == 1;
  }
  if (const auto ns = reader.number("lead_ns", 0, 1000)) config.lead = from_ns(*ns);
  config.lead_level = reader.integer("lead_level", 0, 1).value_or(1) == 1;
  config.status2_k28 = reader.boolean("status2_k28").value_or(true);
  if (const auto ns = reader.number("latency_ns", 0, kMaxLatencyNs)) config.latency = from_ns(*ns);
  config.clock_ppm = reader.number("clock_ppm", -kMaxPpm, kMaxPpm).value_or(0);
  config.broken_identity = reader.boolean("broken_identity").value_or(false);
  read_number(reader, "wrong_pattern", 0, 34, config.wrong_pattern);
  read_number(reader, "identity_flip", 0, 0xFFFFF, config.identity_flip);
  config.vertical_k28 = reader.boolean("vertical_k28").value_or(false);
  config.messages = {};
  read_messages(reader, config, config.messages);
}

}  // namespace

const Protocol kDslProtocol{
    .key = "dsl",
    .line = &kDuplexLines,
    .know_keys = know_keys,
    .blank = [] { return Device(DslSlaveConfig()); },
    .presets = nullptr,
    .read = read,
    .faults = slave_fault::kOfDsl,
    .sample =
        "[[channel.slave.resource]]\nid = 1\nname = \"A\"\ntype = \"u8\"\n"
        "[[channel.slave.resource]]\nid = 2\nname = \"B\"\ntype = \"string\"\n"
        "value = \"B\"\n"};

}  // namespace mb4::sim
