// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a slave's process data come from: a constant word, a ramp, a sine or a list of words.
#ifndef MB4SIM_DATA_SOURCE_HPP_
#define MB4SIM_DATA_SOURCE_HPP_

#include <cstdint>
#include <vector>

#include "mb4sim/time.hpp"

namespace mb4::sim {

struct DataSource {
  enum class Kind { kConstant, kRamp, kSine, kList };

  Kind kind = Kind::kConstant;
  std::uint64_t constant = 0;        // kConstant: the raw word, flags included
  std::int64_t start = 0;            // kRamp: position of the first frame
  std::int64_t step = 1;             // kRamp: added per frame, may be negative
  double offset = 0;                 // kSine: middle position
  double amplitude = 0;              // kSine: in position counts
  Time period = kPsPerSecond;        // kSine: ps
  std::vector<std::uint64_t> words;  // kList: raw words, flags included
  bool repeat = true;                // kList: start again after the last word, else hold it

  // The raw word that a slave with `data_bits` bits, the lowest `flag_bits` of them flags with the
  // level `flags`, latches at `now` when it has already delivered `frames` frames.
  std::uint64_t word(Time now, std::uint64_t frames, unsigned data_bits, unsigned flag_bits,
                     std::uint64_t flags) const;
};

}  // namespace mb4::sim

#endif  // MB4SIM_DATA_SOURCE_HPP_
