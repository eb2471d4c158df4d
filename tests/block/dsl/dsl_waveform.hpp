// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The samples of a window with an answer whose edges are not where they should be.
#ifndef TESTS_BLOCK_DSL_DSL_WAVEFORM_HPP_
#define TESTS_BLOCK_DSL_DSL_WAVEFORM_HPP_

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sim/masters/dsl_model/receiver.hpp"
#include "tests/support/dice.hpp"

namespace mb4test {

using DslSamples = std::vector<bool>;

// How an answer lies in its window, in sixteenths of a sample: its first edge at `begin`, each edge
// up to half of `jitter` away from its place, falling ones later by `duty`.
struct DslTiming {
  int begin = 0;
  unsigned jitter = 0;
  int duty = 0;
};

inline DslSamples samples_of(mb4::sim::dsl_model::Answer answer, const DslTiming& timing,
                             Dice& random) {
  using mb4::sim::dsl_model::kAnswerBits;
  constexpr int kBit = 128;
  DslSamples samples(mb4::sim::dsl_model::Receiver::kSamples);
  bool level = true;
  const bool after = random.below(4) != 0;  // the level behind the answer
  std::size_t at = 0;
  for (unsigned i = 0; i <= kAnswerBits; ++i) {
    const bool bit = i == kAnswerBits ? after : (answer >> (kAnswerBits - 1 - i) & 1U) != 0;
    int edge = timing.begin + static_cast<int>(i) * kBit;
    if (bit != level) {
      edge +=
          static_cast<int>(random.below(timing.jitter + 1)) - static_cast<int>(timing.jitter / 2);
      edge += bit ? -timing.duty : timing.duty;
    }
    const int most = static_cast<int>(samples.size());
    const auto end = static_cast<std::size_t>(std::clamp((edge + 15) / 16, 0, most));
    for (; at < end; ++at) samples[at] = level;
    level = bit;
  }
  for (; at < samples.size(); ++at) samples[at] = level;
  return samples;
}

}  // namespace mb4test

#endif  // TESTS_BLOCK_DSL_DSL_WAVEFORM_HPP_
