// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A command of a control communication.

#ifndef MB4_COMMAND_HPP_
#define MB4_COMMAND_HPP_

#include <cstdint>

namespace mb4 {

// A BiSS command (page 29).
struct Command {
  // CHSEL: bit 0 = channel 1, bit 1 = channel 2; both at once are allowed.
  std::uint8_t channels = 1;
  // Addressed slaves: bit n = ID n. 0 = broadcast, which no slave acknowledges.
  std::uint8_t ids = 0;
  // CMD, 0..3. Broadcast 3 is reserved. Protocol and device define the meaning of the codes; for
  // example broadcast 0 ends the single-cycle data of all slaves.
  std::uint8_t code = 0;
  // IDA_TEST: the slaves execute only if exactly those addressed have acknowledged. Not with
  // broadcast.
  bool test_acknowledge = false;
};

namespace detail {

// Reverses the order of the bits: bit 0 becomes bit 7.
constexpr std::uint8_t reversed(std::uint8_t bits) {
  unsigned out = 0;
  for (unsigned bit = 0; bit < 8; ++bit) {
    out |= (bits >> bit & 1U) << (7 - bit);
  }
  return static_cast<std::uint8_t>(out);
}

}  // namespace detail
}  // namespace mb4

#endif  // MB4_COMMAND_HPP_
