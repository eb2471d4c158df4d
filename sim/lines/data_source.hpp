// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The source of a slave's process data: a constant word, a ramp, a sine or a list of words.
#ifndef MB4SIM_DATA_SOURCE_HPP_
#define MB4SIM_DATA_SOURCE_HPP_

#include <cstdint>
#include <vector>

#include "sim/core/time.hpp"

namespace mb4::sim {

struct DataSource {
  enum class Kind { kConstant, kRamp, kSine, kList };

  Kind kind = Kind::kConstant;
  std::uint64_t constant = 0;        // kConstant: the raw word, flags included
  std::int64_t start = 0;            // kRamp: position of the first frame
  std::int64_t step = 1;             // kRamp: added in every frame, may be negative
  double offset = 0;                 // kSine: middle position
  double amplitude = 0;              // kSine: in position counts
  Time period = kPsPerSecond;        // kSine: ps
  std::vector<std::uint64_t> words;  // kList: raw words, flags included
  bool repeat = true;                // kList: after the last word start again, else hold it

  // Returns the raw word that a slave latches at `now` (ps) after it has delivered `frames` frames.
  // The word has `data_bits` bits (1 to 64). The lowest `flag_bits` of them have the level `flags`.
  std::uint64_t word(Time now, std::uint64_t frames, unsigned data_bits, unsigned flag_bits,
                     std::uint64_t flags) const;
};

}  // namespace mb4::sim

#endif  // MB4SIM_DATA_SOURCE_HPP_
