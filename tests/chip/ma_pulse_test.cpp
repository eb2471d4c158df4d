// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// No pulse at MA is shorter than half of the configured period (I302, I303), whatever cuts a frame.
// The guard at the MA pins ends a simulation that breaks this: see MaGuard and MaPulseCheck in
// tests/unit. The MA force bits: ma_force_test.cpp.
#include <gtest/gtest.h>

#include <string>

#include "chip_fixture.hpp"

namespace {

using mb4test::Chip;
using mb4test::one_slave;
namespace sim = mb4::sim;

const char kEncoder[] = "data_bits = 28\ncrc = 0x43\ndata = 0xAAF37BF";
const char kInternal[] = "f_clk_hz = 0\nf_osc_hz = 25000000\n";

// Half a period of MA in ns for a code of FREQS.
sim::Time half_ns(unsigned freqs, sim::Time clk_ns) {
  return (freqs < 0x10 ? freqs + 1 : 10 * (freqs - 15)) * clk_ns;
}

// A good frame, as a proof that everything has recovered. Ends a chip that was reset.
void expect_good_frame(Chip& chip, std::uint8_t freqs, const std::string& what) {
  chip.configure_slave1(28, 0x06, freqs);
  chip.advance_us(100);
  chip.instruct(0x04);
  ASSERT_TRUE(chip.wait_eot()) << what;
  EXPECT_EQ(chip.read(0xF1) & 0x02, 0x02) << what;
  EXPECT_EQ(chip.read(0x00, 4), (std::vector<std::uint8_t>{0xBF, 0x37, 0xAF, 0x0A})) << what;
}

struct Cut {
  std::uint8_t freqs;
  std::uint8_t instr;  // 0x04: CDM = 0, 0x02: CDM = 1, 0x10: INIT
};

class MaPulse : public testing::TestWithParam<Cut> {
 protected:
  // Runs `cut` at many phases of a frame, off the clock's grid; each time on a new chip.
  template <typename Action>
  void at_every_phase(const std::string& chip_keys, sim::Time clk_ns, Action cut) {
    const auto [freqs, instr] = GetParam();
    const sim::Time half = half_ns(freqs, clk_ns);
    constexpr unsigned kPhases = 45;  // over half a frame, none twice at the same phase of MA
    for (unsigned phase = 0; phase < kPhases; ++phase) {
      Chip chip(one_slave(kEncoder, "delay_ns = 90.0", chip_keys));
      if (!chip_keys.empty()) chip.write(0xF5, {0x01});
      chip.configure_slave1(28, 0x06, freqs);
      if (instr == 0x02) chip.write(0xE5, {0x41});  // HOLDCDM: MA rests low
      chip.instruct(instr);
      chip.simulator.advance(phase * half * sim::kPsPerNs * 8 / 7 + phase * 3137);
      const bool ma = chip.simulator.pin(sim::Pin::kMa1);
      const std::string what = "phase " + std::to_string(phase) + ", MA " + std::to_string(ma);
      ASSERT_NO_THROW(cut(chip)) << what;
      if (testing::Test::HasFatalFailure()) return;
      EXPECT_TRUE(chip.simulator.pin(sim::Pin::kMa1)) << what;
      ASSERT_NO_THROW(expect_good_frame(chip, freqs, what)) << what;
      EXPECT_GE(chip.simulator.ma_check(1).pulses(), 2U * (28U + 6U + 4U));
    }
  }
};

TEST_P(MaPulse, BreakAtAnyPhase_CutsNothingShort) {
  at_every_phase("", 50, [](Chip& chip) {
    chip.instruct(0x80);
    chip.advance_us(200);
  });
}

// The reset is asynchronous and shorter than half a period; MA ends its low level all the same.
TEST_P(MaPulse, ResetAtAnyPhase_CutsNothingShort) {
  at_every_phase("", 50, [](Chip& chip) {
    chip.simulator.set_pin(sim::Pin::kNres, false);
    chip.simulator.advance(251 * sim::kPsPerNs);
    chip.simulator.set_pin(sim::Pin::kNres, true);
    chip.advance_us(200);
  });
}

// Reset selects pin CLK again. Nothing clocks the chip then until CLKENI is set.
TEST_P(MaPulse, ResetOnTheOscillator_CutsNothingShort) {
  at_every_phase(kInternal, 40, [](Chip& chip) {
    chip.simulator.set_pin(sim::Pin::kNres, false);
    chip.simulator.advance(251 * sim::kPsPerNs);
    chip.simulator.set_pin(sim::Pin::kNres, true);
    chip.advance_us(20);
    chip.write(0xF5, {0x01});
    chip.advance_us(200);
  });
}

// CLKENI in the middle of a frame: the frame goes on with the other clock.
TEST_P(MaPulse, ClockSwitchAtAnyPhase_CutsNothingShort) {
  for (const unsigned osc : {12'500'000U, 25'000'000U}) {
    at_every_phase("f_osc_hz = " + std::to_string(osc) + "\n", 50, [](Chip& chip) {
      chip.write(0xF5, {0x00});
      chip.advance_us(20);
      chip.write(0xF5, {0x01});
      chip.instruct(0x80);
      chip.advance_us(300);
    });
  }
}

// The MA force bits in the middle of a frame, and released again.
TEST_P(MaPulse, ForcedAtAnyPhase_CutsNothingShort) {
  for (const unsigned level : {0x00U, 0x20U}) {
    at_every_phase("", 50, [level](Chip& chip) {
      chip.write(0xF5, {static_cast<std::uint8_t>(0x10U | level)});
      chip.advance_us(20);
      chip.write(0xF5, {0x00});
      chip.instruct(0x80);
      chip.advance_us(200);
    });
  }
}

// BREAK and the next frame as fast as the host can write them.
TEST_P(MaPulse, BreakAndNewFrameAtOnce_CutNothingShort) {
  at_every_phase("", 50, [](Chip& chip) {
    chip.simulator.spi().set_timing(sim::SpiTiming::for_frequency(50'000'000));
    chip.instruct(0x80);
    chip.instruct(0x04);
    chip.instruct(0x82);
    chip.instruct(0x80);
    chip.advance_us(200);
  });
}

INSTANTIATE_TEST_SUITE_P(Cuts, MaPulse,
                         testing::Values(Cut{0x00, 0x04}, Cut{0x00, 0x02}, Cut{0x01, 0x04},
                                         Cut{0x04, 0x02}, Cut{0x09, 0x04}, Cut{0x09, 0x10},
                                         Cut{0x11, 0x02}),
                         [](const auto& entry) {
                           return "Freqs" + std::to_string(entry.param.freqs) + "_Instr" +
                                  std::to_string(entry.param.instr);
                         });

}  // namespace
