// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Hints of the iC-MB4: its registers against the slaves and cables of its lines.
//
// The words of a line follow one another, so the first one that does not fit explains those behind
// it: each line gives at most one hint. A chip without a clock gives no other one.
#ifndef MB4SIM_SETUP_HINTS_HPP_
#define MB4SIM_SETUP_HINTS_HPP_

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/hosts/host_check.hpp"
#include "sim/masters/hint.hpp"
#include "sim/masters/mb4/hints/setup_watch.hpp"

namespace mb4::sim {

// What the frequencies of a chip depend on beside its registers.
struct SetupClock {
  std::optional<std::uint64_t> pin_hz;  // of pin CLK, 0: open. Nothing: somebody moves it by hand
  std::uint64_t oscillator_hz = 0;      // with CLKENI; 0: the chip has no choice
};

// `features`: ChipConfig::features. `missed`: see LiveMaster::hints().
std::vector<Hint> setup_hints(const WrittenSetup& setup, std::uint32_t features,
                              const SetupClock& clock, std::span<const HintLine> lines,
                              std::uint64_t missed);

// Opcodes that the chip does not have, and an SCLK above its limit.
std::vector<Hint> host_hints(std::span<const std::uint8_t> opcodes, const HostCheck& check);

}  // namespace mb4::sim

#endif  // MB4SIM_SETUP_HINTS_HPP_
