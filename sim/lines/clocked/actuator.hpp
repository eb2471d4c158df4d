// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The receiving half of an actuator on a bus with MO. When a frame ends, the word in the shift
// register becomes the actuator's word if stop bit and CRC are right.
//
// Source: iC-MB4 Rev D2, pages 15, 25, 31.
#ifndef MB4SIM_ACTUATOR_HPP_
#define MB4SIM_ACTUATOR_HPP_

#include <cstdint>

#include "sim/lines/clocked/shift_register.hpp"
#include "sim/lines/crc.hpp"

namespace mb4::sim {

class Actuator {
 public:
  // A frame has ended. `data` holds data and inverted CRC. If it is one bit longer, it begins with
  // the stop bit.
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
  // Sets the word that the actuator has before the first one arrives.
  void preset(std::uint64_t word) { word_ = word; }

  // The last good word, and the number of good words so far.
  std::uint64_t word() const { return word_; }
  std::uint64_t words() const { return words_; }
  // Number of words that were not taken: with a wrong CRC, and with a stop bit of 1.
  std::uint64_t crc_errors() const { return crc_errors_; }
  std::uint64_t stop_errors() const { return stop_errors_; }
  // The CRC bits of the last word as they were on the line. The word may be good or bad.
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
