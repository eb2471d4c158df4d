// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Vector table and reset handler. There is no initialised data to copy; .bss is cleared.

#include <cstdint>

#include "board.hpp"

extern "C" {

extern std::uint32_t bss_begin;
extern std::uint32_t bss_end;
extern std::uint32_t stack_top;

int main();

[[noreturn]] void reset_handler() {
  for (std::uint32_t* word = &bss_begin; word != &bss_end; ++word) {
    *word = 0;
  }
  main();
  board::exit(0);
}

[[noreturn]] void fault_handler() {
  board::print("fault\n");
  board::exit(255);
}

// IRQ 0, of a firmware that asks for it.
[[gnu::weak]] void uart_received() { fault_handler(); }

using Handler = void (*)();
struct Vectors {
  std::uint32_t* stack;
  Handler handlers[16];
};
extern const Vectors vectors;
[[gnu::section(".vectors"), gnu::used]] const Vectors vectors{
    &stack_top,
    {reset_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler,
     nullptr, nullptr, nullptr, nullptr, fault_handler, fault_handler, nullptr, fault_handler,
     fault_handler, uart_received}};

}  // extern "C"
