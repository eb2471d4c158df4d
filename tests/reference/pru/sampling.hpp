// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// When SL is sampled, and which sample of the transition byte is the bit: R-P6, R-P8, R-P11, R-P12a
// and facts 1.3. All that the law leaves to an implementation about the phase of the samples stands
// here, in SamplePhase.
#ifndef TESTS_REFERENCE_PRU_SAMPLING_HPP_
#define TESTS_REFERENCE_PRU_SAMPLING_HPP_

#include <cstdint>

#include "tests/reference/pru/trace.hpp"

namespace pru_judge {

constexpr unsigned kSamples = 8;  // in a period of MA

// A sample is what a flop takes whose clock rises at the instant of the law: MA's flop and the flop
// that takes SL have one clock, so an edge of SL at this very instant is too late.
struct SamplePhase {
  Time offset = 0;                // added to every instant, ps
  bool takes_edge_at_it = false;  // true: an edge of SL at the instant counts
};

// One rate of MA at one clock. The law has 200 and 80 MHz, and 1, 2, 5 and 10 MHz.
struct Rate {
  std::uint32_t clock_hz = 200'000'000;
  unsigned mhz = 1;

  Time clock_ps() const { return 1'000'000'000'000 / clock_hz; }
  // Clocks in a period of MA: 200, 100, 40, 20 or 80, 40, 16, 8.
  unsigned period_clocks() const { return clock_hz / (mhz * 1'000'000U); }
  Time period_ps() const { return period_clocks() * clock_ps(); }
  // Clocks from a rising edge of MA to its sample j = 1..8: floor(j x ratio) (R-P6).
  unsigned sample_clocks(unsigned j) const { return j * period_clocks() / kSamples; }
};

// True for the rates that FREQUENCY may name (R-P5).
bool legal_mhz(unsigned mhz);

// The samples of a frame. Sample number 8 m + i is sample i of byte m, i = 0 the oldest; byte m has
// the eight samples up to and including m periods after rising edge 2 (R-P8).
class Samples {
 public:
  Samples(Rate rate, SamplePhase phase, const Trace& sl, Time rising_edge_2)
      : rate_(rate), phase_(phase), sl_(sl), origin_(rising_edge_2) {}

  Time instant(unsigned number) const;
  bool level(unsigned number) const;
  // Byte m, the oldest sample in bit 7.
  std::uint8_t byte(unsigned m) const;

 private:
  Rate rate_;
  SamplePhase phase_;
  const Trace& sl_;
  Time origin_;
};

// The place of the bit after the oldest sample of the transition byte: 0..7 in this byte, 8..15 in
// the byte after it. From the number of ones (facts 1.3 item 3, R-P11), or 4 behind the first low
// sample (FIRST_LOW, R-P12a). `raw` is not 0xFF.
unsigned place_of(std::uint8_t raw, bool first_low);

// The bit number SP of a place, in the byte in which it lies.
constexpr unsigned bit_number(unsigned place) { return 7 - place % kSamples; }

}  // namespace pru_judge

#endif  // TESTS_REFERENCE_PRU_SAMPLING_HPP_
