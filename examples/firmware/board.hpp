// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The board: an ARM MPS2 (Cortex-M3 or M4) as QEMU emulates it. The chip is at the other end of
// UART 0, behind `mb4sim spi`, which takes a line of hex bytes for each SPI frame.

#ifndef MB4_EXAMPLES_FIRMWARE_BOARD_HPP_
#define MB4_EXAMPLES_FIRMWARE_BOARD_HPP_

#include <cstddef>
#include <cstdint>

#include "mb4/span.hpp"

namespace board {

// UART 0, a CMSDK APB UART.
struct Uart {
  static volatile std::uint32_t& at(std::uint32_t offset) {
    return *reinterpret_cast<volatile std::uint32_t*>(0x40004000U + offset);
  }
  static void open() {
    at(0x10) = 16;  // BAUDDIV
    at(0x08) = 3;   // CTRL: transmitter and receiver on
  }
  static void put(char character) {
    while ((at(0x04) & 1U) != 0) {  // STATE: transmit buffer full
    }
    at(0x00) = static_cast<std::uint8_t>(character);
  }
  static char get() {
    while ((at(0x04) & 2U) == 0) {  // STATE: receive buffer full
    }
    return static_cast<char>(at(0x00));
  }
};

inline char hex_digit(unsigned value) {
  return static_cast<char>(value < 10 ? '0' + value : 'A' + (value - 10));
}
// Value of a hex digit; 16 for anything else.
inline unsigned hex_value(char digit) {
  if (digit >= '0' && digit <= '9') {
    return static_cast<unsigned>(digit - '0');
  }
  return digit >= 'A' && digit <= 'F' ? static_cast<unsigned>(digit - 'A') + 10 : 16;
}

// The driver's bus: "02 ED 01\n" out, "00 00 00\n" in.
struct Bus {
  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
    for (const std::uint8_t byte : tx) {
      Uart::put(hex_digit(byte >> 4U));
      Uart::put(hex_digit(byte & 15U));
      Uart::put(' ');
    }
    Uart::put('\n');
    for (std::size_t i = 0; i < tx.size(); ++i) {
      const unsigned high = hex_value(Uart::get());
      const unsigned low = hex_value(Uart::get());
      const char end = i + 1 < tx.size() ? ' ' : '\n';
      if (high > 15 || low > 15 || Uart::get() != end) {
        return false;
      }
      if (!rx.empty()) {
        rx[i] = static_cast<std::uint8_t>(high << 4U | low);
      }
    }
    return true;
  }
};

// The driver's clock. The time that counts is the simulator's: each look lets 1 us of it pass.
struct Clock {
  std::uint32_t time_us = 0;

  std::uint32_t now_us() {
    for (const char character : {'+', '1', '0', '0', '0', '\n'}) {
      Uart::put(character);
    }
    return ++time_us;
  }
};

// Semihosting: text to the debugger, and the end of the program with an exit status.
inline std::uint32_t semihost(std::uint32_t operation, const void* argument) {
  register std::uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}
inline void print(const char* text) { semihost(0x04, text); }
inline void print_hex(std::uint64_t value, unsigned digits) {
  char text[17] = {};
  for (unsigned i = 0; i < digits; ++i) {
    text[digits - 1 - i] = hex_digit(static_cast<unsigned>(value >> (4 * i)) & 15U);
  }
  print(text);
}
[[noreturn]] inline void exit(std::uint32_t status) {
  const std::uint32_t reason_and_status[2] = {0x20026, status};  // ADP_Stopped_ApplicationExit
  semihost(0x20, reason_and_status);
  for (;;) {
  }
}

}  // namespace board

#endif  // MB4_EXAMPLES_FIRMWARE_BOARD_HPP_
