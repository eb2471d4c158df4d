// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Positions on Linux, each read one call of the system: the frames of a plan are the messages of
// one ioctl. Prints three positions. `mb4sim spidev` runs it on the simulated chip.

#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>

#include "mb4/mb4.hpp"
#include "mb4/ports/spidev.hpp"

namespace {

constexpr const char* kDevice = "/dev/spidev0.0";
constexpr std::uint32_t kSclkHz = 5'000'000;

constexpr mb4::Config encoder() {
  mb4::Config config;
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 2'500'000);
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;  // 26 position, nE, nW
  config.slaves[0].crc_polynomial = 0x43;
  config.spi_check = mb4::SpiCheck::kCrc;  // one chain a read
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = mb4::frame_period_clk_at_least(config.f_clk_hz, 1'000'000);
  return config;
}
static_assert(mb4::validate(encoder()).ok());

// All frames of a step at once; NCS goes high between them (cs_change).
bool transfer_all(int file, mb4::Steps& steps) {
  spi_ioc_transfer messages[mb4::Steps::kMaxFrames] = {};
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < steps.frames(); ++i) {
    messages[i].tx_buf = reinterpret_cast<std::uintptr_t>(steps.tx(i).data());
    messages[i].rx_buf = reinterpret_cast<std::uintptr_t>(steps.rx(i).data());
    messages[i].len = static_cast<std::uint32_t>(steps.tx(i).size());
    if (steps.rx(i).empty()) messages[i].rx_buf = 0;
    messages[i].speed_hz = kSclkHz;
    messages[i].bits_per_word = 8;
    messages[i].cs_change = i + 1 < steps.frames();
    bytes += messages[i].len;
  }
  return ioctl(file, SPI_IOC_MESSAGE(steps.frames()), messages) == static_cast<int>(bytes);
}

}  // namespace

int main() {
  mb4::ports::SpidevBus bus(kDevice, kSclkHz);
  mb4::ports::MonotonicClock clock;
  mb4::Device device(bus, clock);
  const int file = open(kDevice, O_RDWR | O_CLOEXEC);
  mb4::Result<void> done = device.configure(encoder());
  if (done) done = device.automatic().start();
  mb4::CyclicRead read;
  for (int printed = 0; done && printed < 3;) {
    usleep(1000);
    done = device.automatic().plan_slave(1, read);
    while (done && !device.automatic().finish(read, transfer_all(file, read), clock.now_us())) {
    }
    if (done && read.error() == mb4::Error::kNone) {
      std::printf("%llu\n", static_cast<unsigned long long>(read.position()));
      ++printed;
    } else if (done && read.error() != mb4::Error::kNoData) {
      done = read.error();
    }
  }
  if (!done) std::printf("%s\n", mb4::to_string(done.error()));
  close(file);
  return done ? 0 : 1;
}
