// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Hints of the BiSS C master with N channels: the length of its words, its CRC and its enabled
// channels against the encoders.
#ifndef MB4SIM_AXI_HINTS_HPP_
#define MB4SIM_AXI_HINTS_HPP_

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/masters/chip_config.hpp"
#include "sim/masters/hint.hpp"

namespace mb4::sim {

// What its host has written.
class AxiSetup {
 public:
  void restart() { *this = {}; }
  void written(std::uint32_t address, std::uint32_t data, std::uint8_t strobe);

  std::vector<Hint> hints(const ChipConfig& chip, std::span<const HintLine> lines,
                          std::uint64_t missed) const;

 private:
  // The host asks for each word. A sample clock asks by itself, whatever is being written.
  bool single_point() const;

  static constexpr std::uint32_t kEnd = 0x6C;  // behind the CRC
  using Words = std::array<std::uint32_t, kEnd / 4>;

  Words now_{};
  Words taken_{};  // at the latest request for words
  bool asked_ = false;
};

}  // namespace mb4::sim

#endif  // MB4SIM_AXI_HINTS_HPP_
