// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// What a loop over automatic frames is told of bad frames and dead lines, on the Verilated chip,
// with both values of the quirk of decision 15.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::Config;
using mb4::Error;
using mb4::Frame;
using mb4test::Chip;
using mb4test::config26;
namespace sim = mb4::sim;

std::string slave(const std::string& keys) {
  return "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n" + keys + "\n";
}

// Slave 1 on channel 1, slave 5 on channel 2, frames every 100 us.
std::string two_channels(bool omits) {
  return std::string("[chip.quirks]\nAGSERR_ON_HOLDBANK = ") + (omits ? "true" : "false") +
         "\n[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\n" +
         slave("source = \"ramp\"\nstep = 1") + "[[channel]]\nnumber = 2\n" +
         slave("source = \"ramp\"\nstep = 1");
}

Config config(mb4::SpiCheck check) {
  Config config = config26(10'000'000);
  config.channels[1].protocol = mb4::Protocol::kBissC;
  config.slaves[4] = config.slaves[0];
  config.spi_check = check;
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = mb4::frame_period_clk_at_least(config.f_clk_hz, 100'000);
  return config;
}

struct Case {
  mb4::SpiCheck check;
  bool omits;
};

class DriverHealth : public testing::TestWithParam<Case> {
 protected:
  DriverHealth() {
    EXPECT_TRUE(chip.device.configure(config(GetParam().check)).ok());
    EXPECT_TRUE(chip.device.automatic().start().ok());
  }
  void stick(unsigned channel, std::optional<bool> level) {
    clocked(chip.simulator.line(channel))->faults().stick(level);
    chip.simulator.refresh_lines();
  }

  Chip chip{two_channels(GetParam().omits)};
};

// Table 55: nSCDERR does not name the slave.
TEST_P(DriverHealth, OtherSlaveBad_HealthyOneIsNotBlamed) {
  unsigned good = 0;
  unsigned none = 0;
  for (int i = 0; i < 400; ++i) {
    clocked(chip.simulator.line(2))->faults().flip_next_frame({9});
    chip.simulator.advance(31 * sim::kPsPerUs);
    const mb4::Result<mb4::Reading> reading = chip.device.automatic().poll_slave(1);
    good += reading.ok() ? 1 : 0;
    none += reading.error() == Error::kNoData ? 1 : 0;
  }
  EXPECT_EQ(good + none, 400U);
  EXPECT_GT(good, 100U);
  EXPECT_GT(none, 100U);
  // All slaves at once.
  for (int i = 0; i < 40; ++i) {
    clocked(chip.simulator.line(2))->faults().flip_next_frame({9});
    chip.simulator.advance(31 * sim::kPsPerUs);
    Frame frame;
    ASSERT_TRUE(chip.device.automatic().poll(frame).ok());
    EXPECT_NE(frame[1].error(), Error::kCrc) << i;
    EXPECT_FALSE(frame[5].ok()) << i;
  }
}

// Polled six times a frame; some frames are bad. With kOff nothing tells whose frame was bad,
// unless the other slave was good: poll_slave() then says nothing.
TEST_P(DriverHealth, BadFrame_CountsOnce) {
  unsigned bad = 0;
  unsigned told = 0;
  unsigned told_all = 0;
  for (unsigned i = 0; i < 400; ++i) {
    chip.simulator.advance(17 * sim::kPsPerUs);
    bool ended = false;  // just now: the next frame begins later
    if (i % 80 < 40) {
      const Error error = chip.device.automatic().poll_slave(1).error();
      told += error == Error::kCrc ? 1 : 0;
      ended = error == Error::kNone;
    } else {
      Frame frame;
      ASSERT_TRUE(chip.device.automatic().poll(frame).ok());
      // The first poll() meets words that poll_slave() has taken, or not.
      if (i % 40 == 0) continue;
      told_all += frame[1].error() == Error::kCrc ? 1 : 0;
      ended = frame[1].ok();
      EXPECT_NE(frame[5].error(), Error::kCrc) << i;
    }
    if (ended && i / 40 == bad && i % 40 >= 20) {
      clocked(chip.simulator.line(1))->faults().flip_next_frame({9});
      ++bad;
    }
  }
  EXPECT_EQ(bad, 10U);
  EXPECT_EQ(told, GetParam().check == mb4::SpiCheck::kOff ? 0 : bad / 2);
  EXPECT_EQ(told_all, bad / 2);
}

// Slave 1 is bad in every frame, slave 5 is healthy: slave 1 is not silent for ever. With kOff the
// driver says so when no good word of slave 1 has come for two periods.
TEST_P(DriverHealth, OneSlaveAlwaysBad_IsCrcAndNotNoData) {
  unsigned told = 0;
  unsigned told_all = 0;
  for (int i = 0; i < 60; ++i) {
    clocked(chip.simulator.line(1))->faults().flip_next_frame({9});
    chip.simulator.advance(100 * sim::kPsPerUs);
    Frame frame;
    if (i < 30) {
      told += chip.device.automatic().poll_slave(1).error() == Error::kCrc ? 1 : 0;
      EXPECT_NE(chip.device.automatic().poll_slave(5).error(), Error::kCrc);
    } else {
      ASSERT_TRUE(chip.device.automatic().poll(frame).ok());
      told_all += frame[1].error() == Error::kCrc ? 1 : 0;
      EXPECT_TRUE(frame[5].ok()) << i;
    }
  }
  EXPECT_GE(told, 20U);
  EXPECT_GE(told_all, 20U);
}

// poll_slave(1) has taken the good word of slave 1. Slave 5 was bad in the same frame, and then the
// word of slave 5 of the frame before is no reason to blame slave 1.
TEST_P(DriverHealth, PollAfterPollSlave_DoesNotBlameTheGoodSlave) {
  for (int i = 0; i < 100; ++i) {
    if (i % 2 == 1) clocked(chip.simulator.line(2))->faults().flip_next_frame({9});
    chip.simulator.advance((90 + i % 20) * sim::kPsPerUs);
    static_cast<void>(chip.device.automatic().poll_slave(1));
    Frame frame;
    ASSERT_TRUE(chip.device.automatic().poll(frame).ok());
    EXPECT_NE(frame[1].error(), Error::kCrc) << i;
  }
}

// Every frame is bad: each one counts, if the chip stores the CRC. With kOff the driver says so
// when no good one has come for two periods.
TEST_P(DriverHealth, EveryFrameBad_EachCounts) {
  const std::uint64_t before = chip.simulator.slave(1)->frames();
  unsigned told = 0;
  for (int i = 0; i < 400; ++i) {
    clocked(chip.simulator.line(1))->faults().flip_next_frame({9});
    chip.simulator.advance(17 * sim::kPsPerUs);
    told += chip.device.automatic().poll_slave(1).error() == Error::kCrc ? 1 : 0;
  }
  const std::uint64_t frames = chip.simulator.slave(1)->frames() - before;
  if (GetParam().check != mb4::SpiCheck::kOff) {
    EXPECT_LE(told, frames);
    EXPECT_GE(told + 2, frames);
  } else {
    EXPECT_GE(told, 300U);
  }
}

// Unplugged: SL is 1, or 0 where it is shorted. Frames every 100 us, the loop ticks with them.
TEST_P(DriverHealth, DeadLine_IsToldWithinThreeFrames) {
  for (const bool level : {true, false}) {
    for (const bool all : {false, true}) {
      chip.simulator.advance(200 * sim::kPsPerUs);
      ASSERT_TRUE(chip.device.automatic().poll_slave(1).ok());
      stick(1, level);
      // One frame may have ended before, or end with a bad word because the line dies in it.
      Error last = Error::kNone;
      unsigned ticks = 0;
      unsigned good = 0;
      for (; ticks < 10 && last != Error::kTimeout && last != Error::kLineError; ++ticks) {
        chip.simulator.advance(100 * sim::kPsPerUs);
        Frame frame;
        last = all ? chip.device.automatic().poll(frame).error()
                   : chip.device.automatic().poll_slave(1).error();
        const bool read = last == Error::kNone && (!all || frame[1] || frame[5]);
        const bool bad = (all ? frame[1].error() : last) == Error::kCrc;
        // With kOff a bad word shows later, when no good one has come for two periods.
        if (read || (bad && GetParam().check != mb4::SpiCheck::kOff)) good = ticks + 1;
      }
      EXPECT_EQ(last, level ? Error::kTimeout : Error::kLineError) << all;
      EXPECT_LE(ticks - good, 3U) << level << all;
      EXPECT_GE(ticks - good, 2U) << level << all;
      // It goes on until the caller restarts.
      EXPECT_EQ(chip.device.automatic().poll_slave(1).error(), last);
      stick(1, std::nullopt);
      ASSERT_TRUE(chip.device.automatic().restart().ok());
    }
  }
}

// Unplugged directly after a bad frame: nSCDERR stays 0, because no other frame ends.
TEST_P(DriverHealth, DeadLineAfterABadFrame_IsTimeout) {
  for (const bool all : {false, true}) {
    for (const bool one_channel : {false, true}) {
      const Config both = config(GetParam().check);
      const Config used = one_channel ? mb4::without_channel(both, 2) : both;
      ASSERT_TRUE(chip.device.configure(used).ok());
      ASSERT_TRUE(chip.device.automatic().start().ok());
      chip.simulator.advance(250 * sim::kPsPerUs);
      ASSERT_TRUE(chip.device.automatic().poll_slave(1).ok());
      const std::uint64_t before = chip.simulator.slave(1)->frames();
      clocked(chip.simulator.line(1))->faults().flip_next_frame({9});
      for (int i = 0; i < 200 && chip.simulator.slave(1)->frames() == before; ++i) {
        chip.simulator.advance(sim::kPsPerUs);
      }
      chip.simulator.advance(30 * sim::kPsPerUs);
      stick(1, true);
      Error last = Error::kNone;
      unsigned ticks = 0;
      for (; ticks < 20 && last != Error::kTimeout; ++ticks) {
        chip.simulator.advance(100 * sim::kPsPerUs);
        Frame frame;
        last = all ? chip.device.automatic().poll(frame).error()
                   : chip.device.automatic().poll_slave(1).error();
      }
      EXPECT_EQ(last, Error::kTimeout) << all << one_channel;
      EXPECT_LE(ticks, 5U) << all << one_channel;
      EXPECT_EQ(chip.device.automatic().poll_slave(1).error(), Error::kTimeout);
      stick(1, std::nullopt);
    }
  }
}

// A chip that was reset sets no flag: FREQAGS and all slaves are 0. Frames of this configuration
// come back to back. The alarm comes after 16 periods, with the quirk earlier, because the chip
// says that it leaves out frames. At some phases, with kFull at more, a frame ends while the bank
// is held for the look at the lines; then SWBANKFAIL says that frames end, and the alarm comes with
// a later tick (automatic.hpp).
TEST_P(DriverHealth, ChipReset_IsTimeout) {
  constexpr unsigned kPhases = 20;
  unsigned late = 0;
  for (unsigned phase = 0; phase < kPhases; ++phase) {
    Chip one{two_channels(GetParam().omits)};
    ASSERT_TRUE(one.device.configure(config(GetParam().check)).ok());
    ASSERT_TRUE(one.device.automatic().start().ok());
    one.simulator.advance((250'000 + 730 * phase) * sim::kPsPerNs);
    ASSERT_TRUE(one.device.automatic().poll_slave(1).ok());
    const std::array<std::uint8_t, 48> zeros{};
    ASSERT_TRUE(one.device.opcodes().write_registers(0xC0, zeros).ok());
    Error last = Error::kNone;
    unsigned ticks = 0;
    const auto alarm = [&last] { return last == Error::kTimeout || last == Error::kLineError; };
    for (; ticks < 80 && !alarm(); ++ticks) {
      one.simulator.advance(100 * sim::kPsPerUs);
      last = one.device.automatic().poll_slave(1).error();
    }
    // On a bus of words the look at the lines may meet a frame, in which SL is 0.
    EXPECT_TRUE(alarm()) << phase << ": " << mb4::to_string(last);
    // The last good frame may come a tick or two after the reset.
    EXPECT_GE(ticks, GetParam().omits ? 2U : 16U) << phase;
    EXPECT_LE(ticks, 64U + 3U) << phase;
    late += ticks > 16U + 3U ? 1 : 0;
  }
  EXPECT_LE(late, kPhases / 2);
}

// Frames that come late, at a tenth of the loop's rate, and loops slower than the frames: no alarm.
TEST_P(DriverHealth, SlowFramesAndSlowLoops_AreNoDeadLine) {
  for (const unsigned us : {9U, 30U, 99U, 101U, 350U, 2'000U}) {
    for (int i = 0; i < 60; ++i) {
      chip.simulator.advance(us * sim::kPsPerUs);
      const Error error = chip.device.automatic().poll_slave(1).error();
      EXPECT_TRUE(error == Error::kNone || error == Error::kNoData)
          << us << " " << i << " " << mb4::to_string(error);
    }
  }
}

// A frame ends when all its lines have ended: a dead line on channel 1 stops channel 2 as well. The
// driver says so, and channel 2 runs on without channel 1.
TEST_P(DriverHealth, DeadLineOnChannel1_Channel2RunsOnWithoutIt) {
  chip.simulator.advance(200 * sim::kPsPerUs);
  ASSERT_TRUE(chip.device.automatic().poll_slave(5).ok());
  stick(1, true);
  Error last = Error::kNone;
  for (unsigned ticks = 0; ticks < 4; ++ticks) {
    chip.simulator.advance(100 * sim::kPsPerUs);
    last = chip.device.automatic().poll_slave(5).error();
  }
  EXPECT_EQ(last, Error::kTimeout);
  const Config alone = mb4::without_channel(chip.device.config(), 1);
  ASSERT_TRUE(mb4::validate(alone).ok());
  ASSERT_TRUE(chip.device.configure(alone).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  unsigned good = 0;
  for (unsigned ticks = 0; ticks < 20; ++ticks) {
    chip.simulator.advance(100 * sim::kPsPerUs);
    good += chip.device.automatic().poll_slave(5).ok() ? 1 : 0;
  }
  EXPECT_GE(good, 19U);
  // And the other way round.
  const Config other = mb4::without_channel(config(GetParam().check), 2);
  EXPECT_TRUE(mb4::validate(other).ok());
  EXPECT_EQ(mb4::enabled_slaves(other), 0x01);
  EXPECT_EQ(other.channels[0].protocol, mb4::Protocol::kBissC);
}

INSTANTIATE_TEST_SUITE_P(Checks, DriverHealth,
                         testing::Values(Case{mb4::SpiCheck::kFull, false},
                                         Case{mb4::SpiCheck::kFull, true},
                                         Case{mb4::SpiCheck::kCrc, false},
                                         Case{mb4::SpiCheck::kOff, false},
                                         Case{mb4::SpiCheck::kOff, true}),
                         [](const auto& test) {
                           return "Check" + std::to_string(static_cast<int>(test.param.check)) +
                                  (test.param.omits ? "_Omits" : "_Overwrites");
                         });

// A clock that says how fine it is.
struct FineClock {
  static constexpr std::uint32_t kStepUs = 1;
  std::uint32_t now_us() { return static_cast<std::uint32_t>(simulator.now() / sim::kPsPerUs); }
  sim::Simulator& simulator;
};

// Frames at 32 kHz: the alarm comes with the third tick without a frame.
TEST(DriverWatch, FastFramesAndFineClock_AlarmIsTheThirdTick) {
  Chip chip(two_channels(true));
  FineClock clock{chip.simulator};
  mb4::tool::SimBus bus(chip.simulator);
  mb4::Device device(bus, clock);
  Config fast = config26(10'000'000);
  fast.spi_check = mb4::SpiCheck::kCrc;
  fast.frame_start = mb4::FrameStart::kPeriodic;
  fast.frame_period_clk = mb4::frame_period_clk_at_least(fast.f_clk_hz, 31'250);
  ASSERT_TRUE(device.configure(fast).ok());
  ASSERT_TRUE(device.automatic().start().ok());
  sim::Time tick = chip.simulator.now() + 100 * sim::kPsPerUs;
  chip.simulator.run_until(tick);
  ASSERT_TRUE(device.automatic().poll_slave(1).ok());
  clocked(chip.simulator.line(1))->faults().stick(true);
  chip.simulator.refresh_lines();
  unsigned silent = 0;
  Error error = Error::kNone;
  for (unsigned i = 0; i < 10 && error != Error::kTimeout; ++i) {
    tick += 31'250'000;
    chip.simulator.run_until(tick);
    error = device.automatic().poll_slave(1).error();
    silent = error == Error::kNone ? 0 : silent + 1;
  }
  EXPECT_EQ(error, Error::kTimeout);
  EXPECT_EQ(silent, 3U);
}

// A slave that acknowledges for three periods: frames are left out, and Config::frame_timeout_us
// tells that this is no fault.
TEST(DriverWatch, SlaveSlowerThanAPeriod_IsNoAlarm) {
  for (const bool told : {true, false}) {
    Chip chip("[[channel]]\nnumber = 1\n" +
              slave("source = \"ramp\"\nstep = 1\nbusy_periods = 1600"));
    Config slow = config26(10'000'000);
    slow.spi_check = mb4::SpiCheck::kCrc;
    slow.frame_start = mb4::FrameStart::kPeriodic;
    slow.frame_period_clk = mb4::frame_period_clk_at_least(slow.f_clk_hz, 50'000);
    slow.frame_timeout_us = told ? 200 : 0;
    ASSERT_TRUE(chip.device.configure(slow).ok());
    ASSERT_TRUE(chip.device.automatic().start().ok());
    unsigned good = 0;
    unsigned alarms = 0;
    for (int i = 0; i < 100; ++i) {
      chip.simulator.advance(20 * sim::kPsPerUs);
      const Error error = chip.device.automatic().poll_slave(1).error();
      good += error == Error::kNone ? 1 : 0;
      alarms += error != Error::kNone && error != Error::kNoData ? 1 : 0;
    }
    EXPECT_GE(good, 10U);
    EXPECT_EQ(alarms != 0, !told) << alarms;
  }
}

}  // namespace
