// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/faults/fault_types.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

#include "sim/core/number_text.hpp"
#include "sim/lines/line.hpp"

namespace mb4::sim {
namespace {

constexpr double kMaxWidthNs = 1e5;
constexpr double kMinWidthNs = 0.001;
constexpr std::int64_t kMaxBit = 4095;
constexpr std::uint64_t kMaxAbortBits = 80;  // of a random abort: the driver's frames are short

using Scene = const FaultScene&;
using Action = CableEvent::Action;

Line& line_of(Scene scene) { return scene.target.line(scene.config.channel); }

std::string on_wire(const FaultConfig& fault) {
  return std::string(fault.on_ma ? "MA" : "SL") + " of channel " + std::to_string(fault.channel);
}

std::string who(const FaultConfig& fault) { return "slave " + std::to_string(fault.slave); }

void read_nothing(TomlReader& /*reader*/, const FaultLimits& /*limits*/, FaultConfig& /*fault*/) {}

void read_wire(TomlReader& reader, FaultConfig& fault) {
  fault.on_ma = reader.choice("on", {"sl", "ma"}).value_or(0) == 1;
}

void read_width(TomlReader& reader, const char* key, FaultConfig& fault) {
  const auto width = reader.number(key, kMinWidthNs, kMaxWidthNs);
  if (!width) reader.missing(key);
  fault.width = from_ns(width.value_or(1));
}

// --- line ----------------------------------------------------------------------------------

void read_bit_flip(TomlReader& reader, const FaultLimits& /*limits*/, FaultConfig& fault) {
  const toml::node* node = reader.node("bits");
  if (node == nullptr) return;
  const std::string wanted = "expected a list of 0 to 4095";
  const toml::array* list = node->as_array();
  if (list == nullptr || list->empty()) reader.fail("bits", wanted);
  for (const toml::node& item : *list) {
    const auto* number = item.as_integer();
    if (number == nullptr || number->get() < 0 || number->get() > kMaxBit) {
      reader.fail_at(item.source(), "bits", wanted);
    }
    fault.bits.push_back(static_cast<unsigned>(number->get()));
  }
}

std::string begin_bit_flip(Scene scene) {
  SlFaults& line = line_of(scene).faults();
  std::vector<unsigned> bits = scene.config.bits;
  if (bits.empty()) {
    bits.push_back(static_cast<unsigned>(scene.random.up_to(scene.config.frame_bits - 1)));
  }
  std::string list;
  for (const unsigned bit : bits) list += (list.empty() ? "" : ", ") + std::to_string(bit);
  // The running frame may be past these bits, so they are inverted in the next one.
  const std::uint64_t frame = line.frames() + 1;
  line.flip_frame(frame, bits);
  scene.record.frame = frame;
  return "bit " + list + " of frame " + std::to_string(frame) + " inverted, channel " +
         std::to_string(scene.config.channel);
}

void read_glitch(TomlReader& reader, const FaultLimits& /*limits*/, FaultConfig& fault) {
  read_wire(reader, fault);
  read_width(reader, "width_ns", fault);
}

std::string begin_glitch(Scene scene) {
  const FaultConfig& fault = scene.config;
  if (fault.on_ma) {
    line_of(scene).glitch_ma(scene.now, fault.width);
  } else {
    line_of(scene).glitch_sl(scene.now, fault.width);
  }
  return "glitch of " + plain(to_ns(fault.width)) + " ns on " + on_wire(fault);
}

void read_stuck(TomlReader& reader, const FaultLimits& /*limits*/, FaultConfig& fault) {
  read_wire(reader, fault);
  const auto level = reader.integer("level", 0, 1);
  if (!level) reader.missing("level");
  fault.level = level == 1;
}

std::string begin_stuck(Scene scene) {
  const FaultConfig& fault = scene.config;
  line_of(scene).act(scene.now, fault.on_ma ? (fault.level ? Action::kMaHigh : Action::kMaLow)
                                            : (fault.level ? Action::kSlHigh : Action::kSlLow));
  return on_wire(fault) + " stuck at " + (fault.level ? "1" : "0");
}

void end_stuck(Scene scene) {
  line_of(scene).act(scene.now, scene.config.on_ma ? Action::kMaFree : Action::kSlFree);
}

void read_jitter(TomlReader& reader, const FaultLimits& /*limits*/, FaultConfig& fault) {
  read_wire(reader, fault);
  read_width(reader, "jitter_ns", fault);
}

void set_jitter(Scene scene, Time ma_jitter, Time sl_jitter) {
  Line& line = line_of(scene);
  WireFaults ma = line.ma_faults();
  WireFaults sl = line.sl_faults();
  (scene.config.on_ma ? ma : sl).jitter = scene.config.on_ma ? ma_jitter : sl_jitter;
  line.set_faults(ma, sl);
}

std::string begin_jitter(Scene scene) {
  const Time width = scene.config.width;
  set_jitter(scene, width, width);
  return "jitter of " + plain(to_ns(width)) + " ns on " + on_wire(scene.config);
}

void end_jitter(Scene scene) { set_jitter(scene, scene.ma_was.jitter, scene.sl_was.jitter); }

// --- slave ---------------------------------------------------------------------------------

template <SlaveFault kFault>
void set_slave(Scene scene, bool on) {
  scene.target.slave(scene.config.slave).set_fault(kFault, on);
  if (kFault == SlaveFault::kSilent) line_of(scene).chain().refresh(scene.now);
}

template <SlaveFault kFault>
std::string begin_slave(Scene scene) {
  set_slave<kFault>(scene, true);
  switch (kFault) {
    case SlaveFault::kSilent:
      return who(scene.config) + " silent";
    case SlaveFault::kBusy:
      return who(scene.config) + " busy for ever";
    case SlaveFault::kWrongCrc:
      return "wrong CRC from " + who(scene.config);
    case SlaveFault::kWrongId:
      return who(scene.config) + " answers to a wrong ID";
    case SlaveFault::kStuckWord:
      return who(scene.config) + " sends its last word again";
    case SlaveFault::kStuckCounter:
      return "life counter of " + who(scene.config) + " stands still";
    case SlaveFault::kSkippedWord:
      return "life counter of " + who(scene.config) + " goes two steps at once";
    case SlaveFault::kSwappedWords:
      break;
  }
  return "words of " + who(scene.config) + " and of the one behind it swapped";
}

template <SlaveFault kFault>
void end_slave(Scene scene) {
  set_slave<kFault>(scene, false);
}

// Unplugs the slave and those behind it, or plugs all of them in.
void plug(Scene scene, bool in) {
  Line& line = line_of(scene);
  const Slave& slave = scene.target.slave(scene.config.slave);
  std::size_t index = 0;
  while (&line.chain().slave(index) != &slave) ++index;
  if (index == 0) {
    line.act(scene.now, in ? Action::kPlug : Action::kUnplug);
  } else {
    line.chain().detach(scene.now,
                        in ? line.chain().size() : std::min(index, line.chain().attached()));
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

template <SlaveFault kFault>
constexpr FaultType slave_type(FaultKind kind, std::string_view name) {
  return {kind,   name,         FaultPlace::kSlave,  false,
          kFault, read_nothing, begin_slave<kFault>, end_slave<kFault>};
}

constexpr FaultType kTypes[] = {
    {FaultKind::kBitFlip,
     "bit-flip",
     FaultPlace::kLine,
     true,
     {},
     read_bit_flip,
     begin_bit_flip,
     nullptr},
    {FaultKind::kGlitch, "glitch", FaultPlace::kLine, true, {}, read_glitch, begin_glitch, nullptr},
    {FaultKind::kStuck, "stuck", FaultPlace::kLine, false, {}, read_stuck, begin_stuck, end_stuck},
    {FaultKind::kJitter,
     "jitter",
     FaultPlace::kLine,
     false,
     {},
     read_jitter,
     begin_jitter,
     end_jitter},
    slave_type<SlaveFault::kSilent>(FaultKind::kSilent, "silent"),
    slave_type<SlaveFault::kBusy>(FaultKind::kBusy, "busy"),
    slave_type<SlaveFault::kWrongCrc>(FaultKind::kWrongCrc, "wrong-crc"),
    slave_type<SlaveFault::kWrongId>(FaultKind::kWrongId, "wrong-id"),
    slave_type<SlaveFault::kStuckWord>(FaultKind::kStuckWord, "stuck-word"),
    slave_type<SlaveFault::kStuckCounter>(FaultKind::kStuckCounter, "stuck-counter"),
    slave_type<SlaveFault::kSkippedWord>(FaultKind::kSkippedWord, "skipped-word"),
    slave_type<SlaveFault::kSwappedWords>(FaultKind::kSwappedWords, "swapped-words"),
    {FaultKind::kUnplug,
     "unplug",
     FaultPlace::kSlave,
     false,
     {},
     read_nothing,
     begin_unplug,
     end_unplug},
    {FaultKind::kAbort, "abort", FaultPlace::kHost, true, {}, read_abort, begin_abort, nullptr},
    {FaultKind::kClockFrequency,
     "clock-frequency",
     FaultPlace::kClock,
     false,
     {},
     read_clock_frequency,
     begin_clock_frequency,
     end_clock},
    {FaultKind::kClockStop,
     "clock-stop",
     FaultPlace::kClock,
     false,
     {},
     read_nothing,
     begin_clock_stop,
     end_clock},
};

// The rows hold the kinds 0, 1, 2 ... without a gap, in any order.
constexpr bool every_kind_once() {
  for (std::size_t kind = 0; kind < std::size(kTypes); ++kind) {
    const auto is_kind = [&](const FaultType& type) {
      return static_cast<std::size_t>(type.kind) == kind;
    };
    if (std::count_if(std::begin(kTypes), std::end(kTypes), is_kind) != 1) return false;
  }
  return true;
}
static_assert(every_kind_once());

}  // namespace

std::span<const FaultType> fault_types() { return kTypes; }

const FaultType& fault_type(FaultKind kind) {
  return *std::find_if(std::begin(kTypes), std::end(kTypes),
                       [&](const FaultType& type) { return type.kind == kind; });
}

std::string_view to_string(FaultKind kind) { return fault_type(kind).name; }

bool is_momentary(FaultKind kind) { return fault_type(kind).momentary; }
bool is_of_clock(FaultKind kind) { return fault_type(kind).place == FaultPlace::kClock; }

}  // namespace mb4::sim
