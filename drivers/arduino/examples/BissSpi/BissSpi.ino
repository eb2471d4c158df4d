// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints the positions of two BiSS C encoders of 26 bits ten times a second, read through biss_spi in
// an FPGA with a clock of 48 MHz. Any board, AVR too.

#include <Arduino.h>
#include <SPI.h>
#include <biss_spi.h>

static const uint8_t kSelect = 10;
static const uint32_t kChannels = 2;
static const uint32_t kMaDivider = 12;  // 48 MHz / 24 = 2 MHz
static const uint32_t kBits = 26;

static int transfer(void *, const uint8_t *tx, uint8_t *rx, uint8_t size) {
  SPI.beginTransaction(SPISettings(4000000, MSBFIRST, SPI_MODE0));
  digitalWrite(kSelect, LOW);
  for (uint8_t i = 0; i < size; ++i) {
    rx[i] = SPI.transfer(tx[i]);
  }
  digitalWrite(kSelect, HIGH);
  SPI.endTransaction();
  return 0;
}

static biss_spi master = {transfer, nullptr, BISS_SPI_VOID};

void setup() {
  Serial.begin(115200);
  digitalWrite(kSelect, HIGH);
  pinMode(kSelect, OUTPUT);
  SPI.begin();
  delay(10);
}

void loop() {
  // At power-on, and after each reset of the FPGA.
  if ((master.answer & BISS_SPI_VOID) != 0) {
    biss_spi_configure(&master, (1U << kChannels) - 1U, kMaDivider, kBits);
    delay(1);
  }
  biss_spi_request(&master);
  delayMicroseconds(200);
  for (uint32_t channel = 0; channel < kChannels; ++channel) {
    biss_spi_reading reading;
    switch (biss_spi_position(&master, channel, &reading)) {
      case BISS_SPI_OK:
        Serial.println(reading.position);
        break;
      case BISS_SPI_SLAVE_ERROR:
        Serial.println("the encoder reports an error");
        break;
      case BISS_SPI_NO_DATA:
        Serial.println("no word");
        break;
      default:
        Serial.println("error");
        break;
    }
  }
  delay(100);
}
