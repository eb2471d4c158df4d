// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Random numbers for tests.
#ifndef TESTS_SUPPORT_DICE_HPP_
#define TESTS_SUPPORT_DICE_HPP_

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "sim/core/random.hpp"

namespace mb4test {

// Random numbers, the same on every machine. Failures name the seed; MB4_SEED sets another one.
class Dice {
 public:
  // 0 to limit - 1.
  unsigned below(unsigned limit) { return static_cast<unsigned>(random_.up_to(limit - 1)); }

 private:
  static std::uint64_t seed() {
    const char* text = std::getenv("MB4_SEED");
    return text != nullptr ? std::strtoull(text, nullptr, 0) : 1;
  }
  mb4::sim::Random random_{seed()};
  testing::ScopedTrace trace_{__FILE__, __LINE__, "MB4_SEED=" + std::to_string(seed())};
};

}  // namespace mb4test

#endif  // TESTS_SUPPORT_DICE_HPP_
