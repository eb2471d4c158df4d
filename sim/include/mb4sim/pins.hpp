// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The pins of the chip by their datasheet names (iC-MB4 Rev D2, page 3) and what the board does to
// the ones nobody drives.
#ifndef MB4SIM_PINS_HPP_
#define MB4SIM_PINS_HPP_

#include <optional>
#include <string_view>

namespace mb4::sim {

enum class Pin {
  kDb0,
  kDb1,
  kDb2,
  kDb3,
  kDb4,
  kDb5,
  kDb6,
  kDb7,  // kDb0 + n = DBn
  kNcs,
  kAle,
  kNrdRnw,
  kNwrE,  // kAle is SCLK with SPI
  kCfgspi,
  kIntNmot,
  kNres,
  kClk,
  kGetsens,
  kNer,
  kSl1,
  kSl2,
  kEot,
  kMa1,
  kMa2,
  kMo1,
  kMo2,  // outputs from here on
};

// "NCS", "ALE", "SL2_NSL1", ...; also "SCLK", "MOSI", "MISO" and the short "SL2", "MA2", "MO2".
std::optional<Pin> pin_by_name(std::string_view name);

constexpr bool is_output(Pin pin) { return pin >= Pin::kEot; }

}  // namespace mb4::sim

#endif  // MB4SIM_PINS_HPP_
