// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#ifndef SPI_H_
#define SPI_H_

#include <stdint.h>

struct SPISettings {
  SPISettings(uint32_t clock, uint8_t order, uint8_t mode);
};

struct SpiPort {
  void begin();
  void beginTransaction(SPISettings settings);
  void endTransaction();
  uint8_t transfer(uint8_t value);
};
extern SpiPort SPI;

#endif
