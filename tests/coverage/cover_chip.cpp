// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model without tracing, with coverage counters: takes the place of
// sim/masters/mb4/model/fast_chip.cpp. Each chip's counters are added up when it ends; the sum goes
// to the file MB4_COVERAGE at exit.
#include <Vmb4_cover.h>
#include <Vmb4_cover___024root.h>
#include <unistd.h>
#include <verilated_cov.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "chip_signals.hpp"
#include "plain_steps.hpp"
#include "verilated_chip.hpp"

namespace mb4::sim {
namespace {

// Counts of all chips so far by point.
class Sum {
 public:
  ~Sum() {
    const char* path = std::getenv("MB4_COVERAGE");
    if (path == nullptr) return;
    std::ofstream file(path);
    file << "# SystemC::Coverage-3\n";
    for (const auto& [point, count] : counts_) file << point << ' ' << count << '\n';
  }

  void add(VerilatedContext& context) {
    const std::string path = "/dev/shm/mb4-coverage-" + std::to_string(getpid());
    context.coveragep()->write(path.c_str());
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      const std::size_t space = line.rfind(' ');
      if (line.rfind("C ", 0) != 0) continue;
      counts_[line.substr(0, space)] += std::stoull(line.substr(space + 1));
    }
    std::remove(path.c_str());
  }

 private:
  std::map<std::string, std::uint64_t> counts_;
};

// Takes the place of a waveform: the counters of a chip are added when it ends.
class Counters {
 public:
  static constexpr bool kTraces = false;
  ~Counters() {
    static Sum sum;
    sum.add(*context_);
  }
  template <typename Model>
  void open(VerilatedContext& context, Model& /*model*/, const TraceFile& /*file*/) {
    context_ = &context;
  }
  void dump(Time /*now*/) {}
  void flush() {}

 private:
  VerilatedContext* context_ = nullptr;
};

}  // namespace

std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed) {
  return std::make_unique<
      VerilatedChip<Vmb4_cover, Counters, ChipSignals<Vmb4_cover>, PlainSteps<Vmb4_cover>>>(
      config, seed, TraceFile{});
}

}  // namespace mb4::sim
