// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The whole driver: eight slaves on two channels, INIT, single and automatic frames, registers,
// commands, the scan, turns.

#include "board.hpp"

extern "C" int firmware() {
  BoardBus bus;
  BoardClock clock;
  BoardDevice device(bus, clock);

  mb4::Config config;
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 2'000'000);
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.channels[1].protocol = mb4::Protocol::kBissC;
  for (mb4::SlaveConfig& slave : config.slaves) {
    slave.enabled = true;
    slave.data_bits = 28;
  }
  mb4::Frame frame;
  if (!device.probe() || !device.reset() || !device.configure(config) || !device.initialize() ||
      !device.read_frame(2) || !device.read_all(frame) || !device.verify() ||
      !device.break_transmission()) {
    return 1;
  }
  std::array<mb4::SlaveIdentity, 2> found{};
  mb4::Command command;
  command.ids = 1;
  const std::array<std::uint8_t, 1> data{1};
  if (!mb4::scan_bus(device, 1, found) || !device.control().send(command) ||
      !device.control().write_registers({1, 0}, 0x60, data) || !device.automatic().start() ||
      !device.automatic().next(frame) || !device.automatic().poll(frame)) {
    return 2;
  }
  const mb4::Result<mb4::Reading> reading = device.automatic().poll_slave(1);
  mb4::PositionTracker tracker(26);
  const mb4::Result<std::int64_t> total = tracker.update(reading ? reading->position : 0);
  return device.automatic().stop() && total ? static_cast<int>(*total) : 3;
}
