// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "masters/dsl/dsl_workload.hpp"

#include <stdexcept>

#include "dsl_page_regs.hpp"
#include "mb4sim/simulator.hpp"
#include "sim/scenario/scenario.hpp"
#include "word_port.hpp"

namespace mb4::tool {
namespace {

constexpr const char* kScenario =
    "[master]\ntype = \"dsl\"\n[[channel]]\nnumber = 1\ncable_m = 20.0\n[[channel.slave]]\n"
    "protocol = \"dsl\"\nsource = \"sine\"\namplitude = 200_000\nperiod_us = 20_000\n";

class LinkFrames final : public Workload {
 public:
  LinkFrames() : simulator_(sim::parse_scenario(kScenario, "workload")) {
    constexpr sim::Time kUntilLink = 2000 * sim::kPsPerUs;
    simulator_.advance(kUntilLink);
    WordPort port(simulator_);
    std::uint32_t status = 0;
    if (!port.read(dsl::page::kAddrStatus, status) || dsl::page::POS_LOST::get(status) != 0) {
      throw std::runtime_error("workload: there is no link");
    }
    begun_ = done();
  }

  void run(sim::Time duration) override { simulator_.advance(duration); }

  WorkCount count() const override {
    WorkCount count = done();
    count.clocks -= begun_.clocks;
    count.frames -= begun_.frames;
    count.time -= begun_.time;
    return count;
  }

 private:
  // Since the begin of the simulation.
  WorkCount done() const {
    WorkCount count;
    count.clocks = simulator_.clk_cycles();
    count.time = simulator_.now();
    count.frames = simulator_.slave(1)->frames();
    return count;
  }

  sim::Simulator simulator_;
  WorkCount begun_;  // when the link was there
};

constexpr WorkloadInfo kWorkloads[] = {
    {'J', "dsl_axil: 1 encoder, a frame each 11.52 us, 75 MHz",
     []() -> std::unique_ptr<Workload> { return std::make_unique<LinkFrames>(); }},
};

}  // namespace

std::span<const WorkloadInfo> dsl_workloads() { return kWorkloads; }

}  // namespace mb4::tool
