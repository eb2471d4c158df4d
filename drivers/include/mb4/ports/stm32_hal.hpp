// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Port: STM32 with ST's HAL (STM32Cube), all families. Include the family's HAL first: "main.h" of
// CubeMX, or stm32g4xx_hal.h and its like.
//
// HAL_GetTick() is no clock for the driver: it counts milliseconds, the contract allows steps of
// 32 us (enc/bus.hpp). Take a timer or the cycle counter, below.

#ifndef MB4_PORTS_STM32_HAL_HPP_
#define MB4_PORTS_STM32_HAL_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#ifndef HAL_SPI_MODULE_ENABLED
#error "mb4: include the HAL of your STM32, with its SPI module, before mb4/ports/stm32_hal.hpp"
#endif

#include <cstdint>

#include "mb4/bus.hpp"
#include "mb4/ports/counter_us.hpp"
#include "mb4/result.hpp"

namespace mb4::ports {

// One chip at an SPI, blocking. CubeMX: full-duplex master, 8 bits, MSB first, CPOL low, CPHA 1
// edge, NSS by software. The pin of NCS is an output at high before the first transfer. SCK has a
// pull-down, because the HAL switches the SPI off between frames; where the family has
// MasterKeepIOState (H5, H7, U5), it is enabled.
class HalSpiBus {
 public:
  // SCLK is at most 5 MHz (I204).
  HalSpiBus(SPI_HandleTypeDef& spi, GPIO_TypeDef* port, std::uint16_t pin)
      : HalSpiBus(spi, port, pin, spi.Init.BaudRatePrescaler) {}
  // SCLK may be faster: opcode 0x03 alone runs with `read_prescaler`, an SPI_BAUDRATEPRESCALER_n
  // with 5 MHz or less. HAL_SPI_Init() changes the rate before and after such a frame.
  HalSpiBus(SPI_HandleTypeDef& spi, GPIO_TypeDef* port, std::uint16_t pin,
            std::uint32_t read_prescaler)
      : spi_(spi),
        port_(port),
        prescaler_(spi.Init.BaudRatePrescaler),
        read_prescaler_(read_prescaler),
        pin_(pin) {}

  bool transfer(Span<const std::uint8_t> tx, Span<std::uint8_t> rx) {
    if (!run_with(needs_read_sclk(tx) ? read_prescaler_ : prescaler_)) {
      return false;
    }
    // The HAL of some families has no const; what it sends is only read.
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    auto* const out = const_cast<std::uint8_t*>(tx.data());
    const auto size = static_cast<std::uint16_t>(tx.size());
    HAL_GPIO_WritePin(port_, pin_, GPIO_PIN_RESET);
    const HAL_StatusTypeDef done =
        rx.empty() ? HAL_SPI_Transmit(&spi_, out, size, kLimitMs)
                   : HAL_SPI_TransmitReceive(&spi_, out, rx.data(), size, kLimitMs);
    HAL_GPIO_WritePin(port_, pin_, GPIO_PIN_SET);
    return done == HAL_OK;
  }

 private:
  bool run_with(std::uint32_t prescaler) {
    if (spi_.Init.BaudRatePrescaler == prescaler) {
      return true;
    }
    spi_.Init.BaudRatePrescaler = prescaler;
    return HAL_SPI_Init(&spi_) == HAL_OK;
  }

  static constexpr std::uint32_t kLimitMs = 10;  // the longest frame takes 5.3 ms at 100 kHz

  SPI_HandleTypeDef& spi_;
  GPIO_TypeDef* port_;
  std::uint32_t prescaler_;
  std::uint32_t read_prescaler_;
  std::uint16_t pin_;
};

#ifdef HAL_TIM_MODULE_ENABLED
// A timer of 32 bits (often TIM2, TIM5) that counts microseconds: prescaler = its clock in MHz - 1,
// counter period 0xFFFFFFFF, started by HAL_TIM_Base_Start(). It has no state, so several devices
// and interrupts may share it. Ask fits() once: with a timer of 16 bits or another counter period
// it wraps sooner than the driver takes for granted, which shows as false timeouts.
class TimerClock {
 public:
  static constexpr std::uint32_t kStepUs = 1;
  explicit TimerClock(TIM_HandleTypeDef& timer) : timer_(timer) {}
  // The timer wraps at 2^32, as it must. Reload registers of 16 bits read back at most 0xFFFF.
  bool fits() const { return __HAL_TIM_GET_AUTORELOAD(&timer_) == 0xFFFFFFFFU; }
  std::uint32_t now_us() { return __HAL_TIM_GET_COUNTER(&timer_); }

 private:
  TIM_HandleTypeDef& timer_;
};

// The same with a timer of 16 bits, counter period 0xFFFF: it wraps every 65 ms. A call of the
// driver must be shorter; with automatic frames or counts so must what lies between two calls.
class Timer16Clock {
 public:
  static constexpr std::uint32_t kStepUs = 1;
  explicit Timer16Clock(TIM_HandleTypeDef& timer) : timer_(timer) {}
  std::uint32_t now_us() {
    return time_.at(static_cast<std::uint16_t>(__HAL_TIM_GET_COUNTER(&timer_)), 1'000'000);
  }

 private:
  TIM_HandleTypeDef& timer_;
  CounterUs<std::uint16_t> time_;
};
#endif  // HAL_TIM_MODULE_ENABLED

#ifdef DWT_CTRL_CYCCNTENA_Msk
// The cycle counter of Cortex-M3 and above (not M0, M0+). It stands still while the core sleeps,
// and wraps after 2^32 cycles: 25 s at 170 MHz.
class DwtClock {
 public:
  static constexpr std::uint32_t kStepUs = 1;

  // Once, before the first call of the driver.
  static void start() {
#ifdef DCB_DEMCR_TRCENA_Msk  // CMSIS of the newer cores
    DCB->DEMCR = DCB->DEMCR | DCB_DEMCR_TRCENA_Msk;
#else
    CoreDebug->DEMCR = CoreDebug->DEMCR | CoreDebug_DEMCR_TRCENA_Msk;
#endif
#if __CORTEX_M == 7U
    DWT->LAR = 0xC5ACCE55;  // a Cortex-M7 locks the counter
#endif
    DWT->CTRL = DWT->CTRL | DWT_CTRL_CYCCNTENA_Msk;
  }
  std::uint32_t now_us() { return time_.at(DWT->CYCCNT, SystemCoreClock); }

 private:
  CounterUs<std::uint32_t> time_;
};
#endif  // DWT_CTRL_CYCCNTENA_Msk

}  // namespace mb4::ports

#endif  // C++17

#endif  // MB4_PORTS_STM32_HAL_HPP_
