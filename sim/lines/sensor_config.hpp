// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The properties that sensors of every protocol have: a word of some length, its CRC and its
// source. Only a replay has none of its own.
#ifndef MB4SIM_SENSOR_CONFIG_HPP_
#define MB4SIM_SENSOR_CONFIG_HPP_

#include <cstdint>

#include "sim/core/time.hpp"
#include "sim/lines/data_source.hpp"
#include "sim/lines/device.hpp"

namespace mb4::sim {

// A counter in the lowest bits of a word: it goes one step on with each frame, from its highest
// value to `first` (BiSS Safety: sign of life).
struct LifeCounter {
  unsigned bits = 0;  // 0: none; at most kMaxBits
  unsigned first = 0;

  static constexpr unsigned kMaxBits = 16;

  // The value after `steps` steps from `first`.
  std::uint64_t value(std::uint64_t steps) const {
    return first + steps % ((std::uint64_t{1} << bits) - first);
  }
  // `word` with the value after `steps` steps.
  std::uint64_t in_word(std::uint64_t word, std::uint64_t steps) const {
    return bits == 0 ? word : word >> bits << bits | value(steps);
  }
};

struct SensorConfig : DeviceConfig {
  std::uint64_t flags = 0b11;  // level of the flags with a ramp or sine; nE = nW = 1: no error
  DataSource source;
  LifeCounter life_counter;  // BiSS C; part of the flag bits

  // Returns the word that is latched at `now` after `frames` frames.
  std::uint64_t word(Time now, std::uint64_t frames) const {
    return source.word(now, frames, data_bits, flag_bits, flags);
  }
  // Sets a constant word from now on. Returns false and changes nothing if the word does not fit.
  bool hold(std::uint64_t raw) {
    if (data_bits < 64 && (raw >> data_bits) != 0) return false;
    source.kind = DataSource::Kind::kConstant;
    source.constant = raw;
    return true;
  }
  // Number of bits of data and CRC.
  unsigned word_bits() const { return data_bits + crc.width(); }
};

}  // namespace mb4::sim

#endif  // MB4SIM_SENSOR_CONFIG_HPP_
