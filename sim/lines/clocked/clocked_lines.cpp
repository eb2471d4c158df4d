// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/clocked/clocked_lines.hpp"

#include <utility>

#include "sim/core/number_text.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/line_keys.hpp"

namespace mb4::sim {
namespace {

// In the order of the places in ClockedLine.
constexpr WireName kWires[] = {{"sl", "SL"}, {"ma", "MA"}};

// The key states the delay of one way. The simulator needs how much later MO is than MA.
void read_mo_delay(TomlReader& reader, ClockedConfig& config) {
  const auto delay = read_delay(reader, "mo_delay_ns");
  if (!delay) return;
  if (!config.mo) reader.fail("mo_delay_ns", "only together with mo = true");
  const Time ma = config.delay / 2;
  if (*delay < ma) {
    reader.fail("mo_delay_ns",
                "MO must not overtake MA, which takes " + plain(to_ns(ma)) + " ns one way");
  }
  config.mo_late = *delay - ma;
}

Copied<LineConfig> read(TomlReader& reader) {
  ClockedConfig config;
  config.delay = read_delay(reader);
  config.sl = read_wire_faults(reader, "");
  config.ma = read_wire_faults(reader, "ma_");
  read_glitch_width(reader, config.sl, config.ma, "ma_");
  config.open_level = reader.integer("open_level", 0, 1).value_or(1) != 0;
  config.mo = reader.boolean("mo").value_or(false);
  config.events = read_events(reader, kWires);
  config.flips = read_flips(reader);
  read_mo_delay(reader, config);
  return config;
}

void check(const TomlReader& reader, const LineConfig& config, const DeviceTraits& device,
           const SourcePos& where) {
  if (device.actuator && !clocked(config).mo) {
    reader.fail_at(where, "actuator", "an actuator needs mo = true on its channel");
  }
}

std::unique_ptr<Line> make(const LineSetup& setup) { return std::make_unique<ClockedLine>(setup); }

void add(Line& line, std::unique_ptr<Slave> slave) {
  static_cast<ClockedLine&>(line).add(
      std::unique_ptr<ClockedSlave>(static_cast<ClockedSlave*>(slave.release())));
}

std::unique_ptr<LineEnd> make_open(LineMaster& master, unsigned index) {
  return std::make_unique<ClockedOpenEnd>(master, index);
}

}  // namespace

const LineKind kClockedLines{"clocked", kMaPin, kWires, read, check, make, add, make_open};

}  // namespace mb4::sim
