// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#include "tests/reference/pru/sampling.hpp"

#include <bitset>

namespace pru_judge {

bool legal_mhz(unsigned mhz) { return mhz == 1 || mhz == 2 || mhz == 5 || mhz == 10; }

Time Samples::instant(unsigned number) const {
  const Time byte = number / kSamples;
  const unsigned j = number % kSamples + 1;
  return origin_ + (byte - 1) * rate_.period_ps() + rate_.sample_clocks(j) * rate_.clock_ps() +
         phase_.offset;
}

bool Samples::level(unsigned number) const {
  return phase_.takes_edge_at_it ? sl_.from(instant(number)) : sl_.before(instant(number));
}

std::uint8_t Samples::byte(unsigned m) const {
  unsigned byte = 0;
  for (unsigned i = 0; i < kSamples; ++i) byte = byte << 1 | (level(m * kSamples + i) ? 1U : 0U);
  return static_cast<std::uint8_t>(byte);
}

unsigned place_of(std::uint8_t raw, bool first_low) {
  const std::bitset<kSamples> byte(raw);
  if (first_low) {
    unsigned oldest = 0;
    while (byte[kSamples - 1 - oldest]) ++oldest;
    return oldest + 4;
  }
  // X > 4: bit X - 4 of this byte. X < 4: bit 8 - (4 - X) of the next one. X = 4: bit 0 of this.
  const unsigned x = 7 - static_cast<unsigned>(byte.count());
  return x >= 4 ? 7 - (x - 4) : kSamples + 7 - (8 - (4 - x));
}

}  // namespace pru_judge
