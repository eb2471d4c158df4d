// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A random chip for the fuzz of the whole chip: clocks, host, lines, slaves and what happens to
// them, all of it decided before the session, and the configuration that fits the slaves.
#ifndef TESTS_CHIP_FUZZ_CHIP_FUZZ_CHIP_HPP_
#define TESTS_CHIP_FUZZ_CHIP_FUZZ_CHIP_HPP_

#include <array>
#include <cstdint>
#include <vector>

#include "tests/reference/reference.hpp"
#include "tests/support/random_case.hpp"
#include "tests/support/session.hpp"

namespace mb4test {

// The 256 registers as a host has written them.
using RegisterImage = std::array<std::uint8_t, 256>;

struct FuzzSlave {
  unsigned channel = 0;  // data channel 0..7
  unsigned number = 0;   // in the simulator, 1..8
  unsigned bits = 0;
  mb4test::CrcChoice crc;
  std::uint8_t crc_register = 0;
  std::uint16_t crc_start = 0;
  bool gray = false;
  bool actuator = false;
  std::uint64_t first_word = 0;  // the word of frame k is first_word + k * step
  std::uint64_t step = 1;        // odd

  // `word` is the one of a frame before number `frames`.
  bool has_sent(std::uint64_t word, std::uint64_t frames) const;
  std::uint64_t mask() const { return bits == 64 ? ~0ULL : (1ULL << bits) - 1; }
  // Bits of the word and its CRC, as they stand on the line.
  std::string line_bits(std::uint64_t word, std::uint32_t inverted_crc) const;
  std::uint32_t crc_of(std::uint64_t word) const;
};

struct FuzzLine {
  bool present = false;
  mb4test::Protocol protocol = mb4test::Protocol::kUnused;
  bool mo = false;
  std::uint64_t delay_ns = 0;
  std::vector<FuzzSlave> slaves;

  bool has_actuator() const;
};

struct FuzzChip {
  std::uint64_t f_clk_hz = 0;  // 0: pin CLK is not connected
  std::uint64_t f_osc_hz = 0;
  std::vector<std::uint64_t> clocks_hz;  // each that the system clock may have
  bool clk_stops = false;                // at some time, perhaps for ever
  bool clk_stops_for_ever = false;
  bool clk_changes = false;  // pin CLK stops or gets another frequency at some time
  bool parallel = false;
  bool spi2 = false;
  unsigned cycle_ns = 0;  // of a write on the parallel bus
  bool motorola = false;
  bool agserr_on_write = false;  // quirk AGSERR_ON_INSTR_WRITE
  bool agserr_on_hold = false;   // quirk AGSERR_ON_HOLDBANK
  std::array<FuzzLine, 2> lines;
  std::uint64_t faults_end_ns = 0;  // from then on nothing happens to the lines
  RegisterImage fit{};              // 0xC0 to 0xDF, SLAVELOC5, CFGCH, ACTnSENS
  WordScenario scenario;
};

FuzzChip make_fuzz_chip(Random& random, std::uint64_t seed);

}  // namespace mb4test

#endif  // TESTS_CHIP_FUZZ_CHIP_FUZZ_CHIP_HPP_
