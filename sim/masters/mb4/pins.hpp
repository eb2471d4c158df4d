// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The pins of the chip by their datasheet names (iC-MB4 Rev D2, page 3), and the level of a pin
// that is not driven.
#ifndef MB4SIM_PINS_HPP_
#define MB4SIM_PINS_HPP_

#include <optional>
#include <string_view>

#include "sim/hosts/parallel_host.hpp"
#include "sim/hosts/spi_host.hpp"

namespace mb4::sim {

enum class Pin : int {
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
  kNwrE,  // with SPI, kAle is SCLK
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
  kMo2,
  kIrq,
  kClkeni,  // outputs from here on; the last two are of the tops with a bus of words
};

// Returns the pin of a name such as "NCS", "ALE", "SL2_NSL1". "SCLK", "MOSI", "MISO" and the short
// "SL2", "MA2", "MO2" are names too. Nothing for any other name.
std::optional<Pin> pin_by_name(std::string_view name);

// The pins to which hosts are connected (page 3).
inline constexpr SpiPins kSpiPins{Pin::kNcs, Pin::kAle, Pin::kDb0, Pin::kDb1};
inline constexpr SpiPins kSpi2Pins{Pin::kDb4, Pin::kDb5, Pin::kDb6, Pin::kDb7};
inline constexpr ParallelPins kParallelPins{Pin::kDb0,  Pin::kNcs,    Pin::kAle,    Pin::kNrdRnw,
                                            Pin::kNwrE, Pin::kCfgspi, Pin::kIntNmot};

constexpr bool is_output(Pin pin) { return pin >= Pin::kEot; }

// Level of an input that is not driven. The chip pulls up NCS, NRD_RNW and NWR_E (A07), SL1 and
// SL2_NSL1 (B01), and NER (C07). It pulls down CFGSPI, INT_NMOT, ALE and DB7..0 (A06), GETSENS
// (C06), CLK (D06) and NRES (E07).
constexpr bool pulled_up(Pin pin) {
  switch (pin) {
    case Pin::kNcs:
    case Pin::kNrdRnw:
    case Pin::kNwrE:
    case Pin::kSl1:
    case Pin::kSl2:
    case Pin::kNer:
      return true;
    default:
      return false;
  }
}

}  // namespace mb4::sim

#endif  // MB4SIM_PINS_HPP_
