// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The ports, with the Verilated chip behind the interface that each of them talks to: the system
// calls of Linux, Arduino's SPI object, Zephyr's spi_transceive_dt().

#include <errno.h>
#include <gtest/gtest.h>
#include <stdarg.h>
#include <zephyr/drivers/spi.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "mb4/ports/arduino.hpp"
#include "mb4/ports/spidev.hpp"
#include "mb4/ports/zephyr.hpp"
#include "tests/driver/ports/port_chip.hpp"

namespace {

namespace reg = mb4::regs;

using mb4test::chip;
using mb4test::exchange;
using mb4test::fails;
using mb4test::note_rate;
using mb4test::other_hz;
using mb4test::read_hz;

bool refuses_mode = false;
std::uint64_t cycle_hz = 16'000'000;  // Zephyr's cycle counter
mb4::sim::Time break_ends = 0;        // of the last BREAK; 0: a later frame has begun
mb4::sim::Time shortest_pause = 0;    // from the end of a BREAK to the next frame
constexpr int kFile = 12345;

class DriverPort : public mb4test::PortChip {
 protected:
  DriverPort() {
    refuses_mode = false;
    cycle_hz = 16'000'000;
    break_ends = 0;
    shortest_pause = mb4::sim::kPsPerSecond;
  }
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
    return *static_cast<std::uint8_t*>(argument) == SPI_MODE_0 && !refuses_mode ? 0 : -1;
  }
  const auto* message = static_cast<const spi_ioc_transfer*>(argument);
  if (request != SPI_IOC_MESSAGE(1)) return -1;
  note_rate(*reinterpret_cast<const std::uint8_t*>(message->tx_buf), message->speed_hz);
  const auto rx = exchange(reinterpret_cast<const std::uint8_t*>(message->tx_buf), message->len);
  if (message->rx_buf != 0) {
    std::memcpy(reinterpret_cast<void*>(message->rx_buf), rx.data(), rx.size());
  }
  return static_cast<int>(message->len);
}

int spi_transceive_dt(const spi_dt_spec* spec, const spi_buf_set* tx, const spi_buf_set* rx) {
  if (spec->bus != chip || fails) return -EIO;
  const auto* const bytes = static_cast<const std::uint8_t*>(tx->buffers[0].buf);
  // MA moves by an instruction only: the status behind a BREAK may follow at once.
  const bool instructs = bytes[0] == reg::kSpiOpcodeWriteInstruction;
  const bool breaks = instructs && bytes[1] == reg::BREAK::kMask;
  note_rate(bytes[0], spec->config.frequency);
  if (break_ends != 0 && instructs && !breaks) {
    shortest_pause = std::min(shortest_pause, chip->now() - break_ends);
  }
  const auto received = exchange(bytes, tx->buffers[0].len);
  if (instructs) break_ends = breaks ? chip->now() : 0;
  if (rx != nullptr) std::memcpy(rx->buffers[0].buf, received.data(), rx->buffers[0].len);
  return 0;
}

std::uint32_t k_cycle_get_32(void) {
  chip->advance(100 * mb4::sim::kPsPerNs);
  // Begins shortly before its wrap.
  return static_cast<std::uint32_t>(chip->now() / 1000 * cycle_hz / 1'000'000'000) - 1000;
}
std::uint32_t sys_clock_hw_cycles_per_sec(void) { return static_cast<std::uint32_t>(cycle_hz); }

}  // extern "C"

namespace {

TEST_F(DriverPort, Spidev_ReadsPositions) {
  mb4::ports::SpidevBus bus("/dev/spidev0.0");
  ASSERT_TRUE(bus.ready());
  mb4::tool::SimClock clock(simulator);
  read_positions(bus, clock);
  EXPECT_EQ(read_hz, 5'000'000U);
  EXPECT_EQ(other_hz, 5'000'000U);
  mb4::ports::MonotonicClock monotonic;
  const std::uint32_t before = monotonic.now_us();
  EXPECT_LT(monotonic.now_us() - before, 10'000'000U);
}

// I204 concerns opcode 0x03 only: SCLK high for 100 ns behind the address byte.
TEST_F(DriverPort, SpidevAt10MHz_OnlyOpcode03IsSlower) {
  mb4::ports::SpidevBus bus("/dev/spidev0.0", 10'000'000);
  mb4::tool::SimClock clock(simulator);
  read_positions(bus, clock);
  EXPECT_EQ(read_hz, 5'000'000U);
  EXPECT_EQ(other_hz, 10'000'000U);
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

// A device file without SPI mode 0.
TEST_F(DriverPort, SpidevWithoutMode0_IsNotReadyAndTransport) {
  refuses_mode = true;
  mb4::ports::SpidevBus bus("/dev/spidev0.0");
  EXPECT_FALSE(bus.ready());
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
  bool first = false;
  std::uint32_t hz = 0;

  void beginTransaction(std::uint32_t settings) {
    hz = settings;
    first = true;
    in_transaction = true;
  }
  void endTransaction() {
    EXPECT_FALSE(selected);
    in_transaction = false;
  }
  std::uint8_t transfer(std::uint8_t mosi) {
    EXPECT_TRUE(in_transaction && selected);
    if (first) note_rate(mosi, hz);
    first = false;
    return chip->spi().byte(mosi);
  }
};

TEST_F(DriverPort, ArduinoBytes_ReadPositions) {
  SpiClass spi;
  const auto select = [&](bool active) {
    spi.selected = active;
    chip->spi().select(active);
  };
  mb4::ports::ByteBus bus(spi, 5'000'000U, select);
  mb4::ports::MicrosClock clock([&] {
    chip->advance(100 * mb4::sim::kPsPerNs);
    return static_cast<unsigned long>(chip->now() / mb4::sim::kPsPerUs);
  });
  read_positions(bus, clock);
  EXPECT_EQ(read_hz, 5'000'000U);
  EXPECT_EQ(other_hz, 5'000'000U);
  mb4::ports::ByteBus fast(spi, 10'000'000U, 5'000'000U, select);
  read_hz = 0;
  other_hz = ~0U;
  read_positions(fast, clock);
  EXPECT_EQ(read_hz, 5'000'000U);
  EXPECT_EQ(other_hz, 10'000'000U);
}

TEST_F(DriverPort, ZephyrTransceive_ReadsPositionsOverTheCounterWrap) {
  const spi_dt_spec spec{chip, {5'000'000}};
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

// The bus keeps what it needs of the spec, which may be a temporary; page 11 as for spidev.
TEST_F(DriverPort, ZephyrSpecGoneAndAt10MHz_ReadsPositions) {
  auto spec = std::make_unique<spi_dt_spec>(spi_dt_spec{chip, {10'000'000}});
  mb4::ports::ZephyrBus bus(*spec);
  spec->bus = nullptr;
  spec.reset();
  mb4::ports::ZephyrClock clock;
  read_positions(bus, clock);
  EXPECT_EQ(read_hz, 5'000'000U);
  EXPECT_EQ(other_hz, 10'000'000U);
}

// Cycle counters as boards have them: 32 kHz is the slowest that keeps the contract of a clock.
class DriverPortCycles : public DriverPort, public testing::WithParamInterface<std::uint32_t> {};

TEST_P(DriverPortCycles, Reads_NoFalseTimeoutAndNoShortPause) {
  cycle_hz = GetParam();
  const spi_dt_spec spec{chip, {5'000'000}};
  mb4::ports::ZephyrBus bus(spec);
  mb4::ports::ZephyrClock clock;
  mb4::Device<mb4::ports::ZephyrBus, mb4::ports::ZephyrClock> device(bus, clock);
  mb4::Config config = mb4test::encoder(false);
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 200'000);
  ASSERT_TRUE(device.configure(config).ok());
  shortest_pause = mb4::sim::kPsPerSecond;  // configure() makes none
  unsigned timeouts = 0;
  for (int i = 0; i < 100; ++i) {
    if (i % 4 == 3) {
      ASSERT_TRUE(device.break_transmission().ok());
    }
    timeouts += device.read_frame().error() == mb4::Error::kTimeout ? 1 : 0;
    simulator.advance(7'777 * mb4::sim::kPsPerNs);
  }
  EXPECT_EQ(timeouts, 0U);
  EXPECT_GE(shortest_pause, 100 * mb4::sim::kPsPerUs);
  EXPECT_LT(shortest_pause, mb4::sim::kPsPerSecond) << "no pause was measured";
}

TEST_P(DriverPortCycles, Microseconds_AreRightAfterManyReadings) {
  cycle_hz = GetParam();
  mb4::ports::ZephyrClock clock;
  const std::uint32_t begin = clock.now_us();
  const mb4::sim::Time from = simulator.now();
  for (int i = 0; i < 20'000; ++i) {
    clock.now_us();
    if (i % 10 == 0) simulator.advance(77 * mb4::sim::kPsPerUs);
  }
  const auto us = static_cast<std::int64_t>((simulator.now() - from) / mb4::sim::kPsPerUs);
  // One cycle, and the rounding to whole microseconds.
  const auto limit = static_cast<std::int64_t>(1'000'000 / cycle_hz) + 2;
  EXPECT_LE(std::abs(static_cast<std::int64_t>(clock.now_us() - begin) - us), limit) << us;
}

INSTANTIATE_TEST_SUITE_P(Hz, DriverPortCycles,
                         testing::Values(32'000U, 32'768U, 1'000'000U, 12'288'000U, 16'000'000U,
                                         72'000'000U, 600'000'000U),
                         [](const auto& test) { return std::to_string(test.param); });

}  // namespace
