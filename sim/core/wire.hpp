// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One direction of a cable: a transport delay with the faults of WireFaults. Every edge arrives,
// even if several are on the way. An ideal wire without delay passes an edge on at once, inside the
// call. Bit 0 of the levels is the wire with the faults. The other bits arrive together with the
// edge with which they left. An edge never overtakes another one.
#ifndef MB4SIM_WIRE_HPP_
#define MB4SIM_WIRE_HPP_

#include <cstdint>
#include <optional>

#include "sim/core/event_queue.hpp"
#include "sim/core/random.hpp"
#include "sim/core/time.hpp"
#include "sim/core/wire_faults.hpp"

namespace mb4::sim {

class Wire {
 public:
  // Called with the time of arrival and the levels at the far end.
  using Output = void (*)(Time now, void* receiver, unsigned levels);

  // `idle`: the levels at both ends before the first drive(). With glitches the queue always holds
  // an event. The first one comes within two mean distances from time 0.
  Wire(EventQueue& queue, Time delay, const WireFaults& faults, std::uint64_t seed, unsigned idle,
       Output output, void* receiver);
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  // True if levels arrive at once and unchanged. Then pass() does what drive() does, but for the
  // call at the far end. This holds up to a call of another function.
  bool ideal() const {
    return delay_ == 0 && !uneven() && in_flight_ == 0 && faults_.glitches_per_s == 0 && !glitch_ &&
           single_glitches_ == 0 && !stuck_;
  }
  void pass(unsigned levels) { sent_ = arrived_ = shown_ = levels; }
  // Sets the levels (one bit for each wire) at the near end at time `now`.
  void drive(Time now, unsigned levels) {
    if (delay_ == 0 && !uneven() && in_flight_ == 0) {
      sent_ = levels;
      deliver(now, levels);
    } else {
      send(now, levels);
    }
  }
  Time delay() const { return delay_; }
  // Sets the delay in ps for edges that are driven from now on.
  void set_delay(Time delay) { delay_ = delay; }
  const WireFaults& faults() const { return faults_; }
  // Sets jitter, skew and glitch width for edges from now on. The rate of glitches stays.
  void set_faults(const WireFaults& faults);

  // Makes one glitch now: the level at the far end is inverted for `width` ps (1 or more).
  void glitch(Time now, Time width);
  // Sets the level of bit 0 at the far end, whatever arrives. Without a value the wire works again.
  void stick(Time now, std::optional<bool> level);

 private:
  static constexpr unsigned kFaulty = 1;  // bit with the faults

  static void arrive(Time now, void* receiver, std::uint64_t levels);
  static void begin_glitch(Time now, void* receiver, std::uint64_t word);
  static void end_glitch(Time now, void* receiver, std::uint64_t word);
  static void end_single_glitch(Time now, void* receiver, std::uint64_t word);
  void post_glitch(Time after);
  void send(Time now, unsigned levels);
  Time extra(bool rising);
  void deliver(Time now, unsigned levels) {
    arrived_ = levels;
    emit(now);
  }
  void emit(Time now) {
    unsigned levels = arrived_ ^ (inverted() ? kFaulty : 0U);
    if (stuck_) levels = (levels & ~kFaulty) | (*stuck_ ? kFaulty : 0U);
    if (levels == shown_) return;
    shown_ = levels;
    output_(now, receiver_, levels);
  }
  // True if the travel time of an edge differs from delay_.
  bool uneven() const { return faults_.jitter != 0 || faults_.skew != 0; }
  bool inverted() const { return glitch_ != (single_glitches_ % 2 != 0); }

  EventQueue& queue_;
  Time delay_;
  WireFaults faults_;
  Random random_;         // jitter
  Random glitch_random_;  // a separate one: jitter must not depend on the number of glitches
  Output output_;
  void* receiver_;
  std::optional<bool> stuck_;
  bool glitch_ = false;
  unsigned single_glitches_ = 0;  // number of single glitches that have not ended
  unsigned in_flight_ = 0;
  unsigned sent_;
  unsigned arrived_;
  unsigned shown_;
  Time last_ = 0;  // latest arrival so far
};

}  // namespace mb4::sim

#endif  // MB4SIM_WIRE_HPP_
