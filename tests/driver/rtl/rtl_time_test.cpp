// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Time limits of the driver on the Verilated chip, on buses faster than SPI and with coarse clocks.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "sim/lines/clocked/actuator.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::Error;
using mb4test::Chip;
using mb4test::config26;
namespace sim = mb4::sim;

// Bus cycles of `cycle_ns`, and a clock that counts in steps of `step_us`.
struct Fast {
  class Clock {
   public:
    Clock(sim::Simulator& simulator, std::uint32_t step_us)
        : simulator_(simulator), step_us_(step_us) {}
    std::uint32_t now_us() {
      simulator_.advance(20 * sim::kPsPerNs);
      const auto us = static_cast<std::uint32_t>(simulator_.now() / sim::kPsPerUs);
      return us / step_us_ * step_us_;
    }

   private:
    sim::Simulator& simulator_;
    std::uint32_t step_us_;
  };

  Fast(const std::string& host, std::uint32_t step_us,
       const std::string& line =
           "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n"
           "data = 0xABF\n")
      : simulator(sim::parse_scenario("[host]\n" + host + "\n[[channel]]\nnumber = 1\n" + line,
                                      "test.toml")),
        bus(simulator),
        clock(simulator, step_us),
        device(bus, clock) {}

  sim::Simulator simulator;
  mb4::tool::SimBus bus;
  Clock clock;
  mb4::Device<mb4::tool::SimBus, Clock> device;
};

// 100 kHz and the slowest MA; the limit of a frame is its periods and 200 us.
TEST(DriverTime, BusCyclesOf110Ns_HealthyFramesDoNotTimeOut) {
  for (const std::uint32_t limit_hz : {10'000'000U, 1'000'000U, 100'000U, 62'500U}) {
    for (const std::uint32_t step_us : {1U, 31U}) {
      Fast chip("interface = \"intel\"\ncycle_ns = 110", step_us);
      const mb4::Config config = config26(mb4::ma_hz_at_most(20'000'000, limit_hz));
      ASSERT_TRUE(chip.device.configure(config).ok());
      for (int i = 0; i < 20; ++i) {
        const mb4::Result<mb4::Reading> reading = chip.device.read_frame();
        EXPECT_TRUE(reading.ok()) << limit_hz << " Hz, steps of " << step_us
                                  << " us: " << mb4::to_string(reading.error());
        chip.simulator.advance(40 * sim::kPsPerUs);
      }
    }
  }
}

// Frames every millisecond, words of one byte: the driver reads one byte until the banks switch. A
// word that is in one bank only would alternate with the word before.
TEST(DriverTime, BusCyclesOf110Ns_ActuatorWordIsInBothBanks) {
  Fast chip("interface = \"intel\"\ncycle_ns = 110", 1,
            "mo = true\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 8\n"
            "actuator = true\n");
  mb4::Config config = config26(2'000'000);
  config.mo = true;
  config.slaves[0].data_bits = 8;
  config.slaves[0].flags = mb4::Flags::kNone;
  config.slaves[0].actuator = true;
  config.slaves[0].stop_bit = true;
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = mb4::frame_period_clk_at_least(config.f_clk_hz, 1'000'000);
  config.frame_timeout_us = 200;
  const mb4::Result<void> configured = chip.device.configure(config);
  ASSERT_TRUE(configured.ok()) << mb4::to_string(configured.info().field);
  ASSERT_TRUE(chip.device.automatic().start().ok());
  for (const std::uint64_t word : {0xA5U, 0x3CU, 0x81U}) {
    const std::uint64_t frames = chip.simulator.slave(1)->frames();
    while (chip.simulator.slave(1)->frames() == frames) chip.simulator.advance(sim::kPsPerUs);
    chip.simulator.advance(100 * sim::kPsPerUs);  // the longest wait lies ahead
    ASSERT_TRUE(chip.device.write_actuator(1, word).ok());
    chip.simulator.advance(2'000 * sim::kPsPerUs);
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(clocked(chip.simulator.slave(1))->actuator()->word(), word) << i;
      chip.simulator.advance(1'000 * sim::kPsPerUs);
    }
  }
}

// A limit that the caller has set is kept from below also with the coarsest clock that is allowed.
TEST(DriverTime, CoarseClock_LimitOfTheCallerIsNotCutShort) {
  for (const std::uint32_t step_us : {1U, 31U}) {
    Fast chip("interface = \"spi\"\nsclk_hz = 10000000", step_us);
    mb4::Config config = config26(1'000'000);
    config.frame_timeout_us = 45;  // the frame takes 39 us
    ASSERT_TRUE(chip.device.configure(config).ok());
    for (int i = 0; i < 40; ++i) {
      EXPECT_TRUE(chip.device.read_frame().ok()) << step_us << " us, read " << i;
      chip.simulator.advance((40'000 + 777 * i) * sim::kPsPerNs);
    }
  }
}

// Without a slave on the line the limit ends the frame all the same.
TEST(DriverTime, NoSlave_TimesOutWithinTheLimitAndTwoSteps) {
  for (const std::uint32_t step_us : {1U, 31U}) {
    Fast chip("interface = \"intel\"\ncycle_ns = 110", step_us);
    mb4::Config config = config26(1'000'000);
    config.frame_timeout_us = 500;
    ASSERT_TRUE(chip.device.configure(config).ok());
    clocked(chip.simulator.line(1))->faults().stick(true);
    chip.simulator.refresh_lines();
    const sim::Time begin = chip.simulator.now();
    EXPECT_EQ(chip.device.read_frame().error(), Error::kTimeout);
    const auto us = (chip.simulator.now() - begin) / sim::kPsPerUs;
    EXPECT_GE(us, 500U);
    EXPECT_LE(us, 500U + 2 * 33U) << step_us;
  }
}

}  // namespace
