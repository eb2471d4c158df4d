// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/masters/mb4/pins.hpp"

#include <array>
#include <utility>

namespace mb4::sim {

std::optional<Pin> pin_by_name(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, Pin>, 33> kNames = {{
      {"DB0", Pin::kDb0},       {"DB1", Pin::kDb1},          {"DB2", Pin::kDb2},
      {"DB3", Pin::kDb3},       {"DB4", Pin::kDb4},          {"DB5", Pin::kDb5},
      {"DB6", Pin::kDb6},       {"DB7", Pin::kDb7},          {"NCS", Pin::kNcs},
      {"ALE", Pin::kAle},       {"NRD_RNW", Pin::kNrdRnw},   {"NWR_E", Pin::kNwrE},
      {"CFGSPI", Pin::kCfgspi}, {"INT_NMOT", Pin::kIntNmot}, {"NRES", Pin::kNres},
      {"CLK", Pin::kClk},       {"GETSENS", Pin::kGetsens},  {"NER", Pin::kNer},
      {"SL1", Pin::kSl1},       {"SL2_NSL1", Pin::kSl2},     {"EOT", Pin::kEot},
      {"MA1", Pin::kMa1},       {"MA2_NMA1", Pin::kMa2},     {"MO1", Pin::kMo1},
      {"MO2_NMO1", Pin::kMo2},  {"SCLK", Pin::kAle},         {"MOSI", Pin::kDb0},
      {"MISO", Pin::kDb1},      {"SL2", Pin::kSl2},          {"MA2", Pin::kMa2},
      {"MO2", Pin::kMo2},       {"IRQ", Pin::kIrq},          {"CLKENI", Pin::kClkeni},
  }};
  return find_pin(kNames, name);
}

}  // namespace mb4::sim
