// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The encoder of most driver tests and its configuration bytes, worked out by hand from the tables
// of the datasheet: 26 bits of position, nE, nW, CRC6 0x43 with start value 0, BiSS C on channel 1,
// 20 MHz at pin CLK, MA 2 MHz.

#ifndef TESTS_DRIVER_MB4_ENCODER26_HPP_
#define TESTS_DRIVER_MB4_ENCODER26_HPP_

#include <cstdint>
#include <vector>

#include "mb4/config.hpp"
#include "tests/driver/mb4/strict_bus.hpp"

namespace mb4test {

constexpr mb4::Config encoder26() {
  mb4::Config config;
  config.f_clk_hz = 20'000'000;
  config.ma_hz = 2'000'000;
  config.spi_check = mb4::SpiCheck::kOff;
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;
  config.slaves[0].flags = mb4::Flags::kErrorWarning;
  config.slaves[0].crc_polynomial = 0x43;
  config.slaves[0].crc_start = 0;
  return config;
}

// Position 0x2ABCDEF, nE = nW = 1: the golden word, 28 bits, and its CRC6.
inline constexpr std::uint64_t kRaw = 0xAAF37BF;
inline constexpr std::uint64_t kPosition = 0x2ABCDEF;
inline constexpr std::uint8_t kCrc6 = 0x18;

// 0xC0..0xEF as written. Addresses 0xEA, 0xEB are read-only, `identity` fills them in a read.
inline Bytes configuration(Bytes identity = {0x00, 0x00}) {
  return join({
      {0x5B},              // 0xC0: ENSCD1 = 1 (table 11), SCDLEN1 = 28 - 1 = 0x1B (table 12)
      {0x06},              // 0xC1: SELCRCS1 = 0, SCRCLEN1 = 6 for 0x43 (tables 13, 14)
      {0x00, 0x00},        // 0xC2, 0xC3: SCRCSTART1 = 0x0000 (table 16)
      zeros(28),           // 0xC4..0xDF: slaves 2 to 8 not enabled
      {0x00, 0x00},        // 0xE0, 0xE1: reserved
      {0x00, 0x00, 0x00},  // 0xE2..0xE4: no control communication
      {0xC0},              // 0xE5: CTS = 1, a register; REGVERS = 1, BiSS C (tables 24, 26)
      {0xA4},              // 0xE6: FREQR = 5 (table 36), FREQS = 4: 20 MHz / 2 / 5 (table 35)
      {0x02},              // 0xE7: NOCRC = 1 (table 21), SINGLEBANK = 0 (table 38)
      {0x7C},              // 0xE8: FREQAGS = AGSMIN (table 37; page 32)
      {0x00},              // 0xE9: MO_BUSY = 0
      identity,            // 0xEA, 0xEB: REVISION, VERSION (tables 41, 42)
      {0x01},              // 0xEC: SLAVELOC5 = 0, constant bit 0 (table 6)
      {0x0D},              // 0xED: CFGCH2 = 3 not used, CFGCH1 = 1 BiSS C (table 8)
      {0x00, 0x00},        // 0xEE reserved; 0xEF: ACTnSENS, all sensors (table 17)
  });
}

// What 0xC0..0xF5 read after a good configure(): registers of revision Y,
// idle status 0xFB (pages 34, 35), 0xF1..0xF4 zero, 0xF5 = `interface_byte`.
inline Bytes read_back(std::uint8_t interface_byte = 0x00) {
  return join({configuration({0x20, 0x84}), {0xFB, 0x00, 0x00, 0x00, 0x00}, {interface_byte}});
}

inline constexpr std::size_t kConfigureTransfers = 8;

inline constexpr unsigned kAll = 0;

// The transfers that compare the configuration: `answer`, 0xC0..0xF5, in three parts, and `end`, a
// status, with 0xF5, which comes in one step with the last part. Opcode 0x03 (page 18): data
// follows the address without a dummy byte.
// `look`: SCDATA1, which comes before the status, at SpiCheck::kFull beside automatic frames.
inline std::vector<Transfer> comparison(const Bytes& answer, const Bytes& end,
                                        const Bytes& look = {}) {
  std::vector<Transfer> all;
  for (const auto& [from, size] : {std::pair{0x22, 18}, {0x00, 16}, {0x10, 18}}) {
    const auto begin = answer.begin() + from;
    all.push_back({join({{0x03, static_cast<std::uint8_t>(0xC0 + from)},
                         zeros(static_cast<std::size_t>(size))}),
                   join({zeros(2), Bytes(begin, begin + size)})});
  }
  if (!look.empty()) all.push_back({join({{0x09}, Bytes(8, kFiller)}), join({{0}, look})});
  all.push_back({{0x05, 0, 0, 0, 0, 0, 0}, join({end, {answer.back()}})});
  return all;
}

inline std::vector<std::vector<Transfer>> in_steps(const std::vector<Transfer>& all) {
  return {{all[0]}, {all[1]}, {all.begin() + 2, all.end()}};
}

// The transfers that write `image`, 0xC0..0xEF, and compare it with `answer`, 0xC0..0xF5, in three
// parts each. They end with the part that holds the register at `last`, in the order of comparison.
inline void expect_image(StrictBus& bus, const Bytes& image, const Bytes& answer,
                         std::uint8_t interface_byte = 0x00, unsigned last = kAll,
                         const Bytes& proof = {0x00, 0xFB, 0, 0, 0, 0}) {
  const auto part = [](const Bytes& all, int from, int size) {
    return Bytes(all.begin() + from, all.begin() + from + size);
  };
  // Opcode 0x07 (page 18): BREAK = 1 to 0xF4 (table 47), CLKENI and CFGIF to 0xF5.
  bus.expect_write({0x07, 0x80, interface_byte});
  // Opcode 0x02 (page 18): 0xC0..0xEF, then 0xF0 (read-only) and SVALID 1 to 8 cleared (table 61).
  const Bytes all = join({image, {0x00, 0x00, 0x00}});
  bus.expect_write(join({{0x02, 0xC0}, part(all, 0, 16)}));
  bus.expect_write(join({{0x02, 0xD0}, part(all, 16, 18)}));
  bus.expect_write(join({{0x02, 0xE2}, part(all, 34, 17)}));
  for (const Transfer& one : comparison(answer, proof)) {
    bus.expect_read(one.mosi, one.miso);
    const bool holds = last >= one.mosi[1] && last + 2U < one.mosi[1] + one.mosi.size();
    if (last != kAll && holds && one.mosi[1] != 0xD0) return;  // the status comes with that part
  }
}

// The transfers of configure(encoder26()), or of a configuration that differs from it in the
// register at `address` alone.
inline void expect_configure(StrictBus& bus, std::uint8_t address, std::uint8_t value) {
  Bytes image = configuration();
  Bytes answer = read_back();
  image[address - 0xC0U] = value;
  answer[address - 0xC0U] = value;
  expect_image(bus, image, answer);
}
inline void expect_configure(StrictBus& bus) { expect_configure(bus, 0xC0, configuration()[0]); }

// Status bytes 0xF0..0xF4 after the MISO byte of the opcode, as opcode 0x05 delivers them.
inline Bytes status(std::uint8_t f0, std::uint8_t f1, std::uint8_t f4 = 0x00) {
  return {0x00, f0, f1, 0x00, 0x00, f4};
}
inline const Bytes kReadStatus{0x05, 0x00, 0x00, 0x00, 0x00, 0x00};
// The witness behind readings: 0xF0..0xF4, and 0xF5.
inline const Bytes kReadWitness{0x05, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00};
inline Bytes witness(const Bytes& status, std::uint8_t interface_byte = 0x00) {
  return join({status, {interface_byte}});
}
// The request at rest, a read of register 0. SpiCheck::kFull reads it back with the registers
// behind it, up to 0xEF: those of encoder26(), whose NOCRC (0xE7) is 0 there.
inline const Bytes kRest{0x02, 0xE2, 0x00, 0x00, 0x00, 0xC0};
inline const Bytes kReadRest = join({{0x03, 0xE2}, zeros(14)});
// `answer` holds 0xC0..0xF5, or more, as they read back.
inline Bytes rest_back(const Bytes& answer) {
  return join({zeros(2), Bytes(answer.begin() + 0x22, answer.begin() + 0x30)});
}
inline Bytes answer_at_full() {
  Bytes answer = read_back();
  answer[0xE7 - 0xC0] = 0x00;
  return answer;
}
inline const Bytes kRestBack = rest_back(answer_at_full());
inline void expect_rest_at_full(StrictBus& bus, const Bytes& back = kRestBack) {
  bus.expect_write(kRest).expect_read(kReadRest, back);
}
inline const Bytes kIdleStatus = status(0xFB, 0x00);     // EOT = 1, no error, REGEND = 0
inline const Bytes kRunning = status(0xFA, 0x00, 0x04);  // EOT = 0, INSTR = 010 still there
inline const Bytes kGoodFrame = status(0xFB, 0x02);      // EOT = 1, SVALID1 = 1 (bit 1 of 0xF1)
inline const Bytes kStartFrame{0x07, 0x04};              // INSTR = 010: bits 3:1 of 0xF4 (table 45)
inline const Bytes kBreak{0x07, 0x80};                   // BREAK: bit 7 of 0xF4 (table 47)
inline const Bytes kClearValid1{0x02, 0xF1, 0xFD, 0xFF};  // only SVALID1, bit 1, is written 0
// ... and 0xF4 = AGS: HOLDBANK = 0. 0xF3 between them is read-only.
inline const Bytes kClearValid1AndRelease{0x02, 0xF1, 0xFD, 0xFF, 0xFF, 0x01};
inline const Bytes kReadData4{0x09, 0x00, 0x00, 0x00, 0x00};
inline const Bytes kData4{0x00, 0xBF, 0x37, 0xAF, 0x0A};  // 0x0AAF37BF, low byte first (table 20)

// AGS = 1 at SpiCheck::kFull: what drops the words of both banks, and the proof that it has changed
// nothing else.
inline void expect_start_at_full(StrictBus& bus, const Bytes& clear, const Bytes& answer) {
  bus.expect_write({0x07, 0x01});
  bus.expect_write(clear);
  bus.expect_write(clear);
  bus.expect_read(kReadRest, rest_back(answer));
  bus.expect_read(kReadWitness, witness(status(0xFB, 0x00, 0x01)));
}

}  // namespace mb4test

#endif  // TESTS_DRIVER_MB4_ENCODER26_HPP_
