// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What a board brings along; not counted as the driver's.

#ifndef MB4_TESTS_DRIVER_FOOTPRINT_BOARD_HPP_
#define MB4_TESTS_DRIVER_FOOTPRINT_BOARD_HPP_

#include "mb4/mb4.hpp"

extern "C" bool board_transfer(const std::uint8_t* tx, std::uint8_t* rx, std::size_t size);
extern "C" std::uint32_t board_now_us();

struct BoardBus {
  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
    return board_transfer(tx.data(), rx.data(), tx.size());
  }
};
struct BoardClock {
  std::uint32_t now_us() { return board_now_us(); }
};
using BoardDevice = mb4::Device<BoardBus, BoardClock>;

#endif  // MB4_TESTS_DRIVER_FOOTPRINT_BOARD_HPP_
