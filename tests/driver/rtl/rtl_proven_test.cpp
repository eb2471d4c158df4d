// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// SpiCheck::kFull, and an encoder that is gone: no transfer that is lost or disturbed, in the call
// before or in the read itself, turns a word from before into a position. Each call leaves SVALID
// of frames that it has made, or that have run, and the frame of the read is refused.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/driver/rtl/fault_bus.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::Config;
using mb4::Error;
using mb4::FrameStart;
using mb4test::Fault;
using mb4test::FaultKind;
using mb4test::FaultyChip;
namespace sim = mb4::sim;

const std::string kEncoder =
    "[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = "
    "\"biss-c\"\ncontrol = true\ndata_bits = 28\nsource = \"ramp\"\nstep = 4\n";

enum class Before : std::uint8_t { kStop, kActivate, kConfigure, kFailedRead };

std::string name_of(const testing::TestParamInfo<Before>& test) {
  constexpr std::array<const char*, 4> kNames{"Stop", "Activate", "Configure", "FailedRead"};
  return kNames[static_cast<unsigned>(test.param)];
}

class DriverProven : public testing::TestWithParam<Before> {
 protected:
  static Config config() {
    Config config = mb4test::config26(10'000'000);
    config.spi_check = mb4::SpiCheck::kFull;
    config.frame_start = FrameStart::kPeriodic;
    config.frame_period_clk = 20 * 100;
    return config;
  }
  // Frames of both banks have set SVALID, and nobody has read them.
  static void prepare(FaultyChip& chip) {
    ASSERT_TRUE(chip.device.configure(config()).ok());
    ASSERT_TRUE(chip.device.automatic().start().ok());
    chip.simulator.advance(350 * sim::kPsPerUs);
    if (GetParam() == Before::kActivate) {
      ASSERT_TRUE(chip.device.automatic().stop().ok());
      chip.simulator.advance(150 * sim::kPsPerUs);
      static_cast<void>(chip.device.read_frame());
      chip.simulator.advance(150 * sim::kPsPerUs);
    }
  }
  static void call(FaultyChip& chip) {
    switch (GetParam()) {
      case Before::kStop:
        static_cast<void>(chip.device.automatic().stop());
        break;
      case Before::kActivate:
        static_cast<void>(chip.device.control().activate());
        break;
      case Before::kConfigure:
        static_cast<void>(chip.device.configure(config()));
        break;
      case Before::kFailedRead:
        static_cast<void>(chip.device.automatic().stop());
        chip.simulator.advance(150 * sim::kPsPerUs);
        static_cast<void>(chip.device.read_frame());
        break;
    }
    chip.simulator.advance(150 * sim::kPsPerUs);
  }
  static void unplug(FaultyChip& chip) {
    clocked(chip.simulator.line(1))->faults().stick(false);
    chip.simulator.refresh_lines();
  }
  static mb4::Result<mb4::Reading> read(FaultyChip& chip) { return chip.device.read_frame(); }
};

TEST_P(DriverProven, EncoderGone_NoFaultBringsAWordFromBefore) {
  std::vector<Fault> in_call;
  std::vector<Fault> in_read;
  {
    FaultyChip chip(kEncoder);
    prepare(chip);
    chip.bus.plan({});
    call(chip);
    std::vector<std::size_t> bits = chip.bus.bits();
    // What comes early in a long call has no part in what it leaves.
    const std::size_t from = bits.size() > 10 ? bits.size() - 10 : 0;
    const std::vector<std::size_t> last(bits.begin() + static_cast<std::ptrdiff_t>(from),
                                        bits.end());
    for (Fault fault : mb4test::all_faults(last, 7)) {
      if (fault.last == mb4test::kForEver) continue;
      fault.first += from;
      fault.last += from;
      in_call.push_back(fault);
    }
    unplug(chip);
    chip.bus.plan({});
    EXPECT_FALSE(read(chip).ok());
    for (const Fault& fault : mb4test::all_faults(chip.bus.bits(), 1)) {
      if (fault.last != mb4test::kForEver) in_read.push_back(fault);
    }
  }
  ASSERT_GE(in_call.size(), 8U);
  ASSERT_GE(in_read.size(), 100U);
  for (const bool early : {true, false}) {
    for (const Fault& fault : early ? in_call : in_read) {
      FaultyChip chip(kEncoder);
      prepare(chip);
      if (early) chip.bus.plan(fault);
      call(chip);
      unplug(chip);
      chip.bus.plan(early ? Fault{} : fault);
      const mb4::Result<mb4::Reading> one = read(chip);
      EXPECT_FALSE(one.ok()) << (early ? "before: " : "in the read: ") << fault.text();
      chip.bus.plan({});
      EXPECT_FALSE(read(chip).ok())
          << "second, " << (early ? "before: " : "in the read: ") << fault.text();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Calls, DriverProven,
                         testing::Values(Before::kStop, Before::kActivate, Before::kConfigure,
                                         Before::kFailedRead),
                         name_of);

}  // namespace
