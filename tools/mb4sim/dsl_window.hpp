// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The words of a frame of the DSL master, read as a host reads them.
#ifndef MB4SIM_TOOL_DSL_WINDOW_HPP_
#define MB4SIM_TOOL_DSL_WINDOW_HPP_

#include <cstdint>
#include <optional>

#include "dsl_page_regs.hpp"
#include "word_port.hpp"

namespace mb4::tool {

struct DslWindow {
  std::uint64_t position = 0;  // 64 bits, widened
  int speed = 0;
  std::uint32_t number = 0;  // FRAME_COUNT, which wraps
  std::uint64_t time = 0;    // of the edge in SAMPLE, clocks of the core
  bool lost = true;          // the position is not certain
  unsigned quality = 0;
  unsigned delay = 0;
};

// The first word copies the others. Nothing if the master does not answer.
inline std::optional<DslWindow> read_dsl_window(WordPort& port) {
  namespace page = dsl::page;
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t speed = 0;
  std::uint32_t number = 0;
  std::uint32_t time_low = 0;
  std::uint32_t time_high = 0;
  std::uint32_t status = 0;
  if (!port.read(page::kAddrPosLo, low) || !port.read(page::kAddrPosHi, high) ||
      !port.read(page::kAddrVel, speed) || !port.read(page::kAddrFrameCount, number) ||
      !port.read(page::kAddrFrameTimeLo, time_low) ||
      !port.read(page::kAddrFrameTimeHi, time_high) || !port.read(page::kAddrFrameStatus, status)) {
    return std::nullopt;
  }
  return DslWindow{.position = std::uint64_t{high} << 32U | low,
                   .speed = static_cast<int>(speed),
                   .number = number,
                   .time = std::uint64_t{time_high} << 32U | time_low,
                   .lost = page::FRAME_POS_LOST::get(status) != 0,
                   .quality = page::FRAME_QUALITY::get(status),
                   .delay = page::FRAME_DELAY_BITS::get(status)};
}

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_DSL_WINDOW_HPP_
