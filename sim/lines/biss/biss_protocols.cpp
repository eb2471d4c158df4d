// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/biss/biss_protocols.hpp"

#include "sim/lines/biss/biss_b_slave.hpp"
#include "sim/lines/biss/biss_c_faults.hpp"
#include "sim/lines/biss/biss_c_slave.hpp"
#include "sim/lines/biss/biss_presets.hpp"
#include "sim/lines/clocked/clocked_lines.hpp"
#include "sim/lines/registers/register_keys.hpp"
#include "sim/lines/sensor_keys.hpp"

namespace mb4::sim {
namespace {

constexpr std::int64_t kMaxBusy = 1'000'000;
constexpr unsigned kFlagsOfEncoders = 2;

// Reads the keys for acknowledge and processing time.
void read_request(TomlReader& reader, BissSlaveConfig& config) {
  config.passes_acknowledge =
      reader.choice("acknowledge", {"latched", "passed-on"}).value_or(0) == 1;
  if (const auto busy = reader.integer("busy_periods", 0, kMaxBusy)) {
    config.busy_periods = static_cast<unsigned>(*busy);
  }
}

void know_biss_keys(TomlReader& reader) {
  know_sensor_keys(reader);
  reader.know({"timeout", "t_sample_ns", "busy_periods", "acknowledge"});
}

void read_actuator(TomlReader& reader, BissCSlaveConfig& config) {
  config.actuator = reader.boolean("actuator").value_or(false);
  if (const auto stop_bit = reader.boolean("stop_bit")) {
    if (!config.actuator) reader.fail("stop_bit", "only an actuator has it");
    config.stop_bit = *stop_bit;
  }
  if (config.actuator && reader.has("source")) {
    reader.fail("source", "an actuator has none; data is the word that it holds at first");
  }
}

void read_life_counter(TomlReader& reader, LifeCounter& counter) {
  if (const auto bits = reader.integer("life_counter_bits", 0, LifeCounter::kMaxBits)) {
    counter.bits = static_cast<unsigned>(*bits);
  }
  if (const auto first = reader.integer("life_counter_first", 0, 1)) {
    if (counter.bits == 0) reader.fail("life_counter_first", "there is no life counter");
    counter.first = static_cast<unsigned>(*first);
  }
}

void read_biss_c(TomlReader& reader, DeviceConfig& device, std::string& file) {
  auto& config = static_cast<BissCSlaveConfig&>(device);
  read_actuator(reader, config);
  read_life_counter(reader, config.life_counter);
  if (config.actuator && config.life_counter.bits != 0) {
    reader.fail("life_counter_bits", "an actuator has none");
  }
  read_sensor(reader, config, config.actuator ? 0 : kFlagsOfEncoders + config.life_counter.bits,
              file);
  read_timeout(reader, config.timeout);
  read_request(reader, config);
  read_control(reader, config.control);
}

void know_biss_c_keys(TomlReader& reader) {
  know_biss_keys(reader);
  know_control_keys(reader);
  reader.know({"actuator", "stop_bit", "life_counter_bits", "life_counter_first"});
}

// Reads the keys of the register mode of BiSS B.
void read_access(TomlReader& reader, BissBRegisterConfig& access) {
  if (!read_present(reader, access.present,
                    {"ids", "banks", "missing", "write_protected", "read_busy_clocks",
                     "read_busy_us", "store_busy_us"})) {
    return;
  }
  read_ids(reader, access.ids);
  read_layout(reader, access);
  read_busy(reader, "read_busy_clocks", "read_busy_us", access.read_busy);
  read_busy_us(reader, "store_busy_us", access.store_busy);
}

void read_biss_b(TomlReader& reader, DeviceConfig& device, std::string& file) {
  auto& config = static_cast<BissBSlaveConfig&>(device);
  read_sensor(reader, config, kFlagsOfEncoders, file);
  read_timeout(reader, config.timeout);
  const TomlValue* value = reader.value("register_timeout", {"\"adaptive\""});
  if (value != nullptr && value->is(TomlValue::Kind::kText)) {
    if (value->text != "adaptive") {
      reader.fail("register_timeout", "expected \"adaptive\" or a number of microseconds");
    }
    config.register_timeout = 0;
  } else {
    read_timeout_us(reader, "register_timeout", config.register_timeout);
  }
  read_request(reader, config);
  read_access(reader, config.access);
}

void know_biss_b_keys(TomlReader& reader) {
  know_biss_keys(reader);
  reader.know({"register_timeout", "control", "ids", "banks", "missing", "write_protected",
               "read_busy_clocks", "read_busy_us", "store_busy_us"});
}

}  // namespace

const Protocol kBissCProtocol{
    "biss-c",       &kClockedLines, know_biss_c_keys,     [] { return Device(BissCSlaveConfig()); },
    biss_c_presets, read_biss_c,    slave_fault::kOfBissC};
const Protocol kBissBProtocol{"biss-b",         &kClockedLines,
                              know_biss_b_keys, [] { return Device(BissBSlaveConfig()); },
                              biss_b_presets,   read_biss_b};

}  // namespace mb4::sim
