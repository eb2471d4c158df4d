// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// One encoder, configured and read by single frames.

#include "board.hpp"

extern "C" int firmware() {
  BoardBus bus;
  BoardClock clock;
  BoardDevice device(bus, clock);

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
