// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_clb with an encoder behind a cable in the simulator, and the calls of pm_bissc_include.h on
// it. The calls are for one master a program, so at most one bench lives at a time.
#ifndef TESTS_CHIP_CLB_BENCH_HPP_
#define TESTS_CHIP_CLB_BENCH_HPP_

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "clb_regs.hpp"
#include "mb4sim/simulator.hpp"
#include "pm_bissc_include.h"
#include "sim/hosts/word_host.hpp"
#include "sim/scenario/scenario.hpp"

namespace mb4test {

namespace clbreg = biss_clb::regs;
namespace sim = mb4::sim;

inline std::string clb_scenario(const std::string& channel, std::uint64_t f_clk_hz = 200'000'000) {
  return "[master]\ntype = \"clb\"\n[chip]\nf_clk_hz = " + std::to_string(f_clk_hz) + "\n" +
         channel;
}

class ClbBench {
 public:
  explicit ClbBench(const std::string& scenario, const sim::SimulatorOptions& options = {});
  ~ClbBench();
  ClbBench(const ClbBench&) = delete;
  ClbBench& operator=(const ClbBench&) = delete;

  void write(std::uint32_t address, std::uint32_t data, std::uint8_t strobe = 0xF) {
    EXPECT_EQ(host.write(address, data, strobe), std::uint8_t{0});
  }
  std::uint32_t read(std::uint32_t address) {
    std::uint32_t data = 0;
    EXPECT_EQ(host.read(address, data), std::uint8_t{0});
    return data;
  }
  bool pin(const char* name) { return simulator.pin(*simulator.pin_by_name(name)); }

  // The master and the structures for positions of `bits`; MA is the clock divided by 2 * div.
  void set_up(unsigned bits, unsigned div);
  // One frame; the result of PM_bissc_receivePosition().
  unsigned frame();
  // Frames until an access to a register has ended; its status.
  unsigned access(enum cdRegisterAccessType type, unsigned address, unsigned data = 0);

  sim::Simulator simulator;
  sim::WordHost& host;
  PM_bissc_scdStruct scd{};
  PM_bissc_cdStruct cd{};
  PM_bissc_registerStruct reg{};
  PM_bissc_encoderStruct encoder{};

 private:
  unsigned div_ = 0;
};

}  // namespace mb4test

#endif  // TESTS_CHIP_CLB_BENCH_HPP_
