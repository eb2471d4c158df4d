// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_pru at rest (sim/model/model_rest.hpp): two masters see the same random session, one of them
// computes every clock. Pins, clocks and registers are the same, and so are time, trigger and
// OVERHEAD.
#include <cstdio>

#include "sim/core/random.hpp"
#include "tests/chip/pru/pru_sim.hpp"

namespace mb4test {
namespace {

sim::SimulatorOptions evaluation(bool plain) {
  sim::SimulatorOptions options;
  options.plain_evaluation = plain;
  return options;
}

class PruRest : public testing::TestWithParam<std::uint64_t> {};

TEST_P(PruRest, LeftOutClocks_ChangeNothing) {
  const std::string encoder = pru_scenario(
      "[[channel]]\nnumber = 1\ndelay_ns = 130\njitter_ns = 5\n[[channel.slave]]\n"
      "protocol = \"biss-c\"\ndata_bits = 14\ncrc = 0x43\nsource = \"ramp\"\nstep = 3\n"
      "timeout = 12.5\n[[fault]]\nkind = \"clock-stop\"\nat_us = 900\nfor_us = 3\n",
      GetParam());
  sim::Random random(1);
  PruSim plain(encoder, evaluation(true));
  PruSim fast(encoder, evaluation(false));
  constexpr const char* kPins[] = {"ma_o", "sl_i", "irq_o", "trigger_i", "rst_ni"};
  constexpr unsigned kRates[] = {1, 2, 5, 10};
  constexpr unsigned kSteps = 300;
  for (unsigned step = 0; step < kSteps; ++step) {
    SCOPED_TRACE(step);
    const std::uint64_t what = random.up_to(9);
    const auto value = static_cast<std::uint32_t>(random.next());
    const sim::Time pause =
        random.up_to(1) == 0 ? random.up_to(3'000'000) : random.up_to(300'000'000);
    for (PruSim* side : {&plain, &fast}) {
      switch (what) {
        case 0:
          side->write(prureg::kAddrLengths, 12U | 8U << 8U | kRates[value % 4] << 16U);
          break;
        case 1:
        case 2:
          side->write(prureg::kAddrRun, value % 8 == 0 ? 0U : 1U);
          break;
        case 3:
          side->write(prureg::kAddrTriggerPeriod, value % 5 == 0 ? 0U : value % 40'000);
          break;
        case 4:
          side->write(prureg::kAddrOverhead, value % 9000);
          break;
        case 5:
          side->write(prureg::kAddrCtrl, value);
          break;
        case 6:
          side->simulator.set_pin(*side->simulator.pin_by_name("trigger_i"), value % 2 != 0);
          break;
        case 7:
          side->write(prureg::kAddrIrqStatus, 0x1F);
          side->write(prureg::kAddrIrqEnable, value % 32);
          break;
        case 8:
          if (value % 4 == 0) {
            side->simulator.set_pin(*side->simulator.pin_by_name("rst_ni"), false);
            side->simulator.advance(200'000);
            side->simulator.set_pin(*side->simulator.pin_by_name("rst_ni"), true);
          }
          break;
        default:
          break;
      }
      side->simulator.advance(pause);
    }
    ASSERT_EQ(plain.simulator.clk_cycles(), fast.simulator.clk_cycles());
    for (const char* name : kPins) {
      ASSERT_EQ(plain.simulator.pin(*plain.simulator.pin_by_name(name)),
                fast.simulator.pin(*fast.simulator.pin_by_name(name)))
          << name;
    }
    // The last address may be that of the time, whose word then moves at rest.
    for (std::uint32_t address = 0; address <= prureg::kAddrLatchTime; address += 4) {
      const std::uint32_t real = step % 3 == 0 ? prureg::kAddrLatchTime - address : address;
      ASSERT_EQ(plain.read(real), fast.read(real)) << real;
    }
    if (step % 3 == 1) {
      ASSERT_EQ(plain.read(prureg::kAddrTimeLow), fast.read(prureg::kAddrTimeLow));
    }
  }
  EXPECT_EQ(plain.simulator.clk_cycles_left_out(), 0U);
  EXPECT_GT(fast.simulator.clk_cycles_left_out(), fast.simulator.clk_cycles() / 2);
  EXPECT_GT(fast.simulator.slave(1)->frames(), kSteps / 4);
}

INSTANTIATE_TEST_SUITE_P(Clocks, PruRest, testing::Values(80'000'000U, 200'000'000U),
                         [](const auto& test) { return std::to_string(test.param); });

// A frame each 100 us: only frames and what is around counts cost clocks.
TEST(PruRestCost, RestOfAPeriod_IsLeftOut) {
  PruSim pru(pru_scenario(
      "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 14\n"
      "crc = 0x43\n"));
  pru.start(12, 8, 5);
  const std::uint64_t clocks = pru.simulator.clk_cycles();
  const std::uint64_t left_out = pru.simulator.clk_cycles_left_out();
  for (unsigned i = 0; i < 100; ++i) pru.frame();
  // 25 periods of 40 clocks, the encoder's timeout, and the accesses.
  const double computed = static_cast<double>(pru.simulator.clk_cycles() - clocks -
                                              (pru.simulator.clk_cycles_left_out() - left_out));
  std::printf("%.0f clocks computed in a frame\n", computed / 100);
  EXPECT_LT(computed / 100, 2500);
}

}  // namespace
}  // namespace mb4test
