// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The ports of microcontrollers and the examples of docs/boards.md, with the Verilated chip behind
// the few functions of each vendor's library that they call.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/driver/ports/port_chip.hpp"

namespace {

// A counter of the simulated time. Reading it takes 100 ns.
struct SimCounter {
  std::uint64_t hz = 1'000'000;
  std::uint64_t offset = 0;
  operator std::uint32_t() const;  // NOLINT: as a register
};

}  // namespace

#define STUB_COUNTER SimCounter
#define main pico_main
#include "examples/mcu/esp_idf/main/main.cpp"
#include "examples/mcu/pico/main.cpp"
#include "examples/mcu/stm32/encoder.cpp"
#undef main

struct spi_inst {
  unsigned hz = 0;
};
struct spi_device_t {
  std::uint32_t hz;
  int select;
};

namespace {

using mb4test::chip;
using mb4test::fails;
using mb4test::forget_rates;
using mb4test::note_rate;
using mb4test::other_hz;
using mb4test::read_hz;

constexpr std::uint32_t kSpiHz = 80'000'000;  // clock of the STM32's SPI, before its prescaler

SimCounter counter;
DWT_Type dwt;
CoreDebug_Type core_debug;
TIM_TypeDef timer;
bool init_fails = false;
unsigned inits = 0;
std::uint32_t stm_hz = 0;  // of the latest HAL_SPI_Init()
spi_inst pico_spi;
unsigned busy = 0;  // how often spi_is_busy() is still to say so
bool selected = false;
spi_device_t* bus_owner = nullptr;
bool with_dma = true;
spi_device_t esp_device;  // that of the example
unsigned delays = 0;

// Ends an example, which has no end of its own.
struct Enough {};

void delay_ms(std::uint32_t ms) {
  chip->advance(ms * 1000 * mb4::sim::kPsPerUs);
  if (++delays == 3) throw Enough{};
}

// The three bits BR of register CR1.
std::uint32_t hz_of(std::uint32_t prescaler) { return kSpiHz / (2U << (prescaler >> 3U)); }

void select(bool active) {
  EXPECT_NE(selected, active);
  selected = active;
  chip->spi().select(active);
}

void bytes(const std::uint8_t* tx, std::uint8_t* rx, std::size_t size, std::uint32_t hz) {
  EXPECT_TRUE(selected);
  note_rate(tx[0], hz);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint8_t received = chip->spi().byte(tx[i]);
    if (rx != nullptr) rx[i] = received;
  }
}

SimCounter::operator std::uint32_t() const {
  chip->advance(100 * mb4::sim::kPsPerNs);
  const auto ns = chip->now() / mb4::sim::kPsPerNs;
  return static_cast<std::uint32_t>(ns / 1000 * (hz / 1'000'000) +
                                    ns % 1000 * (hz / 1'000'000) / 1000 + offset);
}

}  // namespace

SPI_HandleTypeDef hspi1;
TIM_HandleTypeDef htim2;

extern "C" {

GPIO_TypeDef stub_port;
std::uint32_t SystemCoreClock = 168'000'000;
DWT_Type* const DWT = &dwt;
CoreDebug_Type* const CoreDebug = &core_debug;

HAL_StatusTypeDef HAL_SPI_Init(SPI_HandleTypeDef* hspi) {
  EXPECT_FALSE(selected);
  ++inits;
  stm_hz = hz_of(hspi->Init.BaudRatePrescaler);
  return init_fails ? HAL_ERROR : HAL_OK;
}
HAL_StatusTypeDef HAL_SPI_TransmitReceive(SPI_HandleTypeDef* /*hspi*/, std::uint8_t* tx,
                                          std::uint8_t* rx, std::uint16_t size,
                                          std::uint32_t limit_ms) {
  EXPECT_GE(limit_ms, 6U) << "66 bytes at 100 kHz";
  if (fails) return HAL_TIMEOUT;
  bytes(tx, rx, size, stm_hz);
  return HAL_OK;
}
HAL_StatusTypeDef HAL_SPI_Transmit(SPI_HandleTypeDef* hspi, std::uint8_t* tx, std::uint16_t size,
                                   std::uint32_t limit_ms) {
  return HAL_SPI_TransmitReceive(hspi, tx, nullptr, size, limit_ms);
}
void HAL_GPIO_WritePin(GPIO_TypeDef* port, std::uint16_t pin, GPIO_PinState level) {
  EXPECT_EQ(port, &stub_port);
  EXPECT_EQ(pin, GPIO_PIN_4);
  select(level == GPIO_PIN_RESET);
}
void HAL_Delay(std::uint32_t ms) { delay_ms(ms); }

spi_inst_t* const stub_spi0 = &pico_spi;
uint spi_set_baudrate(spi_inst_t* spi, uint hz) {
  EXPECT_FALSE(selected);
  return spi->hz = hz;
}
uint spi_init(spi_inst_t* spi, uint hz) { return spi_set_baudrate(spi, hz); }
int spi_write_read_blocking(spi_inst_t* spi, const std::uint8_t* tx, std::uint8_t* rx,
                            std::size_t size) {
  bytes(tx, rx, size, spi->hz);
  busy = 2;
  return static_cast<int>(size);
}
int spi_write_blocking(spi_inst_t* spi, const std::uint8_t* tx, std::size_t size) {
  return spi_write_read_blocking(spi, tx, nullptr, size);
}
bool spi_is_busy(const spi_inst_t* /*spi*/) { return busy != 0 && busy-- != 0; }
void gpio_init(uint /*gpio*/) {}
void gpio_set_function(uint /*gpio*/, gpio_function /*function*/) {}
void gpio_set_dir(uint gpio, bool out) { EXPECT_TRUE(gpio == 17 && out); }
void gpio_put(uint gpio, bool level) {
  EXPECT_EQ(gpio, 17U);
  EXPECT_EQ(busy, 0U) << "SCLK still runs (I202)";
  if (selected == level) select(!level);
}
std::uint32_t time_us_32() { return counter; }
bool stdio_init_all() { return true; }
void sleep_ms(std::uint32_t ms) { delay_ms(ms); }

esp_err_t spi_bus_initialize(spi_host_device_t /*host*/, const spi_bus_config_t* pins,
                             spi_dma_chan_t dma) {
  EXPECT_EQ(pins->quadwp_io_num, -1);
  with_dma = dma == SPI_DMA_CH_AUTO;
  return ESP_OK;
}
esp_err_t spi_bus_add_device(spi_host_device_t /*host*/,
                             const spi_device_interface_config_t* config,
                             spi_device_handle_t* handle) {
  EXPECT_EQ(config->mode, 0);
  esp_device = {static_cast<std::uint32_t>(config->clock_speed_hz), config->spics_io_num};
  *handle = &esp_device;
  return ESP_OK;
}
esp_err_t spi_device_acquire_bus(spi_device_handle_t device, TickType_t wait) {
  EXPECT_EQ(wait, portMAX_DELAY);
  EXPECT_EQ(bus_owner, nullptr);
  if (fails) return ESP_FAIL;
  bus_owner = device;
  return ESP_OK;
}
void spi_device_release_bus(spi_device_handle_t device) {
  EXPECT_EQ(bus_owner, device);
  EXPECT_FALSE(selected);
  bus_owner = nullptr;
}
esp_err_t spi_device_polling_transmit(spi_device_handle_t device, spi_transaction_t* frame) {
  EXPECT_EQ(frame->length % 8, 0U);
  EXPECT_EQ(frame->rxlength, 0U);
  const std::size_t size = frame->length / 8;
  if (fails || (!with_dma && size > 64)) return ESP_FAIL;
  if (device->select >= 0) select(true);
  EXPECT_TRUE(device->select >= 0 || bus_owner == device);
  bytes(static_cast<const std::uint8_t*>(frame->tx_buffer),
        static_cast<std::uint8_t*>(frame->rx_buffer), size, device->hz);
  if (device->select >= 0) select(false);
  return ESP_OK;
}
esp_err_t gpio_set_level(gpio_num_t pin, std::uint32_t level) {
  EXPECT_EQ(pin, GPIO_NUM_10);
  select(level == 0);
  return ESP_OK;
}
std::int64_t esp_timer_get_time() { return std::uint32_t{counter}; }
void vTaskDelay(TickType_t ticks) { delay_ms(ticks * 10); }

}  // extern "C"

namespace {

class DriverMcu : public mb4test::PortChip {
 protected:
  DriverMcu() {
    counter = {};
    dwt = {};
    dwt.CYCCNT.hz = SystemCoreClock;
    core_debug = {};
    timer.CNT = {};
    timer.ARR = 0xFFFFFFFFU;
    htim2.Instance = &timer;
    hspi1.Init.BaudRatePrescaler = SPI_BAUDRATEPRESCALER_16;
    stm_hz = hz_of(SPI_BAUDRATEPRESCALER_16);
    init_fails = false;
    inits = 0;
    pico_spi = {};
    busy = 0;
    delays = 0;
    selected = false;
    bus_owner = nullptr;
    with_dma = true;
  }

  // What the example prints of three readings.
  template <typename Example>
  std::string printed(Example example) {
    testing::internal::CaptureStdout();
    EXPECT_THROW(example(), Enough);
    return testing::internal::GetCapturedStdout();
  }

  template <typename Bus>
  mb4::Error probe(Bus& bus) {
    mb4::ports::PicoClock clock;
    return mb4::Device<Bus, mb4::ports::PicoClock>(bus, clock).probe().error();
  }
};

const std::string kThreePositions = "44813807\n44813807\n44813807\n";  // 0x2ABCDEF

TEST_F(DriverMcu, Stm32Example_PrintsPositions) {
  EXPECT_EQ(printed([] { encoder(); }), kThreePositions);
  EXPECT_EQ(read_hz, 5'000'000U);
  EXPECT_EQ(inits, 0U);
}

// TIM2 of an F1, L0 or L1 keeps 16 bits of its reload register; CubeMX has 65535 where nobody set
// it.
TEST_F(DriverMcu, Stm32ExampleWithA16BitTimer_SaysSo) {
  timer.ARR = 0xFFFFU;
  testing::internal::CaptureStdout();
  encoder();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "TIM2 does not wrap at 2^32\n");
}

TEST_F(DriverMcu, PicoExample_PrintsPositions) {
  EXPECT_EQ(printed([] { return pico_main(); }), kThreePositions);
  EXPECT_EQ(read_hz, 5'000'000U);
  EXPECT_EQ(other_hz, 10'000'000U);
}

TEST_F(DriverMcu, EspIdfExample_PrintsPositions) {
  EXPECT_EQ(printed([] { app_main(); }), kThreePositions);
  EXPECT_EQ(read_hz, 5'000'000U);
  EXPECT_TRUE(with_dma);
}

// I204 concerns opcode 0x03 only: the other opcodes run at the full rate.
TEST_F(DriverMcu, Stm32At10MHz_OnlyOpcode03IsSlower) {
  hspi1.Init.BaudRatePrescaler = SPI_BAUDRATEPRESCALER_8;
  stm_hz = hz_of(SPI_BAUDRATEPRESCALER_8);
  mb4::ports::HalSpiBus bus(hspi1, &stub_port, GPIO_PIN_4, SPI_BAUDRATEPRESCALER_16);
  mb4::ports::TimerClock clock(htim2);
  read_positions(bus, clock);
  EXPECT_EQ(read_hz, 5'000'000U);
  EXPECT_EQ(other_hz, 10'000'000U);
  EXPECT_GT(inits, 0U);
}

TEST_F(DriverMcu, Stm32HalFails_IsTransport) {
  mb4::ports::HalSpiBus bus(hspi1, &stub_port, GPIO_PIN_4);
  fails = true;
  EXPECT_EQ(probe(bus), mb4::Error::kTransport);
  EXPECT_FALSE(selected);
}

TEST_F(DriverMcu, Stm32InitFails_IsTransport) {
  mb4::ports::HalSpiBus bus(hspi1, &stub_port, GPIO_PIN_4, SPI_BAUDRATEPRESCALER_8);
  init_fails = true;
  EXPECT_EQ(probe(bus), mb4::Error::kTransport);
}

TEST_F(DriverMcu, EspIdfAt10MHz_OnlyOpcode03IsSlowerAndTheBusIsHeld) {
  spi_device_t fast{10'000'000, -1};
  spi_device_t slow{5'000'000, -1};
  mb4::ports::EspIdfBus bus(&fast, &slow, GPIO_NUM_10);
  mb4::ports::EspTimerClock clock;
  read_positions(bus, clock);
  EXPECT_EQ(read_hz, 5'000'000U);
  EXPECT_EQ(other_hz, 10'000'000U);
  EXPECT_EQ(bus_owner, nullptr);
}

TEST_F(DriverMcu, EspIdfFails_IsTransport) {
  spi_device_t device{5'000'000, 10};
  mb4::ports::EspIdfBus hardware(&device);
  mb4::ports::EspIdfBus software(&device, &device, GPIO_NUM_10);
  fails = true;
  EXPECT_EQ(probe(hardware), mb4::Error::kTransport);
  EXPECT_EQ(probe(software), mb4::Error::kTransport);
  EXPECT_FALSE(selected);
}

// The cycle counter runs after start() only, and through its wrap.
TEST_F(DriverMcu, DwtClock_ReadsPositionsOverTheWrap) {
  mb4::ports::DwtClock::start();
  EXPECT_EQ(core_debug.DEMCR, CoreDebug_DEMCR_TRCENA_Msk);
  EXPECT_EQ(dwt.CTRL, DWT_CTRL_CYCCNTENA_Msk);
  dwt.CYCCNT.offset = 0xFFFF'FFFFU - 168U * 50;  // wraps 50 us after the start
  mb4::ports::DwtClock clock;
  mb4::ports::HalSpiBus bus(hspi1, &stub_port, GPIO_PIN_4);
  read_positions(bus, clock);
}

// Why docs/boards.md refuses HAL_GetTick() * 1000: a step of 1 ms looks as if the frame had taken
// so long.
struct TickClock {
  std::uint32_t now_us() {
    chip->advance(100 * mb4::sim::kPsPerNs);
    return static_cast<std::uint32_t>(chip->now() / (1000 * mb4::sim::kPsPerUs) * 1000);
  }
};

template <typename Clock>
unsigned false_timeouts(Clock& clock, mb4::sim::Simulator& simulator) {
  mb4::ports::HalSpiBus bus(hspi1, &stub_port, GPIO_PIN_4);
  mb4::Device<mb4::ports::HalSpiBus, Clock> device(bus, clock);
  EXPECT_TRUE(device.configure(mb4test::encoder(false)).ok());
  unsigned timeouts = 0;
  for (int i = 0; i < 200; ++i) {
    timeouts += device.read_frame().error() == mb4::Error::kTimeout ? 1 : 0;
    simulator.advance(77 * mb4::sim::kPsPerUs);
  }
  return timeouts;
}

TEST_F(DriverMcu, StepsOfAMillisecond_AreFalseTimeouts) {
  TickClock tick;
  EXPECT_GT(false_timeouts(tick, simulator), 0U);
  mb4::ports::TimerClock timer32(htim2);
  EXPECT_EQ(false_timeouts(timer32, simulator), 0U);
}

// Each clock tells the time that has passed, in steps of a microsecond. The counters of 16 and 32
// bits wrap meanwhile. HAL_GetTick() * 1000 would be wrong by up to 1000.
template <typename Clock>
void compare(Clock& clock, mb4::sim::Simulator& simulator) {
  const std::uint32_t begin = clock.now_us();
  const mb4::sim::Time from = simulator.now();
  for (int i = 0; i < 2000; ++i) {
    simulator.advance(static_cast<mb4::sim::Time>(i) * 97 * mb4::sim::kPsPerNs);
    const std::uint32_t us = clock.now_us() - begin;
    const auto passed = static_cast<std::uint32_t>((simulator.now() - from) / mb4::sim::kPsPerUs);
    ASSERT_LE(us, passed + 1);
    ASSERT_GE(us + 1, passed);
  }
}

TEST_F(DriverMcu, Clocks_TellMicrosecondsOverTheWrap) {
  timer.CNT.offset = 0xFFFF'FFFFU - 1000;
  dwt.CYCCNT.offset = 0xFFFF'FFFFU - 168U * 1000;
  counter.offset = 0xFFFF'FFFFU - 1000;
  mb4::ports::TimerClock timer32(htim2);
  mb4::ports::Timer16Clock timer16(htim2);
  mb4::ports::DwtClock cycles;
  mb4::ports::PicoClock pico;
  mb4::ports::EspTimerClock esp;
  compare(timer32, simulator);
  compare(timer16, simulator);
  compare(cycles, simulator);
  compare(pico, simulator);
  compare(esp, simulator);
}

}  // namespace
