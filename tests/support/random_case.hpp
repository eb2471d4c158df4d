// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A random configuration of the chip with slaves, words and line faults that fit it, everything
// decided before the run.
#ifndef TESTS_SUPPORT_RANDOM_CASE_HPP_
#define TESTS_SUPPORT_RANDOM_CASE_HPP_

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/reference/reference.hpp"
#include "tests/support/session.hpp"

namespace mb4test {

// One slave of a chain and the data channel (0..7) that receives it, or sends to it.
struct Sensor {
  unsigned channel = 0;
  unsigned slave = 0;  // number in the simulator, 1..8
  unsigned bits = 0;
  mb4test::CrcChoice crc;
  std::uint16_t start = 0;
  bool actuator = false;
  bool stop_bit = false;             // LSTOP of an actuator
  bool gray = false;                 // of an SSI encoder
  std::vector<std::uint64_t> words;  // by frame; the last one stays. Actuators: none

  // Data bits on the line in frame `frame`, without CRC.
  std::uint64_t sent(std::size_t frame) const {
    return gray ? words[frame] ^ (words[frame] >> 1U) : words[frame];
  }
  unsigned slot_bits() const { return bits + crc.width + (stop_bit ? 1 : 0); }
};

struct RandomCase {
  static constexpr unsigned kFrames = 24;  // with words and faults of their own

  mb4test::Registers registers;
  std::array<bool, 2> used{};                // CFGCH: the line takes part
  std::array<std::vector<Sensor>, 2> lines;  // in chain order, next to SL first
  // Bits after the start bit; for SSI, from the first data bit on.
  std::array<std::array<std::vector<unsigned>, kFrames>, 2> flips;
  std::uint8_t cfgch = 0;
  std::uint8_t chsel = 0;  // lines that CDM is sent on, 0 = line 1
  bool hold_cdm = false;   // HOLDCDM
  bool omits = false;      // AGSERR_ON_HOLDBANK: no frame while a switch is held back
  // A line with actuators is so long that CDS comes after the frame: a CDM that depends on it
  // would cost an actuator's word (docs/choices.md).
  bool late_cds = false;
  bool en_mo = false;
  std::uint8_t mo_busy = 0;
  unsigned freqs = 0;
  std::uint64_t f_clk_hz = 0;
  std::uint8_t channels = 0xFF;  // data channels that the core has
  WordScenario scenario;

  // Bits of both lines in frame number `frame` (from 0), of BiSS C with CDS first; slots of
  // actuators are zeros, lines not used empty.
  mb4test::Lines frame(std::uint64_t frame) const;
  mb4test::Protocol protocol(unsigned line) const { return registers.protocol[line]; }
  // Bits in front of the first word of a line.
  unsigned cds_bits(unsigned line) const {
    return protocol(line) == mb4test::Protocol::kBissC ? 1 : 0;
  }
};

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  std::uint64_t word() { return engine_(); }
  unsigned below(unsigned limit) { return static_cast<unsigned>(engine_() % limit); }
  bool one_in(unsigned n) { return below(n) == 0; }

 private:
  std::mt19937_64 engine_;
};

// What a smaller core can do (decision 44).
struct CoreLimits {
  std::string features = "full";  // [chip] features
  unsigned lines = 2;
  unsigned slaves = 8;  // data channels of a line
  bool free_crc = true;
};

// BiSS C sensors only, or all protocols, MO, actuators, and two lines that differ.
RandomCase make_case(Random& random, bool all_protocols, const CoreLimits& limits = {});

}  // namespace mb4test

#endif  // TESTS_SUPPORT_RANDOM_CASE_HPP_
