// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// SPI frames that the driver has planned and the caller makes, by DMA or otherwise.

#ifndef MB4_STEPS_HPP_
#define MB4_STEPS_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/result.hpp"
#include "mb4_cyclic.h"

namespace mb4 {

// The frames of one step of a read (cyclic.hpp) or of an Operation (operation.hpp). Its memory is
// that of the object. Place it where DMA reaches it; each frame begins at a whole word. The object
// must stay where it is until its work has ended.
class Steps {
 public:
  Steps(const Steps&) = delete;
  Steps& operator=(const Steps&) = delete;

  // SPI frames to make now, in this order, each with NCS low: tx(i) goes out while rx(i) comes in.
  // rx(i) is as long as tx(i), or empty for a write. i < frames() <= kMaxFrames.
  static constexpr std::size_t kMaxFrames = MB4_PLAN_FRAMES;
  [[nodiscard]] std::size_t frames() const { return plan_.frames; }
  [[nodiscard]] Span<const std::uint8_t> tx(std::size_t i) const {
    return {mb4_plan_tx(&plan_, static_cast<std::uint8_t>(i)), plan_.size[i]};
  }
  [[nodiscard]] Span<std::uint8_t> rx(std::size_t i) {
    const std::uint8_t frame = static_cast<std::uint8_t>(i);
    return {mb4_plan_rx(&plan_, frame), mb4_plan_reads(&plan_, frame) ? plan_.size[i] : 0U};
  }

  // The first of these frames must not begin before a counter of microseconds has advanced by this
  // since the last frame before them, up to 1'000'133. Most are 0. The step of the coarsest clock
  // is in it (enc::kMaxClockStepUs), so the pause is never too short. Later is always allowed.
  [[nodiscard]] std::uint32_t pause_us() const { return plan_.pause_us; }

  // Makes the frames on a bus (bus.hpp), one after the other, without the pause. False: one has
  // failed, and those after it were not made.
  template <typename Bus>
  [[nodiscard]] bool run(Bus& bus) {
    for (std::size_t i = 0; i < frames(); ++i) {
      if (!bus.transfer(tx(i), rx(i))) {
        return false;
      }
    }
    return true;
  }

 protected:
  constexpr Steps() = default;
  ~Steps() = default;

  mb4_plan plan_{};
};

}  // namespace mb4

#endif  // MB4_STEPS_HPP_
