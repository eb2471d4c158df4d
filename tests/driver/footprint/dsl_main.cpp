// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Reads a position of the DSL master in QEMU, with memory in the place of its registers. cycles.py
// counts the call of measured_position(). Ends through semihosting: 0x18 with 0x20026 is success.

#include "dsl/device.hpp"

namespace {

using Motor = dsl::Device<dsl::MemoryPort>;

// What an interrupt calls; not inlined.
[[gnu::noinline]] bool measured_position(Motor& motor, dsl::Position& now) {
  return motor.read_position(now) == dsl::Error::kNone;
}

constexpr unsigned kWords = 0x200 / 4;
std::uint32_t registers[kWords];

bool run_all() {
  namespace page = dsl::page;
  registers[page::kAddrPosLo / 4] = 0x89ABCDEF;
  registers[page::kAddrPosHi / 4] = 0xFFFFFFFE;
  registers[page::kAddrVel / 4] = 77;
  registers[page::kAddrFrameCount / 4] = 5;
  registers[page::kAddrFrameStatus / 4] = page::LINKED::kMask | page::VSYNC_SEEN::kMask;
  dsl::MemoryPort port(registers);
  Motor motor(port);
  dsl::Position seen;
  return measured_position(motor, seen) && seen.position == -0x176543211 && seen.speed == 77 &&
         seen.frame == 5;
}

}  // namespace

extern "C" {

extern std::uint32_t stack_top;

[[noreturn]] void reset() {
  const bool good = run_all();
  register std::uint32_t operation asm("r0") = 0x18;
  register std::uint32_t reason asm("r1") = good ? 0x20026 : 0x20023;
  asm volatile("bkpt 0xAB" : : "r"(operation), "r"(reason));
  for (;;) {
  }
}

using Handler = void (*)();
struct Vectors {
  std::uint32_t* stack;
  Handler reset;
};
extern const Vectors vectors;
[[gnu::section(".vectors"), gnu::used]] const Vectors vectors{&stack_top, reset};

}  // extern "C"
