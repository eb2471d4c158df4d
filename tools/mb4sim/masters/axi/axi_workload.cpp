// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "masters/axi/axi_workload.hpp"

#include <fmt/core.h>

#include <stdexcept>
#include <string>

#include "biss_axi/device.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim_clock.hpp"
#include "word_port.hpp"

namespace mb4::tool {
namespace {

std::string scenario_of(unsigned channels) {
  std::string text = "[master]\ntype = \"axi\"\n[chip]\nf_clk_hz = 100_000_000\n";
  for (unsigned number = 1; number <= channels; ++number) {
    text += fmt::format(
        "[[channel]]\nnumber = {}\ncable_m = {}.0\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
        "data_bits = 28\nsource = \"ramp\"\n",
        number, 5 * number);
  }
  return text;
}

class AxiFrames final : public Workload {
 public:
  explicit AxiFrames(unsigned channels)
      : simulator_(sim::parse_scenario(scenario_of(channels), "workload")) {
    constexpr sim::Time kUntilFrames = 100 * sim::kPsPerUs;
    WordPort port(simulator_);
    SimClock clock(simulator_);
    biss_axi::Device device(port, clock);
    biss_axi::Config config;
    config.channels = (1U << channels) - 1U;
    config.start = biss_axi::Start::kInternalClock;
    config.sample_hz = 1'000'000;
    if (!device.configure(config)) throw std::runtime_error("workload: configuration");
    simulator_.advance(kUntilFrames);
    if (count().frames == 0) throw std::runtime_error("workload: there are no frames");
  }

  void run(sim::Time duration) override { simulator_.advance(duration); }

  WorkCount count() const override {
    WorkCount count;
    count.clocks = simulator_.clk_cycles();
    count.time = simulator_.now();
    for (unsigned number = 1; number <= simulator_.scenario().channels.size(); ++number) {
      count.frames += simulator_.slave(number)->frames();
    }
    return count;
  }

 private:
  sim::Simulator simulator_;
};

constexpr WorkloadInfo kWorkloads[] = {
    {'H', "biss_axi: 1 encoder, frames back to back, 100 MHz",
     []() -> std::unique_ptr<Workload> { return std::make_unique<AxiFrames>(1); }},
    {'I', "biss_axi: 4 encoders, frames back to back, 100 MHz",
     []() -> std::unique_ptr<Workload> { return std::make_unique<AxiFrames>(4); }},
};

}  // namespace

std::span<const WorkloadInfo> axi_workloads() { return kWorkloads; }

}  // namespace mb4::tool
