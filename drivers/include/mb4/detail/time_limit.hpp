// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// How long the driver looks for something before it gives up.

#ifndef MB4_DETAIL_TIME_LIMIT_HPP_
#define MB4_DETAIL_TIME_LIMIT_HPP_

#include <cstdint>

#include "mb4/bus.hpp"

namespace mb4::detail {

// Coarsest step of a time source, that of 32 kHz, and the rounding of its readings (enc/bus.hpp).
// Two readings may differ by this much more than the time between them. Every wait is longer by it.
inline constexpr std::uint32_t kClockStepUs = enc::kMaxClockStepUs;

// Polls of the status that `time_us` (up to 1'000'000'000) may hold. The fastest poll is five
// cycles of the parallel bus: 0.25 us, because a cycle takes at least 55 ns (I104 to I116).
constexpr std::uint32_t polls_of(std::uint32_t time_us) { return 4 * (time_us + kClockStepUs); }

// Ends the polls of an Operation after a time, never before. It also counts the polls, so that the
// loop ends when the time source stands still.
//
// note() comes before a poll: it tells whether this poll is the last one. So the last poll is made
// when the time is already over: a task that was suspended reads once more before it reports a
// timeout.
struct TimeLimit {
  std::uint32_t start_us = 0;
  std::uint32_t timeout_us = 0;
  std::uint32_t polls_left = 0;
  bool over = false;

  // `timeout` up to 1'000'000'000 us.
  void begin(std::uint32_t now_us, std::uint32_t timeout) {
    start_us = now_us;
    timeout_us = timeout + kClockStepUs;
    polls_left = polls_of(timeout);
    over = false;
  }
  bool note(std::uint32_t now_us) {
    if (--polls_left == 0) {
      over = true;
    }
    return look(now_us);
  }
  // The same without a poll.
  bool look(std::uint32_t now_us) {
    if (now_us - start_us >= timeout_us) {
      over = true;
    }
    return over;
  }
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_TIME_LIMIT_HPP_
