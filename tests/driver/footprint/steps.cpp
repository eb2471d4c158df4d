// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A drive without a blocking call after configure(): all operations in steps, and positions.

#include "board.hpp"

struct Work {
  const mb4::Config& config;
  mb4::Command command;
  mb4::SlaveAddress address;
  mb4::Span<std::uint8_t> bytes;
  mb4::Operation& operation;
  mb4::CyclicRead& read;
  std::uint8_t slave;
};

// The linker keeps it: what a Device reaches through its pointers counts.
extern "C" BoardDevice firmware_open(BoardBus& bus, BoardClock& clock) {
  return BoardDevice(bus, clock);
}

extern "C" bool firmware(BoardDevice& device, Work& work, unsigned what) {
  mb4::Operation& op = work.operation;
  mb4::Control<BoardBus, BoardClock> control = device.control();
  switch (what) {
    case 0:
      return device.configure(work.config).ok();
    case 1:
      return device.automatic().plan_start(op).ok();
    case 2:
      return device.automatic().plan_restart(op).ok();
    case 3:
      return device.plan_verify(op).ok();
    case 4:
      return device.plan_initialize(op).ok();
    case 5:
      return control.plan_read(op, work.address, work.slave, work.bytes).ok();
    case 6:
      return control.plan_write(op, work.address, work.slave, work.bytes).ok();
    case 7:
      return control.plan_command(op, work.command).ok();
    case 8:
      return device.automatic().plan_slave<0>(work.slave, work.read).ok();
    case 9:
      return device.automatic().finish<0>(work.read, true, board_now_us());
    default:
      return device.finish(op, true, board_now_us());
  }
}
