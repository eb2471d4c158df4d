// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A random configuration of the chip with slaves, words and line faults that fit it, everything
// decided before the run.
#ifndef MB4_TESTS_CHIP_RANDOM_CASE_HPP_
#define MB4_TESTS_CHIP_RANDOM_CASE_HPP_

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "reference.hpp"
#include "session.hpp"

namespace mb4test {

// One slave of a chain and the data channel (0..7) that receives it.
struct Sensor {
  unsigned channel = 0;
  unsigned slave = 0;  // number in the simulator, 1..8
  unsigned bits = 0;
  mb4ref::CrcChoice crc;
  std::uint16_t start = 0;
  std::vector<std::uint64_t> words;  // by frame; the last one stays
};

struct RandomCase {
  static constexpr unsigned kFrames = 24;  // with words and faults of their own

  mb4ref::Registers registers;
  std::array<bool, 2> used{};                // CFGCH: the line takes part
  std::array<std::vector<Sensor>, 2> lines;  // in chain order, next to SL first
  std::array<std::array<std::vector<unsigned>, kFrames>, 2> flips;  // bits behind the start bit
  std::uint8_t cfgch = 0;
  std::uint8_t chsel = 0;  // lines that CDM is sent on, 0 = line 1
  bool hold_cdm = false;   // HOLDCDM
  unsigned freqs = 0;
  std::uint64_t f_clk_hz = 0;
  WordScenario scenario;

  // Bits of both lines in frame number `frame` (from 0), CDS first; lines not used are empty.
  mb4ref::Lines frame(std::uint64_t frame) const;
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

RandomCase make_case(Random& random);

}  // namespace mb4test

#endif  // MB4_TESTS_CHIP_RANDOM_CASE_HPP_
