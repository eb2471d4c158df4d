// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What the chip asks of the bus that the caller supplies. The contracts of bus and clock, and their
// adapters for plain C functions: enc/bus.hpp.
//
// * SPI mode 0 (clock idle low, sample on the rising edge), most significant bit first
//   (datasheet page 17). NCS is low during a frame and >= 10 ns high between two (I209). SCLK high
//   and low >= 10 ns (I203, I204).
// * I204 (datasheet page 11): between the address byte of opcode 0x03 and the first data bit SCLK
//   must be high for >= 100 ns. Run SCLK at <= 5 MHz, or stretch the 16th high phase of frames
//   that begin with 0x03. All other opcodes may run at the full rate. read_frame() of slave 1 does
//   not use 0x03.
// * The chip needs three system clocks between two writes of 0xF4, and between such a write and a
//   status read that must see EOT = 0. SCLK <= 2 * f_CLK is always safe. This limits SCLK only with
//   a slow system clock: 2 MHz at f_CLK = 1 MHz. The driver cannot check SCLK.
// * 2 <= tx.size() <= kMaxTransferBytes (opcodes.hpp).

#ifndef MB4_BUS_HPP_
#define MB4_BUS_HPP_

#include "enc/bus.hpp"

namespace mb4 {

using enc::FunctionBus;
using enc::FunctionClock;
using enc::kIsBus;
using enc::kIsClock;

}  // namespace mb4

#endif  // MB4_BUS_HPP_
