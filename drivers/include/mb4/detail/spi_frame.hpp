// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What an SPI frame of the driver asks for, for buses that are not serial.

#ifndef MB4_DETAIL_SPI_FRAME_HPP_
#define MB4_DETAIL_SPI_FRAME_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/result.hpp"
#include "mb4_regs.hpp"

namespace mb4::detail {

struct SpiFrame {
  std::uint8_t address = 0;  // of the first data byte
  std::size_t first = 0;     // place of that byte in the frame; the frame's size: nothing to do
  bool reads = false;
};

// Unknown opcodes do nothing, as on SPI.
[[nodiscard]] constexpr SpiFrame decode_frame(Span<const std::uint8_t> tx) {
  SpiFrame frame;
  frame.first = tx.size();
  if (tx.empty()) {
    return frame;
  }
  std::size_t first = 1;
  switch (static_cast<regs::SpiOpcode>(tx[0])) {
    case regs::SpiOpcode::kReadRegisters:
      frame.reads = true;
      [[fallthrough]];
    case regs::SpiOpcode::kWriteRegisters:
      if (tx.size() < 2) {
        return frame;
      }
      frame.address = tx[1];
      first = 2;
      break;
    case regs::SpiOpcode::kReadStatus:
      frame.reads = true;
      frame.address = regs::kAddrStatus0;
      break;
    case regs::SpiOpcode::kWriteInstruction:
      frame.address = regs::kAddrInstr;
      break;
    case regs::SpiOpcode::kReadRegisters0:
      frame.reads = true;
      break;
    case regs::SpiOpcode::kWriteRegisters0:
      break;
    default:
      return frame;
  }
  frame.first = first;
  return frame;
}

}  // namespace mb4::detail

#endif  // MB4_DETAIL_SPI_FRAME_HPP_
