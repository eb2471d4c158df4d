// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What the chip asks of the bus that the caller supplies. The contracts of bus and clock, and their
// adapters for plain C functions: enc/bus.hpp.
//
// * SPI mode 0 (clock idle low, sample on the rising edge), most significant bit first
//   (datasheet page 17). NCS is low during a frame and >= 10 ns high between two (I209). SCLK high
//   and low >= 10 ns (I203, I204).
// * I204 (datasheet page 11): between the address byte of opcode 0x03 and the first data bit SCLK
//   must be high for >= 100 ns. Run frames that begin with 0x03 at <= 5 MHz, or stretch their 16th
//   high phase. All other opcodes may run at the full rate: the ports take two rates. read_frame()
//   of slave 1 does not use 0x03.
// * The chip needs three system clocks between two writes of 0xF4, and between such a write and a
//   status read that must see EOT = 0. SCLK <= 2 * f_CLK is always safe. This limits SCLK only with
//   a slow system clock: 2 MHz at f_CLK = 1 MHz. The driver cannot check SCLK.
// * 2 <= tx.size() <= kMaxTransferBytes (opcodes.hpp).

#ifndef MB4_BUS_HPP_
#define MB4_BUS_HPP_

#include <cstdint>

#include "enc/bus.hpp"
#include "mb4/result.hpp"
#include "mb4_regs.hpp"

namespace mb4 {

// Fastest SCLK of opcode 0x03 without a stretched clock (I204).
inline constexpr std::uint32_t kReadSclkHz = 5'000'000;

// True for the frames that need it. `tx` is a frame of the driver.
[[nodiscard]] constexpr bool needs_read_sclk(Span<const std::uint8_t> tx) {
  return tx[0] == static_cast<std::uint8_t>(regs::SpiOpcode::kReadRegisters);
}

using enc::FunctionBus;
using enc::FunctionClock;
using enc::kIsBus;
using enc::kIsClock;

}  // namespace mb4

#endif  // MB4_BUS_HPP_
