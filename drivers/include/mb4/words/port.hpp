// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The port contract of a bus of 32-bit words, and the port of a processor that has the chip in its
// memory. What stands in mb4/words/ needs the generated mb4_page_regs.hpp beside mb4_regs.hpp.

#ifndef MB4_WORDS_PORT_HPP_
#define MB4_WORDS_PORT_HPP_

#include <cstdint>
#include <type_traits>
#include <utility>

namespace mb4 {

// The port contract. A type `Port` has
//
//   bool read(std::uint32_t offset, std::uint32_t& value);
//   bool write(std::uint32_t offset, std::uint32_t value, std::uint8_t strobes);
//
// * One call is one access. `offset` is 0x000 to 0x1DC in bytes, a multiple of 4, from the first
//   register of the chip on. Byte 0 of a word is in its bits 7..0.
// * Bit b of `strobes` lets byte b be written. It is never 0.
// * It returns true when the access was made, and false when the bus answered with an error: the
//   core's clock stands still.
template <typename Port, typename = void>
inline constexpr bool kIsWordPort = false;

template <typename Port>
inline constexpr bool kIsWordPort<
    Port,
    std::void_t<
        decltype(std::declval<Port&>().read(std::uint32_t{}, std::declval<std::uint32_t&>())),
        decltype(std::declval<Port&>().write(std::uint32_t{}, std::uint32_t{}, std::uint8_t{}))>> =
    std::is_same_v<decltype(std::declval<Port&>().read(std::uint32_t{},
                                                       std::declval<std::uint32_t&>())),
                   bool>&&
        std::is_same_v<decltype(std::declval<Port&>().write(std::uint32_t{}, std::uint32_t{},
                                                            std::uint8_t{})),
                       bool>;

// The chip in the memory of a little-endian processor. The memory must be uncached and keep the
// order of accesses ("device memory"). Words, half words and bytes are written as such, so a bus
// with byte enables is needed. An access that the bus answers with an error is an exception of the
// processor; the calls here always return true.
class MappedPort {
 public:
  // `base`: address of the chip's first register, a multiple of 4.
  explicit MappedPort(std::uintptr_t base) : base_(base) {}

  bool read(std::uint32_t offset, std::uint32_t& value) {
    value = *at<std::uint32_t>(offset);
    return true;
  }
  bool write(std::uint32_t offset, std::uint32_t value, std::uint8_t strobes) {
    constexpr unsigned kAll = 0xF;
    constexpr unsigned kHalf = 0x3;
    if (strobes == kAll) {
      *at<std::uint32_t>(offset) = value;
      return true;
    }
    // 0xF4 acts last: with 0xF5 it is one half word.
    for (unsigned half = 0; half < 4; half += 2) {
      const unsigned enabled = (strobes >> half) & kHalf;
      const auto pair = static_cast<std::uint16_t>(value >> (8U * half));
      if (enabled == kHalf) {
        *at<std::uint16_t>(offset + half) = pair;
      } else if (enabled != 0) {
        const unsigned byte = enabled == 1 ? 0 : 1;
        *at<std::uint8_t>(offset + half + byte) = static_cast<std::uint8_t>(pair >> (8U * byte));
      }
    }
    return true;
  }

 private:
  template <typename Word>
  volatile Word* at(std::uint32_t offset) const {
    return reinterpret_cast<volatile Word*>(base_ + offset);
  }

  std::uintptr_t base_;
};

}  // namespace mb4

#endif  // MB4_WORDS_PORT_HPP_
