// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints the position of a BiSS C encoder of 26 bits ten times a second. Any board, AVR too:
// encoder.c holds the work.

#include <Arduino.h>
#include <SPI.h>

#include "encoder.h"

static const uint8_t kSelect = 10;

static void transfer(const uint8_t *tx, uint8_t *rx, uint8_t size) {
  SPI.beginTransaction(SPISettings(4000000, MSBFIRST, SPI_MODE0));
  digitalWrite(kSelect, LOW);
  for (uint8_t i = 0; i < size; ++i) {
    const uint8_t received = SPI.transfer(tx[i]);
    if (rx != nullptr) {
      rx[i] = received;
    }
  }
  digitalWrite(kSelect, HIGH);
  SPI.endTransaction();
}

void setup() {
  Serial.begin(115200);
  digitalWrite(kSelect, HIGH);
  pinMode(kSelect, OUTPUT);
  SPI.begin();
  delay(10);
  encoder_begin(transfer, micros());
}

void loop() {
  uint32_t position = 0;
  switch (encoder_read(micros(), &position)) {
    case ENCODER_GOOD:
      Serial.println(position);
      break;
    case ENCODER_SLAVE_ERROR:
      Serial.println("the encoder reports an error");
      break;
    case ENCODER_ERROR:
      Serial.println("error");
      break;
    default:
      Serial.println("nothing new");
      break;
  }
  delay(100);
}
