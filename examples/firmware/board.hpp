// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The board: an ARM MPS2 (Cortex-M3 or M4) as QEMU emulates it. The chip is at the other end of
// UART 0, behind `mb4sim bridge` (docs/bridge.md).

#ifndef MB4_EXAMPLES_FIRMWARE_BOARD_HPP_
#define MB4_EXAMPLES_FIRMWARE_BOARD_HPP_

#include <array>
#include <cstddef>
#include <cstdint>

#include "mb4/result.hpp"

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
  static void put(std::uint8_t byte) {
    while ((at(0x04) & 1U) != 0) {  // STATE: transmit buffer full
    }
    at(0x00) = byte;
  }
  static bool has_byte() { return (at(0x04) & 2U) != 0; }  // STATE: receive buffer full
  // From now on uart_received() is called for what comes in (IRQ 0).
  static void interrupt_on_receive() {
    at(0x08) = 3 | 8;                                             // CTRL: receive interrupt
    *reinterpret_cast<volatile std::uint32_t*>(0xE000E100U) = 1;  // NVIC_ISER0
  }
  static void clear_received() { at(0x0C) = 2; }  // INTCLEAR
  static std::uint8_t get() {
    while (!has_byte()) {
    }
    return static_cast<std::uint8_t>(at(0x00));
  }
};

// Requests of the bridge: kind, length, payload; answers: status, length, payload.
struct Bridge {
  static void begin(char kind, std::size_t length) {
    Uart::put(static_cast<std::uint8_t>(kind));
    Uart::put(static_cast<std::uint8_t>(length));
    Uart::put(static_cast<std::uint8_t>(length >> 8U));
  }
  // Takes an answer; as many bytes as there are go to `payload`. False if it is not a good one of
  // `length` bytes.
  static bool end(std::size_t length, mb4::Span<std::uint8_t> payload) {
    const bool good = Uart::get() == 0;
    std::size_t left = Uart::get();
    left |= static_cast<std::size_t>(Uart::get()) << 8U;
    const bool whole = left == length;
    for (std::size_t i = 0; left > 0; ++i, --left) {
      const std::uint8_t byte = Uart::get();
      if (i < payload.size()) {
        payload[i] = byte;
      }
    }
    return good && whole;
  }
};

// The driver's bus.
struct Bus {
  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
    Bridge::begin('T', tx.size());
    for (const std::uint8_t byte : tx) {
      Uart::put(byte);
    }
    return Bridge::end(tx.size(), rx);
  }
};

// The driver's clock. The time that counts is the simulator's: each look lets 1 us of it pass.
struct Clock {
  std::uint32_t now_us() {
    constexpr std::size_t kTime = 8;
    constexpr std::uint32_t kLookNs = 1000;
    Bridge::begin('W', kTime);
    for (unsigned i = 0; i < kTime; ++i) {
      Uart::put(static_cast<std::uint8_t>(i < 4 ? kLookNs >> (8 * i) : 0));
    }
    std::array<std::uint8_t, kTime> answer{};
    if (!Bridge::end(kTime, answer)) {
      return 0;
    }
    std::uint64_t ns = 0;
    for (unsigned i = 0; i < kTime; ++i) {
      ns |= static_cast<std::uint64_t>(answer[i]) << (8 * i);
    }
    return static_cast<std::uint32_t>(ns / kLookNs);
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
    text[digits - 1 - i] = "0123456789ABCDEF"[static_cast<unsigned>(value >> (4 * i)) & 15U];
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
