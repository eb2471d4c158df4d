/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What CubeMX calls main.h, and as much of ST's HAL behind it as the port and the example use. Names and
 * signatures as in the manual "Description of STM32F4 HAL and low-layer drivers" (UM1725); those of
 * the other families differ in HAL_CONST. The registers are those of Arm's CMSIS-Core manual.
 * MB4_TEST_CORE is 0 (Cortex-M0+), 4, 7 or 33.
 */
#ifndef TESTS_DRIVER_PORTS_STM32_MAIN_H_
#define TESTS_DRIVER_PORTS_STM32_MAIN_H_

#include <stdint.h>

#define HAL_SPI_MODULE_ENABLED
#define HAL_TIM_MODULE_ENABLED
#ifndef HAL_CONST
#define HAL_CONST
#endif
/* A counter that runs: the test on the host has a type of its own. */
#ifndef STUB_COUNTER
#define STUB_COUNTER volatile uint32_t
#endif
#ifndef MB4_TEST_CORE
#define MB4_TEST_CORE 4
#endif
#if MB4_TEST_CORE == 0
#define __CORTEX_M 0U
#elif MB4_TEST_CORE == 4
#define __CORTEX_M 4U
#elif MB4_TEST_CORE == 7
#define __CORTEX_M 7U
#else
#define __CORTEX_M 33U
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { HAL_OK = 0, HAL_ERROR, HAL_BUSY, HAL_TIMEOUT } HAL_StatusTypeDef;
typedef enum { GPIO_PIN_RESET = 0, GPIO_PIN_SET } GPIO_PinState;
typedef struct {
  volatile uint32_t ODR;
} GPIO_TypeDef;
typedef struct {
  uint32_t BaudRatePrescaler;
} SPI_InitTypeDef;
typedef struct {
  SPI_InitTypeDef Init;
} SPI_HandleTypeDef;
typedef struct {
  STUB_COUNTER CNT;
  volatile uint32_t ARR;
} TIM_TypeDef;
typedef struct {
  TIM_TypeDef* Instance;
} TIM_HandleTypeDef;

#define SPI_BAUDRATEPRESCALER_8 0x10U
#define SPI_BAUDRATEPRESCALER_16 0x18U
#define GPIO_PIN_4 ((uint16_t)0x0010)
#define __HAL_TIM_GET_COUNTER(handle) ((handle)->Instance->CNT)
#define __HAL_TIM_GET_AUTORELOAD(handle) ((handle)->Instance->ARR)

HAL_StatusTypeDef HAL_SPI_Init(SPI_HandleTypeDef* hspi);
HAL_StatusTypeDef HAL_SPI_Transmit(SPI_HandleTypeDef* hspi, HAL_CONST uint8_t* pData, uint16_t Size,
                                   uint32_t Timeout);
HAL_StatusTypeDef HAL_SPI_TransmitReceive(SPI_HandleTypeDef* hspi, HAL_CONST uint8_t* pTxData,
                                          uint8_t* pRxData, uint16_t Size, uint32_t Timeout);
void HAL_GPIO_WritePin(GPIO_TypeDef* GPIOx, uint16_t GPIO_Pin, GPIO_PinState PinState);
void HAL_Delay(uint32_t Delay);

/* A user label of CubeMX for the pin of NCS. The pin is the test's. */
extern GPIO_TypeDef stub_port;
#define MB4_NCS_GPIO_Port (&stub_port)
#define MB4_NCS_Pin GPIO_PIN_4

extern uint32_t SystemCoreClock;

#if MB4_TEST_CORE != 0
typedef struct {
  volatile uint32_t CTRL;
  STUB_COUNTER CYCCNT;
#if MB4_TEST_CORE == 7
  volatile uint32_t LAR;
#endif
} DWT_Type;
extern DWT_Type* const DWT;
#define DWT_CTRL_CYCCNTENA_Msk 1UL
typedef struct {
  volatile uint32_t DEMCR;
} CoreDebug_Type;
#if MB4_TEST_CORE == 33
extern CoreDebug_Type* const DCB;
#define DCB_DEMCR_TRCENA_Msk (1UL << 24)
#else
extern CoreDebug_Type* const CoreDebug;
#define CoreDebug_DEMCR_TRCENA_Msk (1UL << 24)
#endif
#endif

#ifdef __cplusplus
}
#endif

#endif
