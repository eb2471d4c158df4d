// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/ssi/ssi_protocol.hpp"

#include "sim/lines/clocked/clocked_lines.hpp"
#include "sim/lines/registers/register_keys.hpp"
#include "sim/lines/sensor_keys.hpp"
#include "sim/lines/ssi/ssi_slave.hpp"

namespace mb4::sim {
namespace {

constexpr double kMaxResponseNs = 1e5;

void read_ssi(TomlReader& reader, DeviceConfig& device, std::string& file) {
  auto& config = static_cast<SsiSlaveConfig&>(device);
  read_sensor(reader, config, 0, file);
  read_timeout_us(reader, "timeout", config.monoflop);
  config.gray = reader.boolean("gray").value_or(config.gray);
  config.ring = reader.boolean("ring").value_or(config.ring);
  if (const auto ns = reader.number("response_ns", 0, kMaxResponseNs)) {
    config.response = from_ns(*ns);
  }
  read_control(reader, config.control);
}

void know_ssi_keys(TomlReader& reader) {
  know_sensor_keys(reader);
  know_control_keys(reader);
  reader.know({"timeout", "gray", "ring", "response_ns"});
}

std::vector<Preset> ssi_presets() {
  // Posital, SSI page: 25 bits, multiple transmission with 26 clocks for each word.
  SsiSlaveConfig posital;
  posital.name = "posital-ssi-25";
  posital.data_bits = 25;
  posital.ring = true;
  // TR-Electronic: below 20 us the old word comes again, above 30 us a new one.
  SsiSlaveConfig tr;
  tr.name = "tr-ce-65";
  tr.data_bits = 0;
  tr.monoflop = from_us(25);
  return {{"posital-ssi-25", "Posital, SSI, 25 bits, multiple transmission", posital, {}},
          {"tr-ce-65", "TR-Electronic CE-65, SSI, give data_bits", tr, {}}};
}

}  // namespace

const Protocol kSsiProtocol{"ssi",         &kClockedLines,
                            know_ssi_keys, [] { return Device(SsiSlaveConfig()); },
                            ssi_presets,   read_ssi};

}  // namespace mb4::sim
