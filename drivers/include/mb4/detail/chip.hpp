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
#include "mb4/opcodes.hpp"
#include "mb4/register_image.hpp"
#include "mb4/result.hpp"
#include "mb4/status.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

using enc::clock_step_us;

template <typename Bus, typename Clock>
struct Chip : ChipState {
  static_assert(kIsClock<Clock>,
                "mb4: the Clock type needs 'std::uint32_t now_us()'; see mb4/bus.hpp");

  constexpr Chip(Bus& bus, Clock& the_clock)
      : ChipState(&Chip::make_on_bus, &Chip::ask_clock, clock_step_us<Clock>),
        opcodes(bus),
        clock(&the_clock) {}

  Opcodes<Bus> opcodes;
  Clock* clock;

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

  // ChipState::make and ask_us.
  static bool make_on_bus(ChipState& chip, Steps& steps) {
    return steps.run(static_cast<Chip&>(chip).opcodes.bus());
  }
  static std::uint32_t ask_clock(ChipState& chip) {
    return static_cast<Chip&>(chip).clock->now_us();
  }
};

}  // namespace mb4::detail

#endif  // MB4_DETAIL_CHIP_HPP_
