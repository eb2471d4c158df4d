// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs the workload with the most work per clock. Its model counts how often its parts run
// (split_edge.py --count) and writes the counts to standard error when it ends.
#include <fmt/format.h>

#include <exception>

#include "workload.hpp"

int main() try {
  constexpr mb4::sim::Time kDuration = 40'000 * mb4::sim::kPsPerUs;
  for (const auto& info : mb4::tool::workloads()) {
    if (info.letter == 'B') info.make()->run(kDuration);
  }
  return 0;
} catch (const std::exception& error) {
  fmt::print("error: {}\n", error.what());
  return 1;
}
