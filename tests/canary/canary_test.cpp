// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Is Verilator's fault in XOR trees with inversions still there, and does -fno-const-bit-op-tree
// still avoid it? One module, Verilated with and without the flag, against the same in plain C++.

#include <gtest/gtest.h>
#include <verilated.h>

#include <cstdint>
#include <iostream>
#include <random>
#include <string>

#include "Vxor_trees_with_flag.h"
#include "Vxor_trees_without_flag.h"
#include "xor_trees_expected.inc"

namespace {

constexpr int kInputs = 200;
constexpr unsigned kSeed = 1;

// Outputs that were wrong for at least one input.
template <class Model>
int wrong_outputs() {
  VerilatedContext context;
  Model model(&context);
  std::mt19937 random(kSeed);
  std::uint64_t wrong = 0;
  for (int i = 0; i < kInputs; ++i) {
    const std::uint32_t x = static_cast<std::uint32_t>(random());
    model.x_i = x;
    model.eval();
    for (int output = 0; output < kOutputs; ++output) {
      const unsigned value = static_cast<unsigned>(model.y_o >> output & 1u);
      if (value != expected(output, x)) wrong |= std::uint64_t{1} << output;
    }
  }
  int count = 0;
  for (; wrong != 0; wrong &= wrong - 1) ++count;
  std::cout << count << " of " << kOutputs << " outputs wrong, " << kInputs << " inputs, seed "
            << kSeed << '\n';
  return count;
}

TEST(Canary, XorTreesWithTheFlag_AreRight) {
  EXPECT_EQ(wrong_outputs<Vxor_trees_with_flag>(), 0)
      << "-fno-const-bit-op-tree no longer avoids the fault: no result of this Verilator is safe";
}

TEST(Canary, XorTreesWithoutTheFlag_AreWrong) {
  EXPECT_GT(wrong_outputs<Vxor_trees_without_flag>(), 0)
      << "this Verilator no longer shows the fault: the flag can go";
}

}  // namespace
