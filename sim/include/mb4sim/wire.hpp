// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// One direction of a cable: a transport delay (every edge arrives, however many are in flight) with
// the faults of WireFaults. An ideal wire without delay passes an edge on at once, inside the call.
// Bit 0 of the levels is the wire that has the faults; other bits ride along and arrive with the
// edges they left with. Edges never overtake each other.
#ifndef MB4SIM_WIRE_HPP_
#define MB4SIM_WIRE_HPP_

#include <cstdint>
#include <optional>

#include "mb4sim/cable.hpp"
#include "mb4sim/event_queue.hpp"
#include "mb4sim/random.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

class Wire {
 public:
  // Called with the time of arrival and the levels at the far end.
  using Output = void (*)(Time now, void* receiver, unsigned levels);

  // `idle`: levels at both ends before the first drive(). With glitches an event is in the queue at
  // all times, the first within two mean distances from time 0.
  Wire(EventQueue& queue, Time delay, const WireFaults& faults, std::uint64_t seed, unsigned idle,
       Output output, void* receiver);
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  // Puts a set of levels (one bit a wire) into the near end at time `now`.
  void drive(Time now, unsigned levels) {
    if (delay_ == 0 && !uneven() && in_flight_ == 0) {
      sent_ = levels;
      deliver(now, levels);
    } else {
      send(now, levels);
    }
  }
  Time delay() const { return delay_; }
  // For edges driven from now on.
  void set_delay(Time delay) { delay_ = delay; }
  const WireFaults& faults() const { return faults_; }
  // Jitter, skew and glitch width for edges from now on; the rate of glitches stays.
  void set_faults(const WireFaults& faults);

  // One glitch now: the level at the far end is inverted for `width` ps (1 or more).
  void glitch(Time now, Time width);
  // Level of bit 0 at the far end whatever arrives; without a value the wire works again.
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
  // Edges take more time than delay_.
  bool uneven() const { return faults_.jitter != 0 || faults_.skew != 0; }
  bool inverted() const { return glitch_ != (single_glitches_ % 2 != 0); }

  EventQueue& queue_;
  Time delay_;
  WireFaults faults_;
  Random random_;         // jitter
  Random glitch_random_;  // apart, so that jitter does not depend on how many glitches there were
  Output output_;
  void* receiver_;
  std::optional<bool> stuck_;
  bool glitch_ = false;
  unsigned single_glitches_ = 0;  // that are going on
  unsigned in_flight_ = 0;
  unsigned sent_;
  unsigned arrived_;
  unsigned shown_;
  Time last_ = 0;  // latest arrival so far
};

}  // namespace mb4::sim

#endif  // MB4SIM_WIRE_HPP_
