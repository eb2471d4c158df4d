// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Random numbers from one seed (SplitMix64). They are the same on every machine. The distributions
// of the standard library are not.
#ifndef MB4SIM_RANDOM_HPP_
#define MB4SIM_RANDOM_HPP_

#include <cstdint>

namespace mb4::sim {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }
  // 0 to limit, both included.
  std::uint64_t up_to(std::uint64_t limit) {
    return limit == UINT64_MAX ? next() : next() % (limit + 1U);
  }

 private:
  std::uint64_t state_;
};

// Returns a separate seed for part `part` of something that has seed `seed`.
inline std::uint64_t derive_seed(std::uint64_t seed, std::uint64_t part) {
  return Random(seed ^ (part * 0xD1B54A32D192ED03U)).next();
}

}  // namespace mb4::sim

#endif  // MB4SIM_RANDOM_HPP_
