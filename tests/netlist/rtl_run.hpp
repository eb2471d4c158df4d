// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Bits of a step to and from the ports of a Verilated model, first port = most significant bits.
#ifndef MB4_TESTS_NETLIST_RTL_RUN_HPP_
#define MB4_TESTS_NETLIST_RTL_RUN_HPP_

#include <verilated.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

// One line of the stimulus: a hexadecimal number.
class BitReader {
 public:
  explicit BitReader(const std::string& hex) {
    for (const char digit : hex) {
      const int value = digit <= '9' ? digit - '0' : digit - 'a' + 10;
      for (int bit = 3; bit >= 0; --bit) bits_ += ((value >> bit) & 1) != 0 ? '1' : '0';
    }
  }
  // The line holds whole digits: the bits in front of the first port belong to no port.
  void skip_to_last(std::size_t count) { next_ = bits_.size() - count; }

  template <class Port>
  void take(Port& port, int width) {
    if constexpr (std::is_integral_v<Port>) {
      std::uint64_t value = 0;
      for (int i = 0; i < width; ++i) value = value << 1 | next();
      port = static_cast<Port>(value);
    } else {
      for (int i = width - 1; i >= 0; --i) {
        const int word = i / 32;
        const std::uint32_t mask = std::uint32_t{1} << (i % 32);
        port[word] = next() != 0 ? port[word] | mask : port[word] & ~mask;
      }
    }
  }

 private:
  unsigned next() { return bits_.at(next_++) == '1' ? 1 : 0; }
  std::string bits_;
  std::size_t next_ = 0;
};

// One line of output: a binary number.
class BitWriter {
 public:
  template <class Port>
  void put(const Port& port, int width) {
    for (int i = width - 1; i >= 0; --i) {
      if constexpr (std::is_integral_v<Port>) {
        text_ += ((port >> i) & 1) != 0 ? '1' : '0';
      } else {
        text_ += ((port[i / 32] >> (i % 32)) & 1) != 0 ? '1' : '0';
      }
    }
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

#endif  // MB4_TESTS_NETLIST_RTL_RUN_HPP_
