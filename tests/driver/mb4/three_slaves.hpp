// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Three slaves on two channels and their configuration bytes, worked out by hand from the
// datasheet: the encoder of encoder26.hpp and one with 14 bits and CRC5 on channel 1, one with 24
// bits and CRC16 with start value 0x1234 on channel 2 (much like the example of page 26).

#ifndef TESTS_DRIVER_MB4_THREE_SLAVES_HPP_
#define TESTS_DRIVER_MB4_THREE_SLAVES_HPP_

#include "mb4/config.hpp"
#include "tests/driver/mb4/encoder26.hpp"
#include "tests/driver/mb4/strict_bus.hpp"

namespace mb4test {

constexpr mb4::Config three_slaves() {
  mb4::Config config = encoder26();
  config.channels[1].protocol = mb4::Protocol::kBissC;
  config.slaves[1].enabled = true;
  config.slaves[1].data_bits = 14;
  config.slaves[1].crc_polynomial = 0x25;
  config.slaves[4].enabled = true;
  config.slaves[4].data_bits = 24;
  config.slaves[4].flags = mb4::Flags::kNone;
  config.slaves[4].crc_polynomial = 0x190D9;
  config.slaves[4].crc_start = 0x1234;
  return config;
}

// 0xC0..0xEF.
inline Bytes three_configuration(Bytes identity = {0x00, 0x00}) {
  return join({
      {0x5B, 0x06, 0x00, 0x00},  // slave 1
      {0x4D, 0x05, 0x00, 0x00},  // 0xC4: ENSCD2 = 1, 14 - 1; CRC5
      zeros(8),                  // 0xC8..0xCF: slaves 3, 4 not enabled
      {0x57, 0x10, 0x34, 0x12},  // 0xD0: ENSCD5 = 1, 24 - 1; CRC16; start value low byte first
      zeros(12),                 // slaves 6 to 8
      {0x00, 0x00, 0x00, 0x00, 0x00},
      {0xC0, 0xA4, 0x02, 0x7C, 0x00},  // 0xE5..0xE9
      identity,
      {0x11},  // 0xEC: SLAVELOC5 = 1 (bit 4), constant bit 0
      {0x05},  // 0xED: both channels BiSS C
      {0x00, 0x00},
  });
}

// The transfers of configure(three_slaves()).
inline void expect_configure_three(StrictBus& bus) {
  expect_image(bus, three_configuration(),
               join({three_configuration({0x20, 0x84}), {0xFB, 0x00, 0x00, 0x00, 0x00, 0x00}}));
}

// SVALID1 and 2 are bits 1 and 3 of 0xF1, SVALID5 is bit 1 of 0xF2 (table 61).
inline const Bytes kThreeValid{0x00, 0xFB, 0x0A, 0x02, 0x00, 0x00};
inline const Bytes kThreeClear{0x02, 0xF1, 0xF5, 0xFD};

// SCDATA1 from 0x00, SCDATA2 from 0x08, SCDATA5 from 0x20 (table 20): 28, 14 and 24 bits.
inline void expect_three_data(StrictBus& bus) {
  bus.expect_read(kReadData4, kData4);
  bus.expect_read({0x03, 0x08, 0, 0}, {0, 0, 0x37, 0x12});
  bus.expect_read({0x03, 0x20, 0, 0, 0}, {0, 0, 0xEF, 0xCD, 0xAB});
}

}  // namespace mb4test

#endif  // TESTS_DRIVER_MB4_THREE_SLAVES_HPP_
