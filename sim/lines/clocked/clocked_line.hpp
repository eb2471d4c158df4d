// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A line with a clock: the cable out (MA, MO), the slaves and the cable back (SL). It has a monitor
// at the master's MA pin, a guard of its pulses, and the faults of the line.
#ifndef MB4SIM_CLOCKED_LINE_HPP_
#define MB4SIM_CLOCKED_LINE_HPP_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "sim/core/event_queue.hpp"
#include "sim/core/time.hpp"
#include "sim/core/wire.hpp"
#include "sim/core/wire_faults.hpp"
#include "sim/lines/clocked/clocked_end.hpp"
#include "sim/lines/clocked/ma_monitor.hpp"
#include "sim/lines/clocked/sl_faults.hpp"
#include "sim/lines/clocked/slave_chain.hpp"
#include "sim/lines/line.hpp"

namespace mb4::sim {

class ClockedFrames;
struct LineSetup;

// The cable of a clocked line, as a scenario describes it.
struct ClockedConfig : LineConfig {
  WireFaults ma;           // master to slaves
  WireFaults sl;           // slaves to master
  bool open_level = true;  // level that the master's receiver gives for an open SL pair
  // Bus connection: MO is wired to SLI of the last slave. Without it this SLI is tied to 0.
  bool mo = false;
  Time mo_late = 0;  // how much later than MA an edge of MO arrives at the slaves, ps
};

class ClockedLine final : public Line {
 public:
  // Called when the level of the chip's SL pin changes.
  using Output = void (*)(Time now, void* receiver, bool sl);

  // Called with the level of a pin of the chip on this line.
  enum class Signal { kMa, kMo, kSl };
  using Tap = void (*)(Time now, void* receiver, Signal signal, bool level);

  // Places in LineKind::wires.
  static constexpr unsigned kSlWire = 0;
  static constexpr unsigned kMaWire = 1;
  static constexpr LineAction kSlLow{LineAction::What::kLow, kSlWire};
  static constexpr LineAction kSlHigh{LineAction::What::kHigh, kSlWire};
  static constexpr LineAction kSlFree{LineAction::What::kFree, kSlWire};
  static constexpr LineAction kMaLow{LineAction::What::kLow, kMaWire};
  static constexpr LineAction kMaHigh{LineAction::What::kHigh, kMaWire};
  static constexpr LineAction kMaFree{LineAction::What::kFree, kMaWire};
  static constexpr LineAction kUnplug{LineAction::What::kUnplug};
  static constexpr LineAction kPlug{LineAction::What::kPlug};

  // The delay of `config` is that from pin MA to the slaves and back to pin SL. Each way takes half
  // of it, and an odd picosecond is added on the way back. `seed` is the seed of the random values
  // of its faults. Its events are posted at once.
  ClockedLine(EventQueue& queue, const ClockedConfig& config, Output output, void* receiver,
              std::uint64_t seed = 0);
  // As the simulator makes it: SL goes to the master, and MA is guarded.
  explicit ClockedLine(const LineSetup& setup);
  ~ClockedLine() override;

  void add(std::unique_ptr<ClockedSlave> slave) { chain_.add(std::move(slave)); }

  // The levels of the master's pins: clocked_end.hpp.
  void drive(Time now, unsigned levels) override {
    guard_.drive(now, levels);
    pins_ = levels;
    drive(now, (levels & kMaPin) != 0, (levels & kMoPin) != 0);
  }
  void follow(bool follows, unsigned levels) override { guard_.follow(follows, levels); }
  // Sets the levels of the chip's MA and MO pins. MO has an effect only in a bus connection.
  void drive(Time now, bool ma, bool mo) {
    monitor_.edge(now, ma);
    const unsigned levels = (ma ? kMa : 0U) | (mo && mo_wired_ ? kMo : 0U);
    if (lane_ && shifts(levels)) {
      out_.pass(levels);
      shift(now, levels);
    } else {
      drive_all(now, ma, mo, levels);
    }
  }
  // Applies a changed SlFaults::stick().
  void refresh(Time now) override { set_pin(now, received_); }

  // --- slaves ------------------------------------------------------------------------------------
  std::size_t size() const override { return chain_.size(); }
  ClockedSlave& slave(std::size_t index) override { return chain_.slave(index); }
  std::size_t attached() const override { return chain_.attached(); }
  void detach(Time now, std::size_t index) override { chain_.detach(now, index); }
  void slave_changed(Time now) override { chain_.refresh(now); }

  // --- the cable; changes are valid for edges that leave from now on --------------------------
  Time round_trip() const override { return out_.delay() + back_.delay(); }
  void set_round_trip(Time round_trip) override;
  // Jitter and skew of both directions. The rate of glitches keeps its constructed value.
  void set_faults(const WireFaults& ma, const WireFaults& sl);
  const WireFaults& ma_faults() const { return out_.faults(); }
  const WireFaults& sl_faults() const { return back_.faults(); }
  WireFaults wire_faults(unsigned wire) const override {
    return wire == kMaWire ? out_.faults() : back_.faults();
  }
  void set_wire_faults(unsigned wire, const WireFaults& faults) override;
  // At the slaves' MA or at the chip's SL.
  void glitch(Time now, unsigned wire, Time width) override;
  void act(Time now, LineAction action) override;
  bool plugged() const override { return plugged_; }

  // --- frames ------------------------------------------------------------------------------------
  using Line::flip;
  void flip(std::uint64_t frame, std::vector<unsigned> bits, FlipWatch watch) override {
    faults_.flip_frame(frame, bits, watch);
  }
  std::uint64_t flip_frames() const override { return faults_.frames(); }
  void observe(Time now, LineObserver* observer, bool edges) override;

  // --- for a waveform ----------------------------------------------------------------------------
  void set_probe(Probe probe, void* receiver) override;
  bool arrived() const override { return chain_.ma(); }
  bool sent(std::size_t index) const override { return chain_.slave(index).slo(); }
  bool ready(std::size_t index) const override { return chain_.slave(index).idle(); }

  // The tap is for recordings. There is at most one. It is called when SL changes, and for MA and
  // MO when either of them may have changed.
  void set_tap(Tap tap, void* receiver) {
    lane_ = false;
    tap_ = tap;
    tap_receiver_ = receiver;
  }

  // Levels of the master's pins as drive() was last told.
  unsigned pins() const { return pins_; }
  // Level of the chip's SL pin.
  bool sl() const { return pin_; }
  SlaveChain& chain() { return chain_; }
  const SlaveChain& chain() const { return chain_; }
  MaMonitor& monitor() { return monitor_; }
  SlFaults& faults() { return faults_; }
  // Without a simulator it guards nothing.
  MaGuard& guard() { return guard_; }

 private:
  static constexpr unsigned kMa = 1;
  static constexpr unsigned kMo = 2;

  static void at_slaves(Time now, void* receiver, unsigned levels);
  static void mo_at_slaves(Time now, void* receiver, unsigned levels);
  static void slo_changed(Time now, void* receiver, bool slo);
  static void at_master(Time now, void* receiver, unsigned levels);
  static void on_event(Time now, void* receiver, std::uint64_t event);
  void drive_all(Time now, bool ma, bool mo, unsigned levels);
  // True if an edge of MA arrives in the data of a frame and nothing disturbs the slaves.
  bool shifts(unsigned levels) const {
    return chain_.shifting() && faults_.only_counts() &&
           levels == ((ma_arrived_ ? 0U : kMa) | (mo_leaving_ ? kMo : 0U));
  }
  void shift(Time now, unsigned levels) {
    ma_arrived_ = (levels & kMa) != 0;
    if (ma_arrived_) faults_.count_bit();
    const bool slo = chain_.shift(now, ma_arrived_, mo_arrived_);
    if (slo == sent_) return;
    sent_ = slo;
    back_.drive(now, slo ? 1U : 0U);
  }
  void to_slaves(Time now);
  void send_back(Time now);
  void set_pin(Time now, bool level);

  Wire out_;      // bit 0 is MA; MO is another bit, so that no fault lets it overtake MA
  Wire mo_late_;  // the extra delay of MO
  Wire back_;
  SlaveChain chain_;
  MaMonitor monitor_;
  SlFaults faults_;
  MaGuard guard_;
  Output output_;
  void* receiver_;
  EventQueue& queue_;
  LineMaster* master_ = nullptr;  // of the second constructor
  unsigned index_ = 0;
  unsigned pins_ = kMaPin;
  std::vector<LineEvent> events_;
  std::unique_ptr<ClockedFrames> frames_;        // if somebody is told of them
  std::vector<std::pair<Probe, void*>> probes_;  // with their receivers
  Tap tap_ = nullptr;
  void* tap_receiver_ = nullptr;
  bool open_level_;
  bool mo_wired_;
  bool plugged_ = true;
  bool ma_arrived_ = true;  // levels at the slaves' end of the cable
  bool mo_arrived_ = false;
  bool mo_leaving_ = false;  // level of MO put into mo_late_
  bool driving_ = false;     // inside SlaveChain::drive(): SLO is sent after it has settled
  bool lane_ = false;        // nothing watches an edge of MA on its way to the slaves
  bool sent_ = true;         // level sent into the way back
  bool received_ = true;     // level that has come out of it
  bool pin_ = true;
};

// Guard of pin MA at the master's end of a clocked line, also where the scenario has no line.
inline MaPulseCheck& ma_check(LineEnd& end) {
  auto* line = dynamic_cast<ClockedLine*>(&end);
  return (line != nullptr ? line->guard() : dynamic_cast<ClockedOpenEnd&>(end).guard()).check();
}

// A clocked line, for a program that knows that it is one.
inline ClockedLine* clocked(Line* line) { return static_cast<ClockedLine*>(line); }
inline const ClockedConfig& clocked(const LineConfig& config) {
  return dynamic_cast<const ClockedConfig&>(config);
}

}  // namespace mb4::sim

#endif  // MB4SIM_CLOCKED_LINE_HPP_
