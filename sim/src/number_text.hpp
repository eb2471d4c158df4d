// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Whole numbers as people write them: decimal or 0x, with _ between digits.
#ifndef MB4SIM_SRC_NUMBER_TEXT_HPP_
#define MB4SIM_SRC_NUMBER_TEXT_HPP_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mb4::sim {

// Nothing if the text is no such number or does not fit into 64 bits.
std::optional<std::uint64_t> parse_word(std::string_view text);

// As short as an output stream writes it.
std::string plain(double value);

}  // namespace mb4::sim

#endif  // MB4SIM_SRC_NUMBER_TEXT_HPP_
