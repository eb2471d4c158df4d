// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints the position of a BiSS C encoder of 26 bits ten times a second, with the C++17 driver. The
// board needs a C++ standard library; an AVR has none: see PositionAvr.

#include <Arduino.h>
#include <SPI.h>

#include <mb4/mb4.hpp>
#include <mb4/ports/arduino.hpp>

static const uint8_t kSelect = 10;

static void select(bool active) { digitalWrite(kSelect, active ? LOW : HIGH); }

static mb4::ports::ByteBus bus(SPI, SPISettings(5000000, MSBFIRST, SPI_MODE0), select);
static mb4::ports::MicrosClock timer(micros);
static mb4::Device device(bus, timer);
static bool ready = false;

static mb4::Result<void> begin() {
  mb4::Config config;
  config.clock_source = mb4::ClockSource::kInternal;
  config.f_clk_hz = 20'000'000;
  config.ma_hz = mb4::ma_hz_at_most(config.f_clk_hz, 2'500'000);
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;  // 26 of position, nE, nW
  config.slaves[0].crc_polynomial = 0x43;
  return device.configure(config);
}

void setup() {
  Serial.begin(115200);
  digitalWrite(kSelect, HIGH);
  pinMode(kSelect, OUTPUT);
  SPI.begin();
  delay(10);
}

void loop() {
  if (!ready) {
    const mb4::Result<void> done = begin();
    ready = done.ok();
    if (!ready) {
      Serial.println(mb4::to_string(done.error()));
      delay(1000);
      return;
    }
  }
  const mb4::Result<mb4::Reading> frame = device.read_frame();
  if (frame) {
    Serial.println(static_cast<unsigned long>(frame->position));
  } else {
    Serial.println(mb4::to_string(frame.error()));
  }
  delay(100);
}
