// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The calls of a small firmware, so that their size and the symbols they need can be looked at.

#include "mb4/mb4.hpp"

namespace {

struct BoardBus {
  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx);
};
struct BoardClock {
  std::uint32_t now_us();
};

// Stand-ins for a SPI data register and a timer.
volatile std::uint8_t spi_data;
volatile std::uint32_t timer_us;

bool BoardBus::transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
  for (std::size_t i = 0; i < tx.size(); ++i) {
    spi_data = tx[i];
    const std::uint8_t received = spi_data;
    if (!rx.empty()) {
      rx[i] = received;
    }
  }
  return true;
}

std::uint32_t BoardClock::now_us() { return timer_us; }

}  // namespace

#ifdef MB4_FOOTPRINT_ALL
// Eight slaves on two channels, automatic frames, registers, commands and the scan.
extern "C" int firmware() {
  BoardBus bus;
  BoardClock clock;
  mb4::Device<BoardBus, BoardClock> device(bus, clock);

  mb4::Config config;
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 2'000'000);
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.channels[1].protocol = mb4::Protocol::kBissC;
  for (mb4::SlaveConfig& slave : config.slaves) {
    slave.enabled = true;
    slave.data_bits = 28;
  }
  mb4::Frame frame;
  if (!device.probe() || !device.configure(config) || !device.read_all(frame)) {
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
  return frame[1] ? static_cast<int>(frame[1]->position) : 3;
}
#else
// One encoder, single frames.
extern "C" int firmware() {
  BoardBus bus;
  BoardClock clock;
  mb4::Device<BoardBus, BoardClock> device(bus, clock);

  mb4::Config config;
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 2'000'000);
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;

  if (!device.probe() || !device.configure(config)) {
    return 1;
  }
  const mb4::Result<mb4::Reading> reading = device.read_frame();
  if (!reading) {
    return device.break_transmission() ? 2 : 3;
  }
  return static_cast<int>(reading->position);
}
#endif
