// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// What a host does by hand, one line each: the input of `mb4sim spi` and of `mb4sim run --spi`.
#ifndef MB4SIM_TOOL_SPI_LINES_HPP_
#define MB4SIM_TOOL_SPI_LINES_HPP_

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "masters/mb4/sim_bus.hpp"
#include "mb4sim/simulator.hpp"

namespace mb4::tool {

// Words of a line, without its comment.
std::vector<std::string_view> words_of(std::string_view line);

// Does what the words of a line say, of which there is at least one: a frame "02 ED 01", time
// "+1000" or a level "pin GETSENS 1". `received`: the chip's bytes of a frame, else empty. Returns
// what is wrong with the words, or empty.
std::string execute_words(sim::Simulator& simulator, SimBus& bus,
                          const std::vector<std::string_view>& words,
                          std::vector<std::uint8_t>& received);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_SPI_LINES_HPP_
