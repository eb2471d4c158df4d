// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers as text. Whole ones are read in the usual notation: decimal or 0x, with _ between digits.
#ifndef MB4SIM_NUMBER_TEXT_HPP_
#define MB4SIM_NUMBER_TEXT_HPP_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sim/core/time.hpp"

namespace mb4::sim {

// Returns nothing if the text is not such a number or does not fit into 64 bits.
std::optional<std::uint64_t> parse_word(std::string_view text);

// Returns nothing if the text is no decimal number, or has more behind it.
std::optional<double> parse_real(std::string_view text);

// Returns "0x2A".
std::string hex_word(std::uint64_t value);

// Returns `value` as an output stream writes it.
std::string plain(double value);

// Returns a time in nanoseconds, with three digits for the picoseconds.
std::string ns_text(Time time);

}  // namespace mb4::sim

#endif  // MB4SIM_NUMBER_TEXT_HPP_
