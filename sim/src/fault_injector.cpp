// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "mb4sim/fault_injector.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "chip_model.hpp"
#include "mb4sim/control_slave.hpp"
#include "mb4sim/simulator.hpp"
#include "number_text.hpp"

namespace mb4::sim {
namespace {

constexpr std::uint64_t kMaxAbortBits = 80;  // of a random abort: the driver's frames are short

std::string on_wire(const FaultConfig& fault) {
  return std::string(fault.on_ma ? "MA" : "SL") + " of channel " + std::to_string(fault.channel);
}

std::string describe(const FaultConfig& fault) {
  switch (fault.kind) {
    case FaultKind::kGlitch:
      return "glitch of " + plain(to_ns(fault.width)) + " ns on " + on_wire(fault);
    case FaultKind::kStuck:
      return on_wire(fault) + " stuck at " + (fault.level ? "1" : "0");
    case FaultKind::kJitter:
      return "jitter of " + plain(to_ns(fault.width)) + " ns on " + on_wire(fault);
    case FaultKind::kClockFrequency:
      return "CLK at " + std::to_string(fault.hz) + " Hz";
    case FaultKind::kClockStop:
      return "CLK stopped";
    case FaultKind::kWrongCrc:
      return "wrong CRC from slave " + std::to_string(fault.slave);
    case FaultKind::kWrongId:
      return "slave " + std::to_string(fault.slave) + " answers to a wrong ID";
    case FaultKind::kSilent:
      return "slave " + std::to_string(fault.slave) + " silent";
    case FaultKind::kBusy:
      return "slave " + std::to_string(fault.slave) + " busy for ever";
    case FaultKind::kUnplug:
      return "slave " + std::to_string(fault.slave) + " and those behind it unplugged";
    default:
      return std::string(to_string(fault.kind));
  }
}

}  // namespace

std::string_view to_string(FaultKind kind) {
  static constexpr std::string_view kNames[] = {
      "bit-flip",  "glitch",   "stuck",  "jitter", "silent",          "busy",
      "wrong-crc", "wrong-id", "unplug", "abort",  "clock-frequency", "clock-stop"};
  return kNames[static_cast<std::size_t>(kind)];
}

bool is_momentary(FaultKind kind) {
  return kind == FaultKind::kBitFlip || kind == FaultKind::kGlitch || kind == FaultKind::kAbort;
}

FaultInjector::FaultInjector(Simulator& simulator, EventQueue& queue, ChipModel& chip,
                             const std::vector<FaultConfig>& faults, std::uint64_t seed)
    : simulator_(simulator), queue_(queue), chip_(chip), faults_(faults) {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const FaultConfig& fault = faults_[i];
    sources_.push_back(
        std::make_unique<Source>(Source{this, i, Random(derive_seed(seed, i)), {}, {}, {}}));
    Source& source = *sources_.back();
    if (const Line* line = simulator_.line(fault.channel)) {
      source.ma_before = line->ma_faults();
      source.sl_before = line->sl_faults();
    }
    for (const Time at : fault.at) queue_.post(at, &FaultInjector::begin, &source);
    if (fault.at.empty()) post_random(source, fault.from);
  }
}

// The distance between two faults is spread evenly over 0 to twice the mean, as with glitches.
void FaultInjector::post_random(Source& source, Time after) {
  const FaultConfig& fault = faults_[source.config];
  const auto mean = static_cast<Time>(static_cast<double>(kPsPerSecond) / fault.per_s);
  const Time at = after + 1 + source.random.up_to(2 * mean);
  if (at <= fault.to && at < kEndOfTime) queue_.post(at, &FaultInjector::begin, &source);
}

void FaultInjector::begin(Time now, void* receiver, std::uint64_t /*word*/) {
  auto& source = *static_cast<Source*>(receiver);
  FaultInjector& self = *source.injector;
  const FaultConfig& fault = self.faults_[source.config];
  FaultRecord record;
  record.config = source.config;
  record.begin = now;
  record.end = is_momentary(fault.kind) ? now : kNever;
  if (fault.kind == FaultKind::kGlitch) record.end = now + fault.width;
  record.what = self.inject(now, source);
  self.records_.push_back(std::move(record));
  if (!is_momentary(fault.kind)) {
    source.lasting.push_back(self.records_.size() - 1);
    if (fault.duration != kNever) {
      self.queue_.post(now + fault.duration, &FaultInjector::end, &source,
                       self.records_.size() - 1);
    }
  }
  if (fault.at.empty()) self.post_random(source, now);
}

// If several faults of one table overlap, the effect continues until the last of them is over.
void FaultInjector::end(Time now, void* receiver, std::uint64_t record) {
  auto& source = *static_cast<Source*>(receiver);
  source.injector->records_[record].end = now;
  std::erase(source.lasting, record);
  if (source.lasting.empty()) source.injector->set(now, source, false);
}

std::string FaultInjector::inject(Time now, Source& source) {
  const FaultConfig& fault = faults_[source.config];
  switch (fault.kind) {
    case FaultKind::kBitFlip:
      return flip_bits(source);
    case FaultKind::kAbort:
      return abort_frame(source);
    case FaultKind::kGlitch:
      if (fault.on_ma) {
        simulator_.line(fault.channel)->glitch_ma(now, fault.width);
      } else {
        simulator_.line(fault.channel)->glitch_sl(now, fault.width);
      }
      break;
    default:
      set(now, source, true);
      break;
  }
  return describe(fault);
}

std::string FaultInjector::flip_bits(Source& source) {
  const FaultConfig& fault = faults_[source.config];
  SlFaults& line = simulator_.line(fault.channel)->faults();
  std::vector<unsigned> bits = fault.bits;
  if (bits.empty()) {
    bits.push_back(static_cast<unsigned>(source.random.up_to(fault.frame_bits - 1)));
  }
  std::string list;
  for (const unsigned bit : bits) list += (list.empty() ? "" : ", ") + std::to_string(bit);
  // The running frame may be past these bits, so they are inverted in the next one.
  line.flip_frame(line.frames() + 1, bits);
  return "bit " + list + " of frame " + std::to_string(line.frames() + 1) + " inverted, channel " +
         std::to_string(fault.channel);
}

std::string FaultInjector::abort_frame(Source& source) {
  const FaultConfig& fault = faults_[source.config];
  const std::uint64_t bits =
      fault.bits.empty() ? 1 + source.random.up_to(kMaxAbortBits - 1) : fault.bits.front();
  simulator_.spi().abort_next(bits);
  return "next SPI frame ends behind " + std::to_string(bits) + " clocks or before its last";
}

void FaultInjector::set(Time now, Source& source, bool on) {
  using Action = CableEvent::Action;
  const FaultConfig& fault = faults_[source.config];
  switch (fault.kind) {
    case FaultKind::kStuck: {
      const Action stick = fault.on_ma ? (fault.level ? Action::kMaHigh : Action::kMaLow)
                                       : (fault.level ? Action::kSlHigh : Action::kSlLow);
      const Action free = fault.on_ma ? Action::kMaFree : Action::kSlFree;
      simulator_.line(fault.channel)->act(now, on ? stick : free);
      break;
    }
    case FaultKind::kJitter:
      set_jitter(source, on);
      break;
    case FaultKind::kClockFrequency:
    case FaultKind::kClockStop:
      chip_.set_clock(now, on ? fault.hz : simulator_.scenario().chip.f_clk_hz);
      break;
    default:
      set_slave(now, fault, on);
      break;
  }
}

void FaultInjector::set_slave(Time now, const FaultConfig& fault, bool on) {
  Slave& slave = *simulator_.slave(fault.slave);
  Line& line = *simulator_.line(fault.channel);
  switch (fault.kind) {
    case FaultKind::kSilent:
      slave.faults().silent = on;
      line.chain().refresh(now);
      break;
    case FaultKind::kBusy:
      slave.faults().busy = on;
      break;
    case FaultKind::kWrongCrc:
      slave.faults().wrong_crc = on;
      break;
    case FaultKind::kWrongId:
      slave.control()->faults().set_wrong_id(on);
      break;
    case FaultKind::kUnplug: {
      std::size_t index = 0;
      while (&line.chain().slave(index) != &slave) ++index;
      if (index == 0) {
        line.act(now, on ? CableEvent::Action::kUnplug : CableEvent::Action::kPlug);
      } else {
        line.chain().detach(now, on ? index : line.chain().size());
      }
      break;
    }
    default:
      break;
  }
}

void FaultInjector::set_jitter(Source& source, bool on) {
  const FaultConfig& fault = faults_[source.config];
  Line& line = *simulator_.line(fault.channel);
  WireFaults ma = line.ma_faults();
  WireFaults sl = line.sl_faults();
  if (fault.on_ma) {
    ma.jitter = on ? fault.width : source.ma_before.jitter;
  } else {
    sl.jitter = on ? fault.width : source.sl_before.jitter;
  }
  line.set_faults(ma, sl);
}

}  // namespace mb4::sim
