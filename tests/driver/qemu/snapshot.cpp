// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A Snapshot between main() and the SysTick interrupt of a Cortex-M, whose period changes with each
// tick. First the interrupt writes and main() reads, then the other way round. With NAIVE the value
// is copied without any care: then parts of two values must be seen (snapshot_test.py).

#include "enc/snapshot.hpp"

#include <array>
#include <cstdint>

#include "examples/firmware/board.hpp"

namespace {

constexpr std::uint32_t kTicks = 250'000;
constexpr std::size_t kWords = 6;
using Value = std::array<std::uint32_t, kWords>;

#ifdef NAIVE
struct Naive {
  void write(const Value& value) {
    for (std::size_t i = 0; i < kWords; ++i) {
      words[i] = value[i];
    }
  }
  bool try_read(Value& value) const {
    for (std::size_t i = 0; i < kWords; ++i) {
      value[i] = words[i];
    }
    return true;
  }
  volatile std::uint32_t words[kWords] = {};
};
Naive shared;
#else
enc::Snapshot<Value> shared;
#endif

volatile bool interrupt_writes = false;
volatile bool inside = false;  // main() reads or writes
volatile std::uint32_t ticks = 0;
volatile std::uint32_t preempted = 0;
volatile std::uint32_t torn = 0;
volatile std::uint32_t refused = 0;
std::uint32_t number = 0;
std::uint32_t seed = 0;

volatile std::uint32_t& at(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}
std::uint32_t random() {
  seed = seed * 1'664'525U + 1'013'904'223U;
  return seed >> 16U;
}
void write_next() {
  ++number;
  Value value;
  value.fill(number);
  shared.write(value);
}
void read_one() {
  Value value;
  if (!shared.try_read(value)) {
    refused = refused + 1;
    return;
  }
  for (const std::uint32_t word : value) {
    if (word != value[0]) {
      torn = torn + 1;
      return;
    }
  }
}
void report(const char* what) {
  board::print(what);
  board::print(": preempted 0x");
  board::print_hex(preempted, 8);
  board::print(", torn 0x");
  board::print_hex(torn, 8);
  board::print(", read again 0x");
  board::print_hex(refused, 8);
  board::print("\n");
  preempted = torn = refused = ticks = 0;
}

}  // namespace

extern "C" void systick() {
  at(0xE000E014) = 2 + random() % 16;  // SYST_RVR, from the next period on
  ticks = ticks + 1;
  preempted = preempted + (inside ? 1 : 0);
  if (interrupt_writes) {
    write_next();
    if (random() % 4 == 0) {
      write_next();  // twice at once: the reader's copy is overwritten
    }
  } else {
    read_one();
  }
}

int main() {
  write_next();
  at(0xE000E014) = 10;
  at(0xE000E018) = 0;
  at(0xE000E010) = 7;  // SYST_CSR: processor clock, interrupt, on
  while (ticks < kTicks) {
    inside = true;
    read_one();
    inside = false;
  }
  interrupt_writes = false;
  report("main reads");
  while (ticks < kTicks) {
    inside = true;
    write_next();
    inside = false;
  }
  at(0xE000E010) = 0;
  report("interrupt reads");
  board::exit(0);
}

extern "C" {

extern std::uint32_t bss_begin;
extern std::uint32_t bss_end;
extern std::uint32_t stack_top;

// There is initialised data neither here nor in the driver.
[[noreturn]] void reset_handler() {
  for (std::uint32_t* word = &bss_begin; word != &bss_end; ++word) {
    *word = 0;
  }
  interrupt_writes = true;
  seed = 1;
  main();
  board::exit(0);
}
[[noreturn]] void fault_handler() { board::exit(255); }

using Handler = void (*)();
struct Vectors {
  std::uint32_t* stack;
  Handler handlers[15];
};
extern const Vectors vectors;
[[gnu::section(".vectors"), gnu::used]] const Vectors vectors{
    &stack_top,
    {reset_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler,
     nullptr, nullptr, nullptr, nullptr, fault_handler, fault_handler, nullptr, fault_handler,
     systick}};

}  // extern "C"
