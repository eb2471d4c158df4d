// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// biss_clb at rest (sim/model/model_rest.hpp): two masters see the same random session, one of them
// computes every clock. Pins, clocks and registers are the same, and so is the time of the page.
#include <iterator>

#include "sim/core/random.hpp"
#include "sim/hosts/word_host.hpp"
#include "tests/chip/clb/clb_bench.hpp"

namespace mb4test {
namespace {

sim::SimulatorOptions evaluation(bool plain) {
  sim::SimulatorOptions options;
  options.plain_evaluation = plain;
  return options;
}

const std::string kEncoder =
    "[[channel]]\nnumber = 1\ndelay_ns = 130\njitter_ns = 5\n[[channel.slave]]\n"
    "protocol = \"biss-c\"\ndata_bits = 14\ncrc = 0x43\nsource = \"ramp\"\nstep = 3\n"
    "timeout = 12.5\n[[fault]]\nkind = \"clock-stop\"\nat_us = 900\nfor_us = 3\n";

struct Side {
  explicit Side(bool plain)
      : simulator(sim::parse_scenario(clb_scenario(kEncoder), "test.toml"), evaluation(plain)),
        host(*simulator.word_bus()) {}
  void write(std::uint32_t address, std::uint32_t value) {
    ASSERT_EQ(host.write(address, value, 0xF), std::uint8_t{0});
  }
  std::uint32_t read(std::uint32_t address) {
    std::uint32_t value = 0;
    EXPECT_EQ(host.read(address, value), std::uint8_t{0});
    return value;
  }
  void frame(unsigned half, bool stops) {
    for (const std::uint32_t address : {clbreg::kAddrClkGpreg, clbreg::kAddrClkLoadEn,
                                        clbreg::kAddrFsmLoadEn, clbreg::kAddrSpiffrx}) {
      write(address, 0);
    }
    for (const std::uint32_t address :
         {clbreg::kAddrClkCounter0Match1, clbreg::kAddrClkCounter1Match1}) {
      write(address, half - 1);
      write(address + (clbreg::kAddrClkCounter0Match2 - clbreg::kAddrClkCounter0Match1),
            2 * half - 1);
    }
    write(clbreg::kAddrSpiccr, clbreg::SPISWRESET::kMask | 11U);
    write(clbreg::kAddrSpiffrx, clbreg::RXFIFORESET::kMask | clbreg::RXFFIENA::kMask | 2U);
    write(clbreg::kAddrIrqEnable, 0xFF);
    write(clbreg::kAddrFsmHlcR0, 22);
    write(clbreg::kAddrClkLoadEn, clbreg::CLK_GLOBAL_EN::kMask);
    write(clbreg::kAddrFsmLoadEn, clbreg::FSM_GLOBAL_EN::kMask);
    write(clbreg::kAddrFsmGpreg, 0x80);
    write(clbreg::kAddrFsmGpreg, 0x81);
    write(clbreg::kAddrClkGpreg, 1);
    simulator.advance(30 * sim::kPsPerUs);
    if (stops) write(clbreg::kAddrClkGpreg, 0);
  }

  sim::Simulator simulator;
  sim::WordHost& host;
};

TEST(ClbRest, LeftOutClocks_ChangeNothing) {
  sim::Random random(1);
  Side plain(true);
  Side fast(false);
  constexpr unsigned kSteps = 120;
  for (unsigned step = 0; step < kSteps; ++step) {
    SCOPED_TRACE(step);
    const auto half = static_cast<unsigned>(4 + random.up_to(30));
    const bool stops = random.up_to(1) != 0;
    const bool reset = random.up_to(15) == 0;
    const sim::Time pause = random.up_to(1) == 0 ? random.up_to(30'000) : random.up_to(300'000'000);
    for (Side* side : {&plain, &fast}) {
      const sim::Pin pin = *side->simulator.pin_by_name("rst_ni");
      if (reset) {
        side->simulator.set_pin(pin, false);
        side->simulator.advance(77 * sim::kPsPerNs);
        side->simulator.set_pin(pin, true);
        side->simulator.advance(77 * sim::kPsPerNs);
      }
      side->frame(half, stops);
      side->simulator.advance(pause);  // not only at edges of the clock
    }
    ASSERT_EQ(plain.simulator.now(), fast.simulator.now());
    ASSERT_EQ(plain.simulator.clk_cycles(), fast.simulator.clk_cycles());
    for (const char* name : {"ma_o", "sl_i", "irq_o", "spi_clk_o", "txen_o"}) {
      ASSERT_EQ(plain.simulator.pin(*plain.simulator.pin_by_name(name)),
                fast.simulator.pin(*fast.simulator.pin_by_name(name)))
          << name;
    }
    ASSERT_EQ(plain.simulator.slave(1)->frames(), fast.simulator.slave(1)->frames());
    // SPIRXBUF takes a word out on both sides. The last ones are TIME_LOW and TIME_HIGH.
    for (std::uint32_t address = 0; address <= clbreg::kAddrWatchdog; address += 4) {
      ASSERT_EQ(plain.read(address), fast.read(address)) << address;
    }
  }
  EXPECT_EQ(plain.simulator.clk_cycles_left_out(), 0U);
  // Half of the pauses have 0.15 ms on average.
  EXPECT_GT(fast.simulator.clk_cycles_left_out(), fast.simulator.clk_cycles() / 2);
  EXPECT_GT(fast.simulator.slave(1)->frames(), kSteps - 1U);
}

// After 2^32 clocks the high word of the time counts.
TEST(ClbRest, TimeOfThePage_PassesItsLowWord) {
  Side fast(false);
  const std::uint64_t first = fast.simulator.clk_cycles();
  const std::uint64_t before = fast.read(clbreg::kAddrTimeLow);
  const std::uint64_t start = fast.simulator.clk_cycles();
  fast.simulator.advance(30 * sim::kPsPerSecond);
  const std::uint64_t low = fast.read(clbreg::kAddrTimeLow);
  const std::uint64_t clocks = fast.simulator.clk_cycles() - start;
  const std::uint64_t high = fast.read(clbreg::kAddrTimeHigh);
  EXPECT_GT(clocks, std::uint64_t{1} << 32U);
  EXPECT_EQ((high << 32U | low) - before, clocks);
  EXPECT_GT(fast.simulator.clk_cycles_left_out() + 10'000, fast.simulator.clk_cycles() - first);
}

}  // namespace
}  // namespace mb4test
