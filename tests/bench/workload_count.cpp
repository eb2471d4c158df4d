// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// workload_count LETTER MS: a workload of `mb4sim bench` for MS milliseconds of simulated time.
// Prints what it has done: clocks, frames, bytes of SPI. The work is the same at each run, so
// instructions.py can count its instructions.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "workload.hpp"

int main(int count, char** arguments) {
  if (count != 3) return 2;
  try {
    for (const mb4::tool::WorkloadInfo& info : mb4::tool::workloads()) {
      if (info.letter != arguments[1][0]) continue;
      const auto workload = info.make();
      workload->run(std::strtoull(arguments[2], nullptr, 10) * 1000 * mb4::sim::kPsPerUs);
      const mb4::tool::WorkCount work = workload->count();
      std::printf("%llu %llu %llu\n", static_cast<unsigned long long>(work.clocks),
                  static_cast<unsigned long long>(work.frames),
                  static_cast<unsigned long long>(work.spi_bytes));
      return 0;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  std::fprintf(stderr, "no workload %s\n", arguments[1]);
  return 2;
}
