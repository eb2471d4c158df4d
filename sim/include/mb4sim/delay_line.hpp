// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Transport delay of a cable: every edge arrives, however many are in flight. A delay of 0 passes
// an edge on at once, inside the call.
#ifndef MB4SIM_DELAY_LINE_HPP_
#define MB4SIM_DELAY_LINE_HPP_

#include <cstdint>

#include "mb4sim/event_queue.hpp"
#include "mb4sim/time.hpp"

namespace mb4::sim {

class DelayLine {
 public:
  // Called with the time of arrival and the levels that were put in.
  using Output = void (*)(Time now, void* receiver, unsigned levels);

  DelayLine(EventQueue& queue, Time delay, Output output, void* receiver)
      : queue_(queue), delay_(delay), output_(output), receiver_(receiver) {}
  DelayLine(const DelayLine&) = delete;
  DelayLine& operator=(const DelayLine&) = delete;

  // Puts a set of levels (one bit a wire) into the near end at time `now`.
  void drive(Time now, unsigned levels) {
    if (delay_ == 0) {
      output_(now, receiver_, levels);
    } else {
      queue_.post(now + delay_, &DelayLine::arrive, this, levels);
    }
  }
  Time delay() const { return delay_; }

 private:
  static void arrive(Time now, void* receiver, std::uint64_t levels) {
    auto* line = static_cast<DelayLine*>(receiver);
    line->output_(now, line->receiver_, static_cast<unsigned>(levels));
  }

  EventQueue& queue_;
  Time delay_;
  Output output_;
  void* receiver_;
};

}  // namespace mb4::sim

#endif  // MB4SIM_DELAY_LINE_HPP_
