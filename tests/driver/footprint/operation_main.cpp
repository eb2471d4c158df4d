// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Runs each operation in steps once in QEMU, and one read of a position, against registers in
// memory that answer as a chip does. cycles.py counts each call of a function measured_...(). Ends
// through semihosting: 0x18 with 0x20026 is success.

#include "board.hpp"

namespace {

std::uint8_t memory[256];
bool starts;  // INSTR = 100 was written, and no status has been read since
bool second;  // without AGS an access has two frames

void write(unsigned address, std::uint8_t byte) {
  const bool valid = address == mb4::regs::kAddrSvalidLo || address == mb4::regs::kAddrSvalidHi;
  memory[address] = valid ? memory[address] & byte : byte;
  if (address != mb4::regs::kAddrInstr) return;
  const std::uint8_t instruction = mb4::regs::INSTR::get(byte);
  if (instruction == 4) {
    starts = mb4::regs::AGS::get(byte) != 0 || !second;
    second = starts && mb4::regs::AGS::get(byte) == 0;
  }
  if (mb4::regs::INIT::get(byte) != 0) memory[0x00] = memory[0x20] = 7;
  // Everything ends at once; AGS and HOLDBANK stay.
  memory[address] = byte & (mb4::regs::AGS::kMask | mb4::regs::HOLDBANK::kMask);
}

// All calls that are counted; not inlined.
[[gnu::noinline]] bool measured_plan(BoardDevice& device, mb4::Operation& op, unsigned which,
                                     mb4::Span<std::uint8_t> bytes) {
  mb4::Command command;
  command.ids = 1;
  switch (which) {
    case 0:
      return device.plan_verify(op).ok();
    case 1:
      return device.plan_initialize(op).ok();
    case 2:
      return device.control().plan_write(op, {1, 0}, 0x10, bytes).ok();
    case 3:
      return device.control().plan_read(op, {1, 0}, 0x10, bytes).ok();
    case 4:
      return device.control().plan_command(op, command).ok();
    default:
      return device.automatic().plan_restart(op).ok();
  }
}
[[gnu::noinline]] bool measured_finish(BoardDevice& device, mb4::Operation& op) {
  return device.finish(op, true, 100);
}
// The same with several slaves on a line, where writes guard the configuration.
[[gnu::noinline]] bool measured_write_plan(BoardDevice& device, mb4::Operation& op,
                                           mb4::Span<std::uint8_t> bytes) {
  return device.control().plan_write(op, {1, 0}, 0x10, bytes).ok();
}
[[gnu::noinline]] bool measured_write_finish(BoardDevice& device, mb4::Operation& op) {
  asm volatile("");  // another function than measured_finish()
  return device.finish(op, true, 100);
}
[[gnu::noinline]] bool measured_plan_slave(BoardDevice& device, mb4::CyclicRead& read) {
  return device.automatic().plan_slave<0>(1, read).ok();
}
[[gnu::noinline]] bool measured_finish_slave(BoardDevice& device, mb4::CyclicRead& read) {
  return device.automatic().finish<0>(read, true, 100);
}

bool run(BoardDevice& device, BoardBus& bus, unsigned which) {
  static std::uint8_t bytes[64];
  mb4::Operation op;
  if (!measured_plan(device, op, which, {bytes, sizeof bytes})) return false;
  do {
    if (!op.run(bus)) return false;
  } while (!measured_finish(device, op));
  return op.result().ok();
}

mb4::Config config_of(mb4::SpiCheck check, std::size_t second_slave) {
  mb4::Config config;
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 2'500'000);
  config.spi_check = check;
  config.channels[0].protocol = mb4::Protocol::kBissC;
  if (second_slave == 4) config.channels[1].protocol = mb4::Protocol::kBissC;
  for (const std::size_t slave : {std::size_t{0}, second_slave}) {
    config.slaves[slave].enabled = true;
    config.slaves[slave].data_bits = 28;
  }
  return config;
}

bool run_writes() {
  static std::uint8_t bytes[64];
  BoardBus bus;
  BoardClock clock;
  BoardDevice device(bus, clock);
  mb4::Operation op;
  bool good = device.configure(config_of(mb4::SpiCheck::kFull, 1)).ok();
  for (const bool automatic : {false, true}) {
    good = good && (!automatic || device.automatic().start());
    good = good && measured_write_plan(device, op, {bytes, sizeof bytes});
    do {
      good = good && op.run(bus);
    } while (good && !measured_write_finish(device, op));
    good = good && op.result();
  }
  return good;
}

bool run_all(mb4::SpiCheck check) {
  BoardBus bus;
  BoardClock clock;
  BoardDevice device(bus, clock);
  mb4::Config config = config_of(check, 4);
  bool good = device.configure(config).ok();
  for (const unsigned which : {0U, 1U, 2U, 3U, 4U, 5U, 0U, 2U, 3U, 4U, 5U}) {
    good = run(device, bus, which) && good;
  }
  if (check == mb4::SpiCheck::kCrc) {
    const std::uint8_t word[8] = {0xBF, 0x37, 0xAF, 0x0A, 0, 0, 0, 0x18};
    mb4::CyclicRead read;
    for (unsigned i = 0; i < 2; ++i) {
      for (unsigned k = 0; k < 8; ++k) memory[k] = word[k];
      memory[mb4::regs::kAddrSvalidLo] = 2;
      // Two slaves need MB4_WITH_SEVERAL: configured again with one.
      if (i == 0) {
        config.channels[1] = {};
        config.slaves[4] = {};
        good = good && device.automatic().stop() && device.configure(config) &&
               device.automatic().start();
        memory[mb4::regs::kAddrSvalidLo] = 2;
      }
      good = measured_plan_slave(device, read) && good && read.run(bus);
      good = measured_finish_slave(device, read) && good && read.position() == 0x2ABCDEF;
    }
  }
  return good;
}

}  // namespace

extern "C" {

extern std::uint32_t stack_top;

bool board_transfer(const std::uint8_t* tx, std::uint8_t* rx, std::size_t size) {
  const bool far = tx[0] == 0x02 || tx[0] == 0x03;
  std::size_t at = far ? 2 : 1;
  unsigned address = far ? tx[1] : tx[0] == 0x05 ? 0xF0 : tx[0] == 0x07 ? 0xF4 : 0x00;
  memory[0xF0] = starts ? 0xFB : 0xFF;
  memory[mb4::regs::kAddrVersion] = 0x84;
  memory[mb4::regs::SL1::kAddress] = 0xFF;
  starts = starts && tx[0] != 0x05;
  for (; at < size; ++at, ++address) {
    if (tx[0] == 0x02 || tx[0] == 0x07) {
      write(address, tx[at]);
    } else if (rx != nullptr) {
      rx[at] = memory[address];
    }
  }
  return true;
}

std::uint32_t board_now_us() {
  static std::uint32_t now_us;
  return now_us += 1000;
}

[[noreturn]] void reset() {
  bool good = true;
  for (const mb4::SpiCheck check :
       {mb4::SpiCheck::kOff, mb4::SpiCheck::kFull, mb4::SpiCheck::kCrc}) {
    good = run_all(check) && good;
  }
  good = run_writes() && good;
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
