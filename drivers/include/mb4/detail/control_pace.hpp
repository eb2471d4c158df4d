// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The time and the number of frames that a running control communication has left.

#ifndef MB4_DETAIL_CONTROL_PACE_HPP_
#define MB4_DETAIL_CONTROL_PACE_HPP_

#include <cstdint>

#include "mb4/detail/chip.hpp"
#include "mb4/detail/control_time.hpp"

namespace mb4::detail {

// Starts the time and the count of polls for an access, one of its frames, or the slaves' timeout.
template <typename Bus, typename Clock>
void restart_time(Chip<Bus, Clock>& chip, std::uint32_t timeout_us) {
  chip.control.start_us = chip.clock->now_us();
  chip.control.timeout_us = timeout_us + kClockStepUs;
  chip.control.polls_left = polls_of(timeout_us);
}

// Longest time of the access, in microseconds: at most 930 * 1 s + 13 s, which fits 32 bits.
[[nodiscard]] inline std::uint32_t longest_access_us(const ChipState& chip) {
  return control_frames(chip.control.count) * chip.pitch_us + chip.busy_us + kFrameMarginUs;
}

// For accesses without automatic frames, where the host sets the pace. True when the access cannot
// end well any more: all frames that it needs have run and the time of a busy slave is over. A
// frame takes more than a microsecond, so a clock that stands still ends it too.
[[nodiscard]] inline bool enough_frames(const ChipState& chip, std::uint32_t now_us) {
  const ControlState& state = chip.control;
  const std::uint32_t needed = control_frames(state.count);
  return state.frames >= needed && (state.frames - needed > chip.busy_us ||
                                    now_us - state.access_us >= longest_access_us(chip));
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_CONTROL_PACE_HPP_
