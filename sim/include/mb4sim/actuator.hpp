// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The receiving half of an actuator on a bus with MO (iC-MB4 Rev D2, pages 15, 25, 31): what its
// shift register holds when the frame has ended is its word, if the CRC says so.
#ifndef MB4SIM_ACTUATOR_HPP_
#define MB4SIM_ACTUATOR_HPP_

#include <cstdint>

#include "mb4sim/crc.hpp"
#include "mb4sim/shift_register.hpp"

namespace mb4::sim {

class Actuator {
 public:
  // End of a frame; `data` holds stop bit (if it is longer by one bit), data and inverted CRC.
  void take(const ShiftRegister& data, unsigned data_bits, const Crc& crc) {
    const std::size_t first = data.size() - data_bits - crc.width();
    std::uint64_t word = 0;
    for (unsigned i = 0; i < data_bits; ++i) word = word << 1U | (data.at(first + i) ? 1U : 0U);
    std::uint32_t check = 0;
    for (unsigned i = 0; i < crc.width(); ++i) {
      check = check << 1U | (data.at(first + data_bits + i) ? 1U : 0U);
    }
    line_crc_ = check;
    if (first != 0 && data.at(0)) {
      ++stop_errors_;
    } else if (check != crc.line_bits(word, data_bits)) {
      ++crc_errors_;
    } else {
      word_ = word;
      ++words_;
    }
  }
  // The word it has before the first one arrives.
  void preset(std::uint64_t word) { word_ = word; }

  // Last good word, and how many of them have come.
  std::uint64_t word() const { return word_; }
  std::uint64_t words() const { return words_; }
  // Words with a wrong CRC, and such with a stop bit that is 1: not taken.
  std::uint64_t crc_errors() const { return crc_errors_; }
  std::uint64_t stop_errors() const { return stop_errors_; }
  // CRC bits of the last word, good or bad, as they stood on the line.
  std::uint32_t line_crc() const { return line_crc_; }

 private:
  std::uint64_t word_ = 0;
  std::uint64_t words_ = 0;
  std::uint64_t crc_errors_ = 0;
  std::uint64_t stop_errors_ = 0;
  std::uint32_t line_crc_ = 0;
};

}  // namespace mb4::sim

#endif  // MB4SIM_ACTUATOR_HPP_
