// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One physical channel outside the chip: the cable out (MA, MO), the slaves and the cable back
// (SL). It has a monitor at the chip's MA pin and the faults of the line.
#ifndef MB4SIM_LINE_HPP_
#define MB4SIM_LINE_HPP_

#include <cstdint>
#include <utility>
#include <vector>

#include "sim/core/cable.hpp"
#include "sim/core/event_queue.hpp"
#include "sim/core/time.hpp"
#include "sim/core/wire.hpp"
#include "sim/lines/ma_monitor.hpp"
#include "sim/lines/sl_faults.hpp"
#include "sim/lines/slave_chain.hpp"

namespace mb4::sim {

class Line {
 public:
  // Called when the level of the chip's SL pin changes.
  using Output = void (*)(Time now, void* receiver, bool sl);

  // Called with the level of a pin of the chip on this line.
  enum class Signal { kMa, kMo, kSl };
  using Tap = void (*)(Time now, void* receiver, Signal signal, bool level);

  // Called after any change at the slaves' end of the cable.
  using Probe = void (*)(Time now, void* receiver);

  // `round_trip` is the delay in ps from pin MA to the slaves and back to pin SL. Each way takes
  // half of it, and an odd picosecond is added on the way back. `cable` holds the faults of the
  // cable; `seed` is the seed of their random values. The events of `cable` are posted at once.
  Line(EventQueue& queue, Time round_trip, Output output, void* receiver,
       const CableConfig& cable = {}, std::uint64_t seed = 0);
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

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
  void refresh(Time now) { set_pin(now, received_); }

  // --- the cable; changes are valid for edges that leave from now on --------------------------
  Time round_trip() const { return out_.delay() + back_.delay(); }
  // Round trip in ps, as in the constructor.
  void set_round_trip(Time round_trip);
  // Jitter and skew of both directions. The rate of glitches keeps its constructed value.
  void set_faults(const WireFaults& ma, const WireFaults& sl);
  const WireFaults& ma_faults() const { return out_.faults(); }
  const WireFaults& sl_faults() const { return back_.faults(); }
  // One glitch of `width` ps at the slaves' MA or at the chip's SL.
  void glitch_ma(Time now, Time width) {
    lane_ = false;
    out_.glitch(now, width);
  }
  void glitch_sl(Time now, Time width) { back_.glitch(now, width); }
  // Makes one cable event happen now.
  void act(Time now, CableEvent::Action action);
  bool plugged() const { return plugged_; }

  // Probes are for waveforms and recordings. Each receiver has at most one, and a null pointer
  // takes it away.
  void set_probe(Probe probe, void* receiver);

  // The tap is for recordings. There is at most one. It is called when SL changes, and for MA and
  // MO when either of them may have changed.
  void set_tap(Tap tap, void* receiver) {
    lane_ = false;
    tap_ = tap;
    tap_receiver_ = receiver;
  }

  // Level of the chip's SL pin.
  bool sl() const { return pin_; }
  SlaveChain& chain() { return chain_; }
  const SlaveChain& chain() const { return chain_; }
  MaMonitor& monitor() { return monitor_; }
  SlFaults& faults() { return faults_; }

 private:
  static constexpr unsigned kMa = 1;
  static constexpr unsigned kMo = 2;

  static void at_slaves(Time now, void* receiver, unsigned levels);
  static void mo_at_slaves(Time now, void* receiver, unsigned levels);
  static void slo_changed(Time now, void* receiver, bool slo);
  static void at_master(Time now, void* receiver, unsigned levels);
  static void on_event(Time now, void* receiver, std::uint64_t action);
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
  Output output_;
  void* receiver_;
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

}  // namespace mb4::sim

#endif  // MB4SIM_LINE_HPP_
