// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Frequencies of MA that the chip can make of its system clock: FREQS, address 0xE6 bits 4:0
// (iC-MB4 Rev D2, Table 35).
#ifndef MB4SIM_MA_FREQUENCY_HPP_
#define MB4SIM_MA_FREQUENCY_HPP_

#include <cstdint>
#include <optional>

namespace mb4::sim {

// Periods of the system clock in one period of MA; 0 for the code that is not permitted (16) and
// for codes above 31.
unsigned ma_divider(unsigned freqs_code);

// Frequency in Hz, rounded down to a whole number; 0 for a code that is not permitted.
std::uint64_t ma_frequency(std::uint64_t system_hz, unsigned freqs_code);

// The code whose (rounded down) frequency is `ma_hz`.
std::optional<unsigned> freqs_code(std::uint64_t system_hz, std::uint64_t ma_hz);

// The nearest possible frequencies around `ma_hz`: the largest below and the smallest above it.
// 0 where there is none.
struct NearestMa {
  std::uint64_t below = 0;
  std::uint64_t above = 0;
};
NearestMa nearest_ma(std::uint64_t system_hz, std::uint64_t ma_hz);

// Default of a scenario: the highest possible frequency that is not above 10 MHz.
std::uint64_t default_ma_frequency(std::uint64_t system_hz);

}  // namespace mb4::sim

#endif  // MB4SIM_MA_FREQUENCY_HPP_
