// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/duplex/duplex_lines.hpp"

#include <string>
#include <utility>

#include "sim/lines/duplex/duplex_line.hpp"
#include "sim/lines/line_keys.hpp"

namespace mb4::sim {
namespace {

// In the order of the places in DuplexLine.
constexpr WireName kWires[] = {
    {"line", "the line"}, {"in", "the way to the master"}, {"out", "the way to the device"}};

// Of usual transceivers.
constexpr Time kEnable = 30 * kPsPerNs;
constexpr Time kDisable = 40 * kPsPerNs;
constexpr double kMaxErrors = 0.1;

Copied<LineConfig> read(TomlReader& reader) {
  DuplexConfig config;
  config.delay = read_delay(reader);
  config.in = read_wire_faults(reader, "");
  config.out = read_wire_faults(reader, "out_");
  read_glitch_width(reader, config.in, config.out, "out_");
  config.enable = read_delay(reader, "enable_ns").value_or(kEnable);
  config.disable = read_delay(reader, "disable_ns").value_or(kDisable);
  config.answer_errors = reader.number("answer_errors", 0, kMaxErrors).value_or(0);
  config.master_errors = reader.number("master_errors", 0, kMaxErrors).value_or(0);
  config.events = read_events(reader, kWires);
  config.flips = read_flips(reader);
  return config;
}

std::unique_ptr<Line> make(const LineSetup& setup) { return std::make_unique<DuplexLine>(setup); }

void add(Line& line, std::unique_ptr<Slave> slave) {
  static_cast<DuplexLine&>(line).add(
      std::unique_ptr<DuplexSlave>(static_cast<DuplexSlave*>(slave.release())));
}

// A channel that the scenario does not have: nothing, and the master sees 1.
class DuplexOpenEnd final : public LineEnd {
 public:
  void drive(Time /*now*/, unsigned /*levels*/) override {}
};

std::unique_ptr<LineEnd> make_open(LineMaster& /*master*/, unsigned /*index*/) {
  return std::make_unique<DuplexOpenEnd>();
}

}  // namespace

const LineKind kDuplexLines{"duplex", kOutPin, kWires, read, nullptr, make, add, make_open};

}  // namespace mb4::sim
