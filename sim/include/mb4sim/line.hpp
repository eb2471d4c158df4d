// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One physical channel outside the chip: cable out (MA, MO), the slaves, cable back (SL), with a
// monitor at the chip's MA pin and the faults of the line.
#ifndef MB4SIM_LINE_HPP_
#define MB4SIM_LINE_HPP_

#include "mb4sim/delay_line.hpp"
#include "mb4sim/event_queue.hpp"
#include "mb4sim/ma_monitor.hpp"
#include "mb4sim/sl_faults.hpp"
#include "mb4sim/slave_chain.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

class Line {
 public:
  // Called when the level of the chip's SL pin changes.
  using Output = void (*)(Time now, void* receiver, bool sl);

  // Called after any change at the slaves' end of the cable.
  using Probe = void (*)(Time now, void* receiver);

  // `round_trip` is the delay from pin MA to the slaves and back to pin SL in ps: half of it each
  // way, an odd picosecond on the way back.
  Line(EventQueue& queue, Time round_trip, Output output, void* receiver);
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  // Levels of the chip's MA and MO pins.
  void drive(Time now, bool ma, bool mo);
  // Applies a changed SlFaults::stick().
  void refresh(Time now) { set_pin(now, received_); }

  // For waveforms; at most one.
  void set_probe(Probe probe, void* receiver) {
    probe_ = probe;
    probe_receiver_ = receiver;
  }

  bool sl() const { return pin_; }
  SlaveChain& chain() { return chain_; }
  const SlaveChain& chain() const { return chain_; }
  MaMonitor& monitor() { return monitor_; }
  SlFaults& faults() { return faults_; }
  Time round_trip() const { return out_.delay() + back_.delay(); }

 private:
  static constexpr unsigned kMa = 1;
  static constexpr unsigned kMo = 2;

  static void at_slaves(Time now, void* receiver, unsigned levels);
  static void slo_changed(Time now, void* receiver, bool slo);
  static void at_master(Time now, void* receiver, unsigned levels);
  void send_back(Time now);
  void set_pin(Time now, bool level);

  DelayLine out_;
  DelayLine back_;
  SlaveChain chain_;
  MaMonitor monitor_;
  SlFaults faults_;
  Output output_;
  void* receiver_;
  Probe probe_ = nullptr;
  void* probe_receiver_ = nullptr;
  bool driving_ = false;  // inside SlaveChain::drive(): SLO is sent when it has settled
  bool sent_ = true;      // level put into the way back
  bool received_ = true;  // level that came out of it
  bool pin_ = true;
};

}  // namespace mb4::sim

#endif  // MB4SIM_LINE_HPP_
