// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The model without tracing, with coverage counters: takes the place of sim/model/fast_chip.cpp.
// Each chip's counters are added up when it ends; the sum goes to the file MB4_COVERAGE at exit.
#include <Vmb4_cover.h>
#include <Vmb4_cover___024root.h>
#include <unistd.h>
#include <verilated_cov.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <utility>

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

class CoveredChip final : public ChipModel {
 public:
  explicit CoveredChip(std::unique_ptr<ChipModel> chip) : chip_(std::move(chip)) {}
  ~CoveredChip() override {
    chip_->run_clocks(0);  // makes the chip's context that of the thread
    static Sum sum;
    sum.add(*Verilated::threadContextp());
  }

  Time run_clocks(Time limit) override { return chip_->run_clocks(limit); }
  Time next_edge() const override { return chip_->next_edge(); }
  void set_input(Time now, Pin pin, bool level) override { chip_->set_input(now, pin, level); }
  void set_clock(Time now, std::uint64_t hz) override { chip_->set_clock(now, hz); }
  unsigned watched() const override { return chip_->watched(); }
  bool clk() const override { return chip_->clk(); }
  unsigned db_out() const override { return chip_->db_out(); }
  unsigned db_enable() const override { return chip_->db_enable(); }
  std::uint64_t cycles() const override { return chip_->cycles(); }
  std::uint64_t left_out() const override { return chip_->left_out(); }
  unsigned half_clocks() const override { return chip_->half_clocks(); }
  Time min_clock() const override { return chip_->min_clock(); }
  bool paired() const override { return chip_->paired(); }
  void set_probes(Time now, unsigned ma, unsigned slo, unsigned idle) override {
    chip_->set_probes(now, ma, slo, idle);
  }
  void finish_trace() override { chip_->finish_trace(); }

 private:
  std::unique_ptr<ChipModel> chip_;
};

}  // namespace

std::unique_ptr<ChipModel> make_fast_chip(const ChipConfig& config, std::uint64_t seed) {
  return std::make_unique<CoveredChip>(
      std::make_unique<
          VerilatedChip<Vmb4_cover, NoTrace, ChipSignals<Vmb4_cover>, PlainSteps<Vmb4_cover>>>(
          config, seed, TraceFile{}));
}

}  // namespace mb4::sim
