// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Check sums of BiSS by long division on bits as text: position x^6 + x + 1 (seed 3.2.4.2.16),
// control x^4 + x + 1 (seed 3.2.4.2.12). On the line both are inverted.
#ifndef TESTS_REFERENCE_PRU_DIVISION_HPP_
#define TESTS_REFERENCE_PRU_DIVISION_HPP_

#include <cstdint>
#include <string>

namespace pru_judge {

// The remainder of `bits` ('0' and '1', most significant first) and as many zeros as the divisor
// has bits but one.
std::string remainder(const std::string& bits, const std::string& divisor);
std::string inverted(const std::string& bits);
std::uint64_t number(const std::string& bits);

// What is sent behind the bits.
std::string position_crc(const std::string& bits);  // 6 bits
std::string control_crc(const std::string& bits);   // 4 bits

}  // namespace pru_judge

#endif  // TESTS_REFERENCE_PRU_DIVISION_HPP_
