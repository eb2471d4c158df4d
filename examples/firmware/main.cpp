// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Firmware for a Cortex-M that reads an encoder: single frames, automatic frames as an interrupt
// would take them, registers of the slave. Runs in QEMU against
// `mb4sim bridge`.

#include "board.hpp"
#include "mb4/mb4.hpp"

namespace {

constexpr mb4::Config make_config() {
  mb4::Config config;
  config.f_clk_hz = 20'000'000;
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 2'500'000);
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = mb4::frame_period_clk_at_least(config.f_clk_hz, 100'000);
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;
  config.slaves[0].crc_polynomial = 0x43;
  return config;
}
constexpr mb4::Config kConfig = make_config();
static_assert(mb4::validate(kConfig).ok());

// Says what has failed and ends the program with the error's number.
template <typename T>
void require(const mb4::Result<T>& result, const char* what) {
  if (!result) {
    board::print(what);
    board::print(": ");
    board::print(mb4::to_string(result.error()));
    board::print("\n");
    board::exit(static_cast<std::uint32_t>(result.error()));
  }
}

void print_position(const char* what, const mb4::Reading& reading) {
  board::print(what);
  board::print_hex(reading.position, 7);
  board::print(reading.slave_warning ? " warning\n" : "\n");
}

}  // namespace

int main() {
  board::Uart::open();
  board::Bus bus;
  board::Clock clock;
  mb4::Device<board::Bus, board::Clock> device(bus, clock);

  const mb4::Result<mb4::Identity> identity = device.probe();
  require(identity, "probe");
  board::print("revision ");
  board::print_hex(identity->revision, 2);
  board::print("\n");
  require(device.configure(kConfig), "configure");
  require(device.initialize(), "initialize");

  for (int i = 0; i < 3; ++i) {
    const mb4::Result<mb4::Reading> reading = device.read_frame();
    require(reading, "read_frame");
    print_position("single ", *reading);
  }

  require(device.automatic().start(), "start");
  for (int found = 0; found < 3;) {
    // What a timer's interrupt does; the clock lets time pass meanwhile.
    clock.now_us();
    const mb4::Result<mb4::Reading> reading = device.automatic().poll_slave(1);
    if (reading.error() == mb4::Error::kNoData) {
      continue;
    }
    require(reading, "poll_slave");
    print_position("automatic ", *reading);
    ++found;
  }

  // Registers beside the automatic frames.
  std::array<std::uint8_t, 4> serial{};
  require(device.control().read_registers({1, 0}, 0x44, serial), "read_registers");
  board::print("serial ");
  for (const std::uint8_t byte : serial) {
    board::print_hex(byte, 2);
  }
  board::print("\n");
  require(device.automatic().stop(), "stop");
  board::exit(0);
}
