// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Frequencies of MA that the chip can derive from its system clock with FREQS, address 0xE6 bits
// 4:0.
//
// Source: iC-MB4 Rev D2, Table 35.
#ifndef MB4SIM_MA_FREQUENCY_HPP_
#define MB4SIM_MA_FREQUENCY_HPP_

#include <cstdint>
#include <optional>

namespace mb4::sim {

// Returns the periods of the system clock in half a period of MA, for codes of 0 to 31. Code 16,
// which is not permitted, gives 10 (docs/choices.md).
inline unsigned half_ma_clocks(unsigned freqs_code) {
  return (freqs_code < 16 ? 1 : 10) * (freqs_code % 16 + 1);
}

// Returns the periods of the system clock in one period of MA. 0 for code 16, which is not
// permitted, and for codes above 31.
unsigned ma_divider(unsigned freqs_code);

// Returns the frequency of MA in Hz, rounded down. 0 for a code that is not permitted.
std::uint64_t ma_frequency(std::uint64_t system_hz, unsigned freqs_code);

// Returns the code whose frequency, rounded down, is `ma_hz`. Nothing if there is none.
std::optional<unsigned> freqs_code(std::uint64_t system_hz, std::uint64_t ma_hz);

// The possible frequencies next to a frequency: the largest below and the smallest above it, in Hz.
// 0 where there is none.
struct NearestMa {
  std::uint64_t below = 0;
  std::uint64_t above = 0;
};
NearestMa nearest_ma(std::uint64_t system_hz, std::uint64_t ma_hz);

// The default of a scenario in Hz: the highest possible frequency that is not above 10 MHz.
std::uint64_t default_ma_frequency(std::uint64_t system_hz);

}  // namespace mb4::sim

#endif  // MB4SIM_MA_FREQUENCY_HPP_
