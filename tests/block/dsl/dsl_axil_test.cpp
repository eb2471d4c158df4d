// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The master on AXI4-Lite with two clocks: accesses at bus clocks of 10 to 250 MHz and random
// phases, and what happens while the clock of the core stands still, or one side is reset.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "Vdsl_axil.h"
#include "Vdsl_axil_same.h"
#include "tests/block/dsl/dsl_registers.hpp"
#include "tests/support/model_context.hpp"

namespace {

namespace map = dsl::regs;
namespace page = dsl::page;

constexpr std::uint64_t kCorePeriod = 13'333;  // ps
constexpr unsigned kWaitLimit = 256;           // as the model has it
constexpr unsigned kOkay = 0;
constexpr unsigned kError = 2;

struct Answer {
  unsigned response = kOkay;
  std::uint32_t data = 0;
  unsigned clocks = 0;  // of the bus
};

template <typename Model>
class Bench {
 public:
  // A bus period of 0: both clocks are one.
  Bench(std::uint64_t bus_period, mb4test::Dice& random)
      : period_(bus_period), random_(random), m(*owner) {
    m.s_axi_awvalid = m.s_axi_wvalid = m.s_axi_arvalid = 0;
    m.s_axi_bready = m.s_axi_rready = 1;
    m.s_axi_aclk = m.clk_i = 0;
    m.dsl_in_i = 1;
    m.s_axi_aresetn = m.rst_ni = 1;
    m.eval();
    m.s_axi_aresetn = m.rst_ni = 0;
    m.eval();
    core_at_ = 1 + random.below(kCorePeriod);
    bus_at_ = 1 + random.below(kCorePeriod);
    for (unsigned i = 0; i < 4; ++i) bus_clock();
    m.s_axi_aresetn = m.rst_ni = 1;
    m.eval();
    for (unsigned i = 0; i < 40; ++i) bus_clock();
  }

  // The core's reset falls before the bus clock with this number, and stays for so many; 0: a pulse
  // between two clocks.
  void reset_core(unsigned clock, unsigned clocks) {
    reset_at_ = clock;
    reset_for_ = clocks;
  }

  // Up to the next rising edge of the bus's clock, with it.
  void bus_clock() {
    if (reset_at_ != 0 && --reset_at_ == 0) {
      m.rst_ni = 0;
      m.eval();
      release_at_ = reset_for_ + 1;
    }
    if (release_at_ != 0 && --release_at_ == 0) {
      m.rst_ni = 1;
      m.eval();
    }
    if (period_ == 0) {
      edge(true, true);
      edge(false, false);
      ++core_clocks;
      return;
    }
    while (core_runs && core_at_ <= bus_at_) core_edge();
    m.s_axi_aclk = 1;
    m.eval();
    const std::uint64_t fall = bus_at_ + period_ / 2;
    while (core_runs && core_at_ <= fall) core_edge();
    m.s_axi_aclk = 0;
    m.eval();
    bus_at_ += period_;
    if (!core_runs) core_at_ = bus_at_ + 1 + random_.below(kCorePeriod);
  }

  Answer read(unsigned address) {
    m.s_axi_araddr = static_cast<SData>(address);
    m.s_axi_arvalid = 1;
    Answer answer;
    while (m.s_axi_rvalid == 0) {
      const bool taken = m.s_axi_arready != 0;
      bus_clock();
      if (taken) m.s_axi_arvalid = 0;
      if (++answer.clocks > 4 * kWaitLimit) break;
    }
    answer.response = m.s_axi_rresp;
    answer.data = m.s_axi_rdata;
    m.s_axi_arvalid = 0;
    bus_clock();
    return answer;
  }
  Answer write(unsigned address, std::uint32_t data, unsigned strobes) {
    m.s_axi_awaddr = static_cast<SData>(address);
    m.s_axi_wdata = data;
    m.s_axi_wstrb = static_cast<CData>(strobes);
    m.s_axi_awvalid = m.s_axi_wvalid = 1;
    Answer answer;
    while (m.s_axi_bvalid == 0) {
      const bool taken = m.s_axi_awready != 0;
      bus_clock();
      if (taken) {
        m.s_axi_awvalid = m.s_axi_wvalid = 0;
        // What comes next on the bus must not reach a write that still crosses.
        m.s_axi_awaddr = static_cast<SData>(random_.below(0x1000));
        m.s_axi_wdata = random_.below(1U << 31U);
        m.s_axi_wstrb = static_cast<CData>(random_.below(16));
      }
      if (++answer.clocks > 4 * kWaitLimit) break;
    }
    answer.response = m.s_axi_bresp;
    m.s_axi_awvalid = m.s_axi_wvalid = 0;
    bus_clock();
    return answer;
  }

  mb4test::Owned<Model> owner;
  bool core_runs = true;
  std::uint64_t core_clocks = 0;

 private:
  void core_edge() {
    m.clk_i = m.clk_i == 0 ? 1 : 0;
    m.eval();
    core_clocks += m.clk_i;
    core_at_ += kCorePeriod / 2;
  }
  void edge(bool bus, bool core) {
    m.s_axi_aclk = bus ? 1 : 0;
    m.clk_i = core ? 1 : 0;
    m.eval();
  }

  std::uint64_t period_;
  std::uint64_t core_at_ = 0, bus_at_ = 0;
  unsigned reset_at_ = 0, reset_for_ = 0, release_at_ = 0;
  mb4test::Dice& random_;

 public:
  Model& m;
};

// Registers keep what is written, constants and time are right.
template <typename Model>
void use_registers(Bench<Model>& bench, mb4test::Dice& random, unsigned most) {
  std::uint8_t es = 1;
  std::uint64_t before = 0;
  // Behind the reset the core's memory gets its first values.
  for (unsigned i = 0; i < 250; ++i) bench.bus_clock();
  for (unsigned i = 0; i < 400; ++i) {
    Answer answer;
    switch (random.below(5)) {
      case 0: {
        const unsigned strobes = random.below(16);
        const std::uint32_t data = random.below(1U << 16U) & 0xFFFE;
        answer = bench.write(map::kAddrSysCtrl, data, strobes & 0xEU);
        if ((strobes & 2U) != 0) es = static_cast<std::uint8_t>(data >> 8U);
        break;
      }
      case 1:
        answer = bench.read(page::kAddrId);
        ASSERT_EQ(answer.data, 0x454E4305U);
        break;
      case 2: {
        const std::uint64_t begin = bench.core_clocks;
        answer = bench.read(page::kAddrTimeLow);
        // Clocks since the core's reset, which is not much later than the bench's begin.
        ASSERT_LE(answer.data, bench.core_clocks);
        ASSERT_GE(answer.data + 60, begin);
        ASSERT_GT(answer.data, before);
        before = answer.data;
        break;
      }
      case 3:
        answer = bench.read(0xFFC);
        ASSERT_EQ(answer.data, 0U);
        break;
      default:
        answer = bench.read(map::kAddrSysCtrl);
        ASSERT_EQ(answer.data >> 8U & 0xFFU, es);
    }
    ASSERT_EQ(answer.response, kOkay);
    ASSERT_LE(answer.clocks, most);
    for (unsigned rest = random.below(4); rest != 0; --rest) bench.bus_clock();
  }
}

class DslAxilBlock : public testing::TestWithParam<unsigned> {
 protected:
  std::uint64_t period() const { return 1'000'000 / GetParam(); }
  mb4test::Dice random;
};

TEST_P(DslAxilBlock, Accesses_AreDoneOnce) {
  for (unsigned phase = 0; phase < 8; ++phase) {
    Bench<Vdsl_axil> bench(period(), random);
    // 27 clocks of the core with those of TIME_LOW, and a read that begins anew; six of the bus.
    const auto most = static_cast<unsigned>(10 + 40 * kCorePeriod / period());
    use_registers(bench, random, most);
    if (HasFatalFailure()) return;
  }
}

TEST_P(DslAxilBlock, CoreWithoutItsClock_ErrorAnswersAndTheWriteIsDoneLater) {
  for (unsigned turn = 0; turn < 30; ++turn) {
    Bench<Vdsl_axil> bench(period(), random);
    ASSERT_EQ(bench.write(0, 0x1100, 2).response, kOkay);
    bench.core_runs = false;
    const bool writes = random.below(2) != 0;
    Answer answer = writes ? bench.write(0, 0x2200, 2) : bench.read(page::kAddrId);
    const unsigned further = random.below(4);
    for (unsigned i = 0; i <= further; ++i) {
      ASSERT_EQ(answer.response, kError) << "access " << i;
      ASSERT_EQ(answer.data, 0U);
      ASSERT_GE(answer.clocks, kWaitLimit);
      ASSERT_LE(answer.clocks, kWaitLimit + 6);
      // Never done: the first one is on its way.
      if (i < further) answer = random.below(2) != 0 ? bench.write(0, 0x3300, 2) : bench.read(0);
    }
    bench.core_runs = true;
    const std::uint32_t expected = writes ? 0x22 : 0x11;
    // The first read comes while the answer of the old access does.
    for (unsigned i = 0; i < 3; ++i) {
      const Answer now = bench.read(i == 1 ? page::kAddrId : 0U);
      ASSERT_EQ(now.response, kOkay);
      ASSERT_EQ(i == 1 ? now.data : now.data >> 8U & 0xFFU, i == 1 ? 0x454E4305U : expected);
    }
  }
}

// Either side can be reset at any time.
TEST_P(DslAxilBlock, ResetOfOneSide_WritesNothingTwice) {
  for (unsigned turn = 0; turn < 60; ++turn) {
    Bench<Vdsl_axil> bench(period(), random);
    ASSERT_EQ(bench.write(0, 0x1100, 2).response, kOkay);
    if (random.below(2) != 0) bench.read(0);
    const bool bus = random.below(2) != 0;
    if (bus && random.below(2) != 0) {
      // In the middle of an access.
      bench.m.s_axi_araddr = page::kAddrTimeLow;
      bench.m.s_axi_arvalid = 1;
      for (unsigned i = random.below(20); i != 0; --i) bench.bus_clock();
    }
    (bus ? bench.m.s_axi_aresetn : bench.m.rst_ni) = 0;
    bench.m.s_axi_arvalid = 0;
    bench.m.eval();
    for (unsigned i = 0; i < 5 + 30'000 / period(); ++i) bench.bus_clock();
    (bus ? bench.m.s_axi_aresetn : bench.m.rst_ni) = 1;
    bench.m.eval();
    for (unsigned i = random.below(2) * 20; i != 0; --i) bench.bus_clock();
    const Answer es = bench.read(0);
    ASSERT_EQ(es.response, kOkay);
    ASSERT_EQ(es.data >> 8U & 0xFFU, bus ? 0x11U : 0x01U);
    ASSERT_EQ(bench.read(page::kAddrId).data, 0x454E4305U);
  }
}

// A reset of the core in each part of an access: an answer without an error is the core's own.
TEST_P(DslAxilBlock, ResetOfTheCore_NoAnswerThatItDidNotGive) {
  const auto access = static_cast<unsigned>(10 + 16 * kCorePeriod / period());
  for (unsigned turn = 0; turn < 2000; ++turn) {
    Bench<Vdsl_axil> bench(period(), random);
    if (random.below(2) != 0) bench.read(0);
    bench.reset_core(1 + random.below(access), random.below(6));
    const bool writes = random.below(4) == 0;
    const Answer first = writes ? bench.write(0, 0x1100, 2) : bench.read(page::kAddrId);
    ASSERT_TRUE(first.response == kOkay || first.data == 0U) << turn;
    if (!writes && first.response == kOkay) {
      ASSERT_EQ(first.data, 0x454E4305U) << turn;
    }
    const Answer second = bench.read(page::kAddrId);
    ASSERT_EQ(second.response, kOkay) << turn;
    ASSERT_EQ(second.data, 0x454E4305U) << turn;
  }
}

INSTANTIATE_TEST_SUITE_P(Clocks, DslAxilBlock, testing::Values(10U, 75U, 100U, 250U),
                         [](const auto& mhz) { return std::to_string(mhz.param) + "MHz"; });

TEST(DslAxilSameBlock, SameClock_HasNoCrossing) {
  mb4test::Dice random;
  Bench<Vdsl_axil_same> bench(0, random);
  use_registers(bench, random, 40);
  EXPECT_EQ(bench.read(page::kAddrFeatures).data, 0x10DU);  // SDK_MAP and its defaults
  EXPECT_LE(bench.read(page::kAddrId).clocks, 11U);
}

}  // namespace
