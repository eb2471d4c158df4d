// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The ports, with the Verilated chip behind the interface that each of them talks to: the system
// calls of Linux, Arduino's SPI object, Zephyr's spi_transceive_dt().

#include <errno.h>
#include <gtest/gtest.h>
#include <stdarg.h>
#include <zephyr/drivers/spi.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "mb4/ports/arduino.hpp"
#include "mb4/ports/spidev.hpp"
#include "mb4/ports/zephyr.hpp"
#include "tests/driver/rtl/rtl_calls.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

mb4::sim::Simulator* chip = nullptr;  // what the wrapped calls below talk to
bool fails = false;
constexpr int kFile = 12345;

std::vector<std::uint8_t> exchange(const std::uint8_t* tx, std::size_t size) {
  std::vector<std::uint8_t> rx(size);
  chip->spi().transfer(std::span(tx, size), rx);
  return rx;
}

class DriverPort : public testing::Test {
 protected:
  DriverPort() : simulator(mb4::sim::parse_scenario(mb4test::kEncoder, "test.toml")) {
    chip = &simulator;
    fails = false;
  }
  ~DriverPort() override { chip = nullptr; }

  template <typename Bus, typename Clock>
  void read_positions(Bus& bus, Clock& clock) {
    mb4::Device<Bus, Clock> device(bus, clock);
    ASSERT_TRUE(device.probe().ok());
    ASSERT_TRUE(device.configure(mb4test::encoder(false)).ok());
    for (int i = 0; i < 3; ++i) {
      const mb4::Result<mb4::Reading> reading = device.read_frame();
      ASSERT_TRUE(reading.ok());
      EXPECT_EQ(reading->position, 0x2ABCDEFU);
    }
    std::array<std::uint8_t, 4> serial{};
    ASSERT_TRUE(device.control().read_registers({1, 0}, 0x44, serial).ok());
    EXPECT_EQ(serial[1], 0xD9);
  }

  mb4::sim::Simulator simulator;
};

}  // namespace

// The linker sends the port's system calls here (--wrap).
extern "C" {

int __real_open(const char* path, int flags, ...);
int __wrap_open(const char* path, int flags, ...) {
  if (std::strncmp(path, "/dev/spidev", 11) == 0) {
    if (fails) errno = ENOENT;
    return fails ? -1 : kFile;
  }
  va_list rest;
  va_start(rest, flags);
  const int mode = va_arg(rest, int);
  va_end(rest);
  return __real_open(path, flags, mode);
}

int __real_close(int file);
int __wrap_close(int file) { return file == kFile ? 0 : __real_close(file); }

int __wrap_ioctl(int file, unsigned long request, ...) {
  va_list rest;
  va_start(rest, request);
  void* const argument = va_arg(rest, void*);
  va_end(rest);
  if (file != kFile || fails) return -1;
  if (request == SPI_IOC_WR_MODE) {
    return *static_cast<std::uint8_t*>(argument) == SPI_MODE_0 ? 0 : -1;
  }
  const auto* message = static_cast<const spi_ioc_transfer*>(argument);
  if (request != SPI_IOC_MESSAGE(1) || message->speed_hz > 5'000'000) return -1;
  const auto rx = exchange(reinterpret_cast<const std::uint8_t*>(message->tx_buf), message->len);
  if (message->rx_buf != 0) {
    std::memcpy(reinterpret_cast<void*>(message->rx_buf), rx.data(), rx.size());
  }
  return static_cast<int>(message->len);
}

int spi_transceive_dt(const spi_dt_spec* spec, const spi_buf_set* tx, const spi_buf_set* rx) {
  if (spec->bus != chip || fails) return -EIO;
  const auto received =
      exchange(static_cast<const std::uint8_t*>(tx->buffers[0].buf), tx->buffers[0].len);
  if (rx != nullptr) std::memcpy(rx->buffers[0].buf, received.data(), rx->buffers[0].len);
  return 0;
}

std::uint32_t k_cycle_get_32(void) {
  chip->advance(100 * mb4::sim::kPsPerNs);
  // Wraps every 268 s at 16 MHz; begins shortly before.
  return static_cast<std::uint32_t>(chip->now() / (mb4::sim::kPsPerUs / 16)) - 1000;
}

}  // extern "C"

namespace {

TEST_F(DriverPort, Spidev_ReadsPositions) {
  mb4::ports::SpidevBus bus("/dev/spidev0.0");
  ASSERT_TRUE(bus.ready());
  mb4::tool::SimClock clock(simulator);
  read_positions(bus, clock);
  mb4::ports::MonotonicClock monotonic;
  const std::uint32_t before = monotonic.now_us();
  EXPECT_LT(monotonic.now_us() - before, 10'000'000U);
}

TEST_F(DriverPort, SpidevMissing_IsNotReadyAndTransport) {
  fails = true;
  mb4::ports::SpidevBus bus("/dev/spidev9.9");
  EXPECT_FALSE(bus.ready());
  EXPECT_EQ(errno, ENOENT);
  mb4::tool::SimClock clock(simulator);
  mb4::Device<mb4::ports::SpidevBus, mb4::tool::SimClock> device(bus, clock);
  EXPECT_EQ(device.probe().error(), mb4::Error::kTransport);
}

TEST_F(DriverPort, SpidevIoctlFails_IsTransport) {
  mb4::ports::SpidevBus bus("/dev/spidev0.0");
  fails = true;
  mb4::tool::SimClock clock(simulator);
  mb4::Device<mb4::ports::SpidevBus, mb4::tool::SimClock> device(bus, clock);
  EXPECT_EQ(device.probe().error(), mb4::Error::kTransport);
}

// Arduino's SPIClass, byte by byte.
struct SpiClass {
  bool in_transaction = false;
  bool selected = false;

  void beginTransaction(int settings) {
    EXPECT_EQ(settings, 5'000'000);
    in_transaction = true;
  }
  void endTransaction() {
    EXPECT_FALSE(selected);
    in_transaction = false;
  }
  std::uint8_t transfer(std::uint8_t mosi) {
    EXPECT_TRUE(in_transaction && selected);
    return chip->spi().byte(mosi);
  }
};

TEST_F(DriverPort, ArduinoBytes_ReadPositions) {
  SpiClass spi;
  mb4::ports::ByteBus bus(spi, 5'000'000, [&](bool active) {
    spi.selected = active;
    chip->spi().select(active);
  });
  mb4::ports::MicrosClock clock([&] {
    chip->advance(100 * mb4::sim::kPsPerNs);
    return static_cast<unsigned long>(chip->now() / mb4::sim::kPsPerUs);
  });
  read_positions(bus, clock);
}

TEST_F(DriverPort, ZephyrTransceive_ReadsPositionsOverTheCounterWrap) {
  const spi_dt_spec spec{chip};
  mb4::ports::ZephyrBus bus(spec);
  mb4::ports::ZephyrClock clock;
  read_positions(bus, clock);
  std::uint32_t last = clock.now_us();
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t now = clock.now_us();
    EXPECT_LE(now - last, 2U);
    last = now;
  }
  fails = true;
  mb4::Device<mb4::ports::ZephyrBus, mb4::ports::ZephyrClock> device(bus, clock);
  EXPECT_EQ(device.probe().error(), mb4::Error::kTransport);
}

}  // namespace
