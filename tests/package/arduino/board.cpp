// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// BOARD SCENARIO N: a board whose SPI ends at a simulated chip; runs setup(), then loop() N times.
#include <cstdio>
#include <cstdlib>

#include "Arduino.h"
#include "SPI.h"
#include "mb4sim.h"

namespace {
mb4sim *simulator = nullptr;
bool selected = false;
bool in_transaction = false;

void fail(const char *what) {
  std::fprintf(stderr, "board: %s\n", what);
  std::exit(1);
}
}  // namespace

SerialPort Serial;
SpiPort SPI;

SPISettings::SPISettings(uint32_t clock, uint8_t order, uint8_t mode) {
  if (clock > 50'000'000 || order != MSBFIRST || mode != SPI_MODE0) {
    fail("the chip takes no such SPI");
  }
}
void SpiPort::begin() {}
void SpiPort::beginTransaction(SPISettings) { in_transaction = true; }
void SpiPort::endTransaction() { in_transaction = false; }
uint8_t SpiPort::transfer(uint8_t value) {
  if (!selected || !in_transaction) {
    fail("a byte without NCS or transaction");
  }
  return mb4sim_spi_byte(simulator, value);
}

void digitalWrite(uint8_t pin, uint8_t level) {
  if (pin != 10) {
    fail("another pin than NCS");
  }
  selected = level == LOW;
  mb4sim_spi_select(simulator, selected ? 1 : 0);
}
void pinMode(uint8_t, uint8_t) {}
// The sketches wait up to a second between two reads. The chip needs no more than a few
// milliseconds of it.
void delay(unsigned long ms) { mb4sim_advance_ns(simulator, 1'000'000ULL * (ms < 20 ? ms : 20)); }
void delayMicroseconds(unsigned int us) { mb4sim_advance_ns(simulator, 1'000ULL * us); }
unsigned long micros() { return static_cast<unsigned long>(mb4sim_time_ns(simulator) / 1000); }

void SerialPort::begin(unsigned long) {}
void SerialPort::println(const char *text) { std::puts(text); }
void SerialPort::println(unsigned long number) { std::printf("%lu\n", number); }

int main(int count, char **arguments) {
  char error[200];
  simulator = count == 3 ? mb4sim_open_file(arguments[1], error, sizeof error) : nullptr;
  if (simulator == nullptr) {
    fail(count == 3 ? error : "BOARD SCENARIO N");
  }
  setup();
  for (int i = std::atoi(arguments[2]); i > 0; --i) {
    loop();
  }
  mb4sim_close(simulator);
  return 0;
}
