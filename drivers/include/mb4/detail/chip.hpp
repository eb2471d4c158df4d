// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The state that all calls on one chip share: bus, clock, configuration, and what the driver knows
// about the chip.

#ifndef MB4_DETAIL_CHIP_HPP_
#define MB4_DETAIL_CHIP_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/config.hpp"
#include "mb4/detail/chip_state.hpp"
#include "mb4/detail/procedures.hpp"
#include "mb4/opcodes.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/span.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

using enc::clock_step_us;

// Waits without a transfer until the clock has advanced by `time_us` (up to 4'294'967), which holds
// its step. A count of calls ends the wait when the time source stands still. Even if a call takes
// only 1 ns, the count does not end before the time.
template <typename Clock>
void pause(Clock& clock, std::uint32_t time_us) {
  const std::uint32_t start_us = clock.now_us();
  std::uint32_t calls_left = time_us * 1000;
  while (clock.now_us() - start_us < time_us && --calls_left != 0) {
  }
}

template <typename Bus, typename Clock>
struct Chip : ChipState {
  static_assert(kIsClock<Clock>,
                "mb4: the Clock type needs 'std::uint32_t now_us()'; see mb4/bus.hpp");

  constexpr Chip(Bus& bus, Clock& the_clock) : opcodes(bus), clock(&the_clock) {
    step_us = clock_step_us<Clock>;
  }

  Opcodes<Bus> opcodes;
  Clock* clock;
  Operation own;  // of the calls that make the frames themselves

  // Makes the frames of one step of `op`. True: the operation has ended.
  [[gnu::noinline]] bool step(Operation& op) {
    if (op.pause_us() != 0) {
      pause(*clock, op.pause_us());
    }
    const bool transferred = op.run(opcodes.bus());
    return Procedures::finish(*this, op, transferred, clock->now_us());
  }
  // All steps.
  [[gnu::noinline]] Result<void> run(Operation& op) {
    while (!step(op)) {
    }
    return op.result();
  }

  // Reads the status once. kTransport, kNotDetected.
  Result<void> look(Status& status) {
    std::array<std::uint8_t, Status::kBytes> bytes{};
    const Result<void> read = opcodes.read_status(bytes);
    status = Status(bytes);
    return read && !status.plausible() ? Error::kNotDetected : read;
  }

  // Clears SVALIDx of the slaves in `mask` (flag_of()) in the bank that the host reads.
  // Writing 0 clears a flag and writing 1 has no effect (page 35, "reset by writing to the SVALIDx
  // register"), so the flags of other slaves do not change. One transfer.
  Result<void> clear_valid(std::uint16_t mask) {
    const unsigned keep = ~unsigned{mask};
    const std::array<std::uint8_t, 2> both{static_cast<std::uint8_t>(keep),
                                           static_cast<std::uint8_t>(keep >> 8U)};
    return opcodes.write_registers(regs::kAddrSvalidLo, both);
  }
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_CHIP_HPP_
