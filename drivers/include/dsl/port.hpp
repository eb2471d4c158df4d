// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The bus of the DSL master: words are read, bytes are written.

#ifndef DSL_PORT_HPP_
#define DSL_PORT_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <cstdint>
#include <type_traits>
#include <utility>

#include "dsl/error.hpp"

namespace dsl {

// The port contract. A type `Port` has
//
//   bool read(std::uint32_t offset, std::uint32_t& word);
//   bool write(std::uint32_t offset, std::uint8_t byte);
//
// Offsets are in bytes from the master's base address; that of a read is a multiple of 4. A read is
// one access of 32 bits, the byte of the lowest address in bits 7 to 0. A write changes one byte
// (AXI: one strobe). false: the access failed.
template <typename Port, typename = void>
inline constexpr bool kIsPort = false;

template <typename Port>
inline constexpr bool kIsPort<
    Port, std::void_t<decltype(std::declval<Port&>().write(std::uint32_t{}, std::uint8_t{})),
                      decltype(std::declval<Port&>().read(std::uint32_t{},
                                                          std::declval<std::uint32_t&>()))>> =
    std::is_same_v<decltype(std::declval<Port&>().write(std::uint32_t{}, std::uint8_t{})), bool>;

// A master in the address space of the processor. A failed access is then the processor's own
// exception.
class MemoryPort {
 public:
  // `base` must not be null, and is a multiple of 4.
  explicit MemoryPort(volatile void* base) : base_(static_cast<volatile std::uint8_t*>(base)) {}
  bool read(std::uint32_t offset, std::uint32_t& word) {
    word = *reinterpret_cast<volatile std::uint32_t*>(base_ + offset);
    return true;
  }
  bool write(std::uint32_t offset, std::uint8_t byte) {
    base_[offset] = byte;
    return true;
  }

 private:
  volatile std::uint8_t* base_;
};

// Offset of the word that has this byte.
[[nodiscard]] constexpr std::uint32_t word_of(std::uint32_t offset) {
  return offset & ~std::uint32_t{3};
}

// The byte at `offset` of that word.
[[nodiscard]] constexpr std::uint8_t byte_of(std::uint32_t word, std::uint32_t offset) {
  return static_cast<std::uint8_t>(word >> 8U * (offset & 3U));
}

}  // namespace dsl

#endif  // __cplusplus >= 201703L

#endif  // DSL_PORT_HPP_
