// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What the sketches use of Arduino. board.cpp brings it on a simulated chip; a compiler for a target
// needs this file alone.
#ifndef ARDUINO_H_
#define ARDUINO_H_

#include <stdint.h>

enum { LOW, HIGH };
enum { INPUT, OUTPUT };
enum { MSBFIRST = 1, SPI_MODE0 = 0 };

void setup();
void loop();
void digitalWrite(uint8_t pin, uint8_t level);
void pinMode(uint8_t pin, uint8_t mode);
void delay(unsigned long ms);
void delayMicroseconds(unsigned int us);
unsigned long micros();

struct SerialPort {
  void begin(unsigned long baud);
  void println(const char *text);
  void println(unsigned long number);
};
extern SerialPort Serial;

#endif
