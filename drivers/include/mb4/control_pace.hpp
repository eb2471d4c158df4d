// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// How long a control communication goes on. Not for direct use; see ControlSteps.

#ifndef MB4_CONTROL_PACE_HPP_
#define MB4_CONTROL_PACE_HPP_

#include <cstdint>

#include "mb4/chip.hpp"
#include "mb4/control_data.hpp"

namespace mb4::detail {

// Time and polls for what begins now: the access, one of its frames, or the slaves' timeout.
template <typename Bus, typename Clock>
void restart_time(Chip<Bus, Clock>& chip, std::uint32_t timeout_us) {
  chip.control.start_us = chip.clock->now_us();
  chip.control.timeout_us = timeout_us;
  chip.control.polls_left = timeout_us + timeout_us / 16 + 2;  // as of Deadline
}

// Without automatic frames the host sets the pace: an access is over for good when the frames it
// needs and the time of a busy slave have gone, and after as many frames as fit into that time.
template <typename Bus, typename Clock>
[[nodiscard]] bool enough_frames(Chip<Bus, Clock>& chip) {
  const ControlState& state = chip.control;
  return state.frames >= control_frame_limit(chip.config, state.count) ||
         (state.frames >= control_frames(state.count) &&
          chip.clock->now_us() - state.access_us >= control_timeout_us(chip.config, state.count));
}

}  // namespace mb4::detail

#endif  // MB4_CONTROL_PACE_HPP_
