// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The workloads of `mb4sim bench` in Google Benchmark. One iteration is 1 ms of simulated time;
// items are system clocks.
#include <benchmark/benchmark.h>

#include <exception>
#include <string>

#include "workload.hpp"

namespace {

void simulate(benchmark::State& state, const mb4::tool::WorkloadInfo& info) {
  try {
    const auto workload = info.make();
    workload->run(1000 * mb4::sim::kPsPerUs);
    const auto before = workload->count();
    for ([[maybe_unused]] auto iteration : state) workload->run(1000 * mb4::sim::kPsPerUs);
    const auto after = workload->count();
    state.SetItemsProcessed(static_cast<std::int64_t>(after.clocks - before.clocks));
    state.counters["real_time"] = benchmark::Counter(
        mb4::sim::to_us(after.time - before.time) * 1e-6, benchmark::Counter::kIsRate);
  } catch (const std::exception& error) {
    state.SkipWithError(error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  for (const mb4::tool::WorkloadInfo& info : mb4::tool::workloads()) {
    benchmark::RegisterBenchmark((std::string(1, info.letter) + "/" + info.description).c_str(),
                                 &simulate, info)
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
