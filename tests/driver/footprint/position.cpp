// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The position read path: what the interrupt of a control loop links, for one BiSS encoder of up to
// 32 bits with a CRC. The device is the application's and has been configured elsewhere.

#include "board.hpp"

// What the device reaches through its pointers. The linker keeps it.
extern "C" bool firmware_open(mb4::detail::ChipState& chip, mb4::Steps& steps) {
  using Chip = mb4::detail::Chip<BoardBus, BoardClock>;
  return Chip::make_on_bus(chip, steps) && Chip::ask_clock(chip) != 0;
}

extern "C" bool firmware(BoardDevice& device, std::uint64_t& position) {
  const mb4::Result<mb4::Reading> reading = device.automatic().poll_slave<0>(1);
  if (!reading) {
    return false;
  }
  position = reading->position;
  return true;
}
