// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A control loop that ticks with the period of the frames, at every phase to them, on the Verilated
// chip: positions beside a register access (pages 26, 33; tables 48, 69; decision 15).

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "drivers/c/mb4_c_access.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::Error;
using mb4test::Chip;
using mb4test::config26;
namespace sim = mb4::sim;

struct Loop {
  std::uint32_t sclk_hz;
  std::uint32_t frames_hz;
  mb4::SpiCheck check;
  bool omits;        // AGSERR_ON_HOLDBANK
  bool hold = true;  // Config::hold_beside_access
};

std::string name_of(const testing::TestParamInfo<Loop>& test) {
  return "Sclk" + std::to_string(test.param.sclk_hz / 1'000'000) + "MHz_Frames" +
         std::to_string(test.param.frames_hz) + "Hz_Check" +
         std::to_string(static_cast<int>(test.param.check)) +
         (test.param.omits ? "_Omits" : "_Overwrites") + (test.param.hold ? "" : "_Unheld");
}

std::string scenario(const Loop& loop) {
  return std::string("[chip.quirks]\nAGSERR_ON_HOLDBANK = ") + (loop.omits ? "true" : "false") +
         "\n[host]\nsclk_hz = " + std::to_string(loop.sclk_hz) +
         "\n[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n"
         "source = \"ramp\"\nstep = 1\nregisters = { 0x44 = [0x00, 0xD9, 0x01, 0x32] }\n";
}

constexpr unsigned kPhases = 25;

// What a loop has seen while an access ran.
struct Seen {
  unsigned ticks = 0;
  unsigned positions = 0;
  Error last = Error::kNone;
};

// Reads 15 registers, which takes 243 frames, while the loop reads positions.
Seen run(const Loop& loop, unsigned phase) {
  Chip chip(scenario(loop));
  mb4::Config config = config26(10'000'000);
  config.spi_check = loop.check;
  config.hold_beside_access = loop.hold;
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk =
      mb4::frame_period_clk_at_least(config.f_clk_hz, 1'000'000'000U / loop.frames_hz);
  EXPECT_TRUE(chip.device.configure(config).ok());
  const sim::Time period = config.frame_period_clk * (sim::kPsPerSecond / config.f_clk_hz);
  EXPECT_TRUE(chip.device.automatic().start().ok());
  sim::Time tick = chip.simulator.now() + 2 * period + period * phase / kPhases;
  chip.simulator.run_until(tick);
  static_cast<void>(chip.device.automatic().poll_slave(1));
  EXPECT_TRUE(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x44, 15).ok());
  Seen seen;
  std::uint64_t last = 0;
  for (bool running = true; running && seen.ticks < 300;) {
    // A tick that comes while the loop is still busy is lost.
    for (tick += period; tick < chip.simulator.now(); tick += period) ++seen.ticks;
    chip.simulator.run_until(tick);
    const mb4::Result<mb4::Reading> reading = chip.device.automatic().poll_slave(1);
    ++seen.ticks;
    if (reading) {
      EXPECT_GT(reading->position, last) << "old, phase " << phase;
      last = reading->position;
      ++seen.positions;
    } else {
      seen.last = reading.error();
    }
    const mb4::Result<bool> ended = mb4_c::PolledAccess(chip.device).poll();
    EXPECT_TRUE(ended.ok()) << mb4::to_string(ended.error());
    running = ended && !*ended;
  }
  std::array<std::uint8_t, 15> bytes{};
  EXPECT_TRUE(mb4_c::PolledAccess(chip.device).take(bytes).ok()) << "phase " << phase;
  EXPECT_EQ(bytes[1], 0xD9);
  EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->counters().reads, 15U);
  return seen;
}

class DriverBesideAccess : public testing::TestWithParam<Loop> {};

// At least 99 % of the ticks bring a position, at each of 25 phases. Without HOLDBANK every second
// one at the phases where a frame ends within the transfers.
TEST_P(DriverBesideAccess, EveryPhase_PositionsGoOn) {
  for (unsigned phase = 0; phase < kPhases; ++phase) {
    const Seen seen = run(GetParam(), phase);
    EXPECT_GE(seen.ticks, 235U);
    EXPECT_GE(seen.positions * 100, seen.ticks * (GetParam().hold ? 99 : 50))
        << "phase " << phase << ": " << seen.positions << " of " << seen.ticks << ", "
        << mb4::to_string(seen.last);
  }
}

INSTANTIATE_TEST_SUITE_P(Loops, DriverBesideAccess,
                         testing::Values(Loop{5'000'000, 1'000, mb4::SpiCheck::kFull, false},
                                         Loop{5'000'000, 10'000, mb4::SpiCheck::kFull, false},
                                         Loop{5'000'000, 10'000, mb4::SpiCheck::kFull, true},
                                         Loop{5'000'000, 10'000, mb4::SpiCheck::kOff, false, false},
                                         Loop{5'000'000, 16'000, mb4::SpiCheck::kFull, false},
                                         Loop{5'000'000, 20'000, mb4::SpiCheck::kCrc, false},
                                         Loop{5'000'000, 20'000, mb4::SpiCheck::kOff, false},
                                         Loop{5'000'000, 20'000, mb4::SpiCheck::kOff, true},
                                         Loop{10'000'000, 1'000, mb4::SpiCheck::kFull, false},
                                         Loop{10'000'000, 20'000, mb4::SpiCheck::kFull, false},
                                         Loop{10'000'000, 20'000, mb4::SpiCheck::kFull, true},
                                         Loop{10'000'000, 32'000, mb4::SpiCheck::kFull, false},
                                         Loop{10'000'000, 32'000, mb4::SpiCheck::kCrc, false},
                                         Loop{10'000'000, 32'000, mb4::SpiCheck::kOff, false},
                                         Loop{10'000'000, 32'000, mb4::SpiCheck::kOff, true}),
                         name_of);

}  // namespace
