// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/faults/fault_types.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

#include "sim/core/number_text.hpp"
#include "sim/lines/line.hpp"
#include "sim/lines/protocols.hpp"
#include "sim/lines/slave.hpp"

namespace mb4::sim {
namespace {

constexpr double kMaxWidthNs = 1e5;
constexpr double kMinWidthNs = 0.001;
constexpr std::int64_t kMaxBit = 4095;
constexpr std::uint64_t kMaxAbortBits = 80;  // of a random abort: the driver's frames are short

using Scene = const FaultScene&;
using What = LineAction::What;

Line& line_of(Scene scene) { return scene.target.line(scene.config.channel); }

std::string on_wire(const FaultConfig& fault) {
  return std::string(fault.wire_title) + " of channel " + std::to_string(fault.channel);
}

std::string who(const FaultConfig& fault) { return "slave " + std::to_string(fault.slave); }

void read_nothing(TomlReader& /*reader*/, const FaultLimits& /*limits*/, FaultConfig& /*fault*/) {}

void read_wire(TomlReader& reader, const FaultLimits& limits, FaultConfig& fault) {
  std::vector<std::string_view> keys;
  for (const WireName& wire : limits.wires) keys.push_back(wire.key);
  fault.wire = static_cast<unsigned>(reader.choice("on", keys).value_or(0));
  fault.wire_title = limits.wires[fault.wire].title;
}

void read_width(TomlReader& reader, const char* key, FaultConfig& fault) {
  const auto width = reader.number(key, kMinWidthNs, kMaxWidthNs);
  if (!width) reader.missing(key);
  fault.width = from_ns(width.value_or(1));
}

// --- line ----------------------------------------------------------------------------------

void read_bit_flip(TomlReader& reader, const FaultLimits& /*limits*/, FaultConfig& fault) {
  if (const auto frame = reader.integer("frame", 1, std::numeric_limits<std::int64_t>::max())) {
    fault.frame = static_cast<std::uint64_t>(*frame);
  }
  const std::int64_t most = fault.answer_bits != 0 ? fault.answer_bits - 1 : kMaxBit;
  if (const auto bit = reader.integer("answer_bit", 0, most)) {
    if (reader.has("bits")) reader.fail("answer_bit", "cannot be given together with bits");
    fault.bits.push_back(static_cast<unsigned>(*bit));
  }
  const TomlValue* list = reader.value("bits", {"array"});
  if (list == nullptr) return;
  const std::string wanted = "expected a list of 0 to " + std::to_string(most);
  if (list->items.empty()) reader.fail("bits", wanted);
  for (const TomlValue& item : list->items) {
    if (!item.within(0, most)) reader.fail_at(item.where, "bits", wanted);
    fault.bits.push_back(static_cast<unsigned>(item.integer));
  }
}

std::string begin_bit_flip(Scene scene) {
  Line& line = line_of(scene);
  std::vector<unsigned> bits = scene.config.bits;
  if (bits.empty()) {
    bits.push_back(static_cast<unsigned>(scene.random.up_to(scene.config.frame_bits - 1)));
  }
  std::string list;
  for (const unsigned bit : bits) list += (list.empty() ? "" : ", ") + std::to_string(bit);
  // The running frame may be past these bits, so they are inverted in the next one.
  const std::uint64_t frame = scene.config.frame != 0 ? scene.config.frame : line.flip_frames() + 1;
  line.flip(frame, bits, scene.config.frame != 0 ? scene.hit : FlipWatch{});
  scene.record.frame = frame;
  return "bit " + list + " of frame " + std::to_string(frame) + " inverted, channel " +
         std::to_string(scene.config.channel);
}

void read_glitch(TomlReader& reader, const FaultLimits& limits, FaultConfig& fault) {
  read_wire(reader, limits, fault);
  read_width(reader, "width_ns", fault);
}

std::string begin_glitch(Scene scene) {
  const FaultConfig& fault = scene.config;
  line_of(scene).glitch(scene.now, fault.wire, fault.width);
  return "glitch of " + plain(to_ns(fault.width)) + " ns on " + on_wire(fault);
}

void read_stuck(TomlReader& reader, const FaultLimits& limits, FaultConfig& fault) {
  read_wire(reader, limits, fault);
  const auto level = reader.integer("level", 0, 1);
  if (!level) reader.missing("level");
  fault.level = level == 1;
}

std::string begin_stuck(Scene scene) {
  const FaultConfig& fault = scene.config;
  line_of(scene).act(scene.now, {fault.level ? What::kHigh : What::kLow, fault.wire});
  return on_wire(fault) + " stuck at " + (fault.level ? "1" : "0");
}

void end_stuck(Scene scene) { line_of(scene).act(scene.now, {What::kFree, scene.config.wire}); }

void read_jitter(TomlReader& reader, const FaultLimits& limits, FaultConfig& fault) {
  read_wire(reader, limits, fault);
  read_width(reader, "jitter_ns", fault);
}

void set_jitter(Scene scene, Time jitter) {
  Line& line = line_of(scene);
  WireFaults faults = line.wire_faults(scene.config.wire);
  faults.jitter = jitter;
  line.set_wire_faults(scene.config.wire, faults);
}

std::string begin_jitter(Scene scene) {
  const Time width = scene.config.width;
  set_jitter(scene, width);
  return "jitter of " + plain(to_ns(width)) + " ns on " + on_wire(scene.config);
}

void end_jitter(Scene scene) { set_jitter(scene, scene.was[scene.config.wire].jitter); }

// --- slave ---------------------------------------------------------------------------------

void set_slave(Scene scene, bool on) {
  const SlaveFault& fault = *scene.config.kind->of_slave;
  scene.target.slave(scene.config.slave).set_fault(fault, on);
  if (fault == slave_fault::kSilent) line_of(scene).slave_changed(scene.now);
}

std::string begin_slave(Scene scene) {
  set_slave(scene, true);
  std::string sentence(scene.config.kind->of_slave->happens);
  return sentence.replace(sentence.find('%'), 1, who(scene.config));
}

void end_slave(Scene scene) { set_slave(scene, false); }

// Unplugs the slave and those behind it, or plugs all of them in.
void plug(Scene scene, bool in) {
  Line& line = line_of(scene);
  const Slave& slave = scene.target.slave(scene.config.slave);
  std::size_t index = 0;
  while (&line.slave(index) != &slave) ++index;
  if (index == 0) {
    line.act(scene.now, {in ? What::kPlug : What::kUnplug, 0});
  } else {
    line.detach(scene.now, in ? line.size() : std::min(index, line.attached()));
  }
}

std::string begin_unplug(Scene scene) {
  plug(scene, false);
  return who(scene.config) + " and those behind it unplugged";
}

void end_unplug(Scene scene) { plug(scene, true); }

// --- host and clock ------------------------------------------------------------------------

void read_abort(TomlReader& reader, const FaultLimits& /*limits*/, FaultConfig& fault) {
  if (const auto bits = reader.integer("after_clocks", 1, kMaxBit)) {
    fault.bits.push_back(static_cast<unsigned>(*bits));
  }
}

std::string begin_abort(Scene scene) {
  const std::uint64_t bits = scene.config.bits.empty() ? 1 + scene.random.up_to(kMaxAbortBits - 1)
                                                       : scene.config.bits.front();
  scene.target.abort_transfer(bits);
  return "next SPI frame ends behind " + std::to_string(bits) + " clocks or before its last";
}

void read_clock_frequency(TomlReader& reader, const FaultLimits& limits, FaultConfig& fault) {
  const auto hz = reader.integer("hz", limits.min_clk_hz, limits.max_clk_hz);
  if (!hz) reader.missing("hz");
  fault.hz = static_cast<std::uint64_t>(hz.value_or(limits.min_clk_hz));
}

std::string begin_clock_frequency(Scene scene) {
  scene.target.set_clock(scene.now, scene.config.hz);
  return "CLK at " + std::to_string(scene.config.hz) + " Hz";
}

std::string begin_clock_stop(Scene scene) {
  scene.target.set_clock(scene.now, 0);
  return "CLK stopped";
}

void end_clock(Scene scene) { scene.target.set_clock(scene.now, std::nullopt); }

constexpr FaultType kOfLine[] = {
    {"bit-flip", FaultPlace::kLine, true, nullptr, read_bit_flip, begin_bit_flip, nullptr, true},
    {"glitch", FaultPlace::kLine, true, nullptr, read_glitch, begin_glitch, nullptr},
    {"stuck", FaultPlace::kLine, false, nullptr, read_stuck, begin_stuck, end_stuck},
    {"jitter", FaultPlace::kLine, false, nullptr, read_jitter, begin_jitter, end_jitter},
};

constexpr FaultType of_slave(const SlaveFault& fault) {
  return {fault.name, FaultPlace::kSlave, false, &fault, read_nothing, begin_slave, end_slave};
}

constexpr FaultType kOthers[] = {
    {"unplug", FaultPlace::kSlave, false, nullptr, read_nothing, begin_unplug, end_unplug},
    {"abort", FaultPlace::kHost, true, nullptr, read_abort, begin_abort, nullptr},
    {"clock-frequency", FaultPlace::kClock, false, nullptr, read_clock_frequency,
     begin_clock_frequency, end_clock},
    {"clock-stop", FaultPlace::kClock, false, nullptr, read_nothing, begin_clock_stop, end_clock},
};

}  // namespace

std::span<const FaultType> fault_types() {
  static const std::vector<FaultType> list = [] {
    std::vector<FaultType> all(std::begin(kOfLine), std::end(kOfLine));
    for (const SlaveFault* fault : slave_fault::kShared) all.push_back(of_slave(*fault));
    for (const Protocol* protocol : protocols()) {
      for (const SlaveFault* fault : protocol->faults) all.push_back(of_slave(*fault));
    }
    all.insert(all.end(), std::begin(kOthers), std::end(kOthers));
    return all;
  }();
  return list;
}

}  // namespace mb4::sim
