// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Actuators by the driver on the Verilated chip: pages 15, 25 (Tables 17, 18), 31 (Tables 39, 40).

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "drivers/c/mb4_c_access.hpp"
#include "sim/lines/clocked/actuator.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/driver/rtl/protocol_bus.hpp"

namespace {

using namespace mb4test;  // NOLINT: scenarios and configurations
using mb4::Config;
using mb4::Error;
using mb4::Frame;
using mb4::Protocol;

const std::string kActuator = "actuator = true\n";

std::uint64_t low_bits(std::uint64_t word, unsigned bits) {
  return bits == 64 ? word : word & ((std::uint64_t{1} << bits) - 1);
}

struct ActuatorCase {
  std::string name;
  bool single_bank;
  mb4::SpiCheck check;
};

class DriverActuator : public testing::TestWithParam<ActuatorCase> {};

INSTANTIATE_TEST_SUITE_P(Ways, DriverActuator,
                         testing::Values(ActuatorCase{"Full", false, mb4::SpiCheck::kFull},
                                         ActuatorCase{"Off", false, mb4::SpiCheck::kOff},
                                         ActuatorCase{"OneBank", true, mb4::SpiCheck::kFull}),
                         [](const auto& test) { return test.param.name; });

// Every position in a chain of four, sensors beside it: each frame carries what was written, until
// something else is written.
TEST_P(DriverActuator, EveryPosition_TakesTheWordAndKeepsIt) {
  constexpr unsigned kLength = 4;
  for (unsigned position = 1; position <= kLength; ++position) {
    const unsigned bits = position == 2 ? 64 : 5 + 7 * position;
    const bool stop_bit = position % 2 == 1;
    std::string scenario = on_channel(1, "mo = true\n");
    Config config = empty_config(Protocol::kBissC);
    config.single_bank = GetParam().single_bank;
    config.spi_check = GetParam().check;
    // Without a stop bit the first bit of the word may look like the end of the timeout
    // (docs/choices.md).
    config.hold_cdm = !stop_bit;
    for (unsigned slave = 1; slave <= kLength; ++slave) {
      if (slave == position) {
        scenario += device("biss-c", bits, kActuator + (stop_bit ? "" : "stop_bit = false\n"));
        add_actuator(config, slave, bits, stop_bit);
      } else {
        scenario += device("biss-c", 12, "flag_bits = 0\ndata = " + std::to_string(0xA50 + slave));
        add(config, slave, 12, 0x43);
      }
    }
    FaultyChip chip(scenario);
    ASSERT_TRUE(chip.device.configure(config).ok());
    auto* actuator = clocked(chip.simulator.slave(position))->actuator();
    for (const std::uint64_t seed : {0x9E3779B97F4A7C15ULL, 0x6A09E667F3BCC908ULL}) {
      const std::uint64_t word = low_bits(seed, bits);
      const mb4::Result<void> written =
          chip.device.write_actuator(static_cast<std::uint8_t>(position), word);
      ASSERT_TRUE(written.ok()) << mb4::to_string(written.error());
      for (unsigned i = 0; i < 5; ++i) {
        Frame frame;
        ASSERT_TRUE(chip.device.read_all(frame).ok());
        chip.simulator.advance(50 * mb4::sim::kPsPerUs);  // the slaves' timeout
        EXPECT_EQ(actuator->word(), word) << position << " frame " << i;
        for (unsigned slave = 1; slave <= kLength; ++slave) {
          if (slave == position) {
            EXPECT_EQ(frame[slave].error(), Error::kInvalidArgument);
          } else {
            ASSERT_TRUE(frame[slave].ok()) << mb4::to_string(frame[slave].error());
            EXPECT_EQ(frame[slave]->position, 0xA50U + slave);
          }
        }
      }
    }
    EXPECT_EQ(actuator->crc_errors(), 0U);
    EXPECT_EQ(chip.device.read_frame(static_cast<std::uint8_t>(position)).error(),
              Error::kInvalidArgument);
  }
}

// A control loop: a word a frame, read and written in the same cycle. No frame carries a word that
// was not written, or half of one.
TEST(DriverActuatorLoop, AutomaticFrames_CarryWholeWords) {
  FaultyChip chip(on_channel(1, "mo = true\n") + device("biss-c", 32, kActuator) +
                  device("biss-c", 26, "flag_bits = 0\nsource = \"ramp\"\n"));
  Config config = empty_config(Protocol::kBissC);
  add_actuator(config, 1, 32);
  add(config, 2, 26, 0x43);
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = 2000;  // 100 us
  ASSERT_TRUE(chip.device.configure(config).ok());
  auto* actuator = clocked(chip.simulator.slave(1))->actuator();
  ASSERT_TRUE(chip.device.write_actuator(1, 0).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  std::uint64_t last = 0;
  for (std::uint32_t cycle = 1; cycle <= 200; ++cycle) {
    Frame frame;
    ASSERT_TRUE(chip.device.automatic().next(frame).ok());
    ASSERT_TRUE(chip.device.automatic().write_actuator(1, cycle * 0x01010101U).ok());
    const std::uint64_t now = actuator->word() / 0x01010101U;
    EXPECT_EQ(actuator->word() % 0x01010101U, 0U) << "torn";
    EXPECT_GE(now, last);
    EXPECT_LE(cycle - now, 3U) << "late";
    last = now;
  }
  EXPECT_EQ(actuator->crc_errors(), 0U);
  // A word that stays, whenever it is written.
  for (std::uint32_t word = 0x12345678; word < 0x12345678 + 20; ++word) {
    chip.simulator.advance(37 * mb4::sim::kPsPerUs);
    ASSERT_TRUE(chip.device.write_actuator(1, word).ok());
    chip.simulator.advance(200 * mb4::sim::kPsPerUs);
    for (unsigned i = 0; i < 3; ++i) {
      EXPECT_EQ(actuator->word(), word);
      chip.simulator.advance(100 * mb4::sim::kPsPerUs);
    }
  }
  // The same word again: nothing can be seen to switch.
  ASSERT_TRUE(chip.device.write_actuator(1, 0x11).ok());
  ASSERT_TRUE(chip.device.write_actuator(1, 0x11).ok());
  chip.simulator.advance(300 * mb4::sim::kPsPerUs);
  EXPECT_EQ(actuator->word(), 0x11U);
}

// Both channels, words of different lengths, MO_BUSY for a slow sensor.
TEST(DriverActuatorLoop, BothChannels_TakeTheirOwnWords) {
  FaultyChip chip(on_channel(1, "mo = true\n") + device("biss-c", 8, kActuator) +
                  device("biss-c", 26, "flag_bits = 0\ndata = 0x2ABCDEF\n") +
                  on_channel(2, "mo = true\n") + device("biss-c", 40, kActuator));
  Config config = empty_config(Protocol::kBissC, Protocol::kBissC);
  config.mo_busy = 9;
  add_actuator(config, 1, 8);
  add(config, 2, 26, 0x43);
  add_actuator(config, 5, 40);
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.write_actuator(5, 0xFEDCBA9876).ok());
  ASSERT_TRUE(chip.device.write_actuator(1, 0x5A).ok());
  for (unsigned i = 0; i < 4; ++i) {
    const mb4::Result<mb4::Reading> reading = chip.device.read_frame(2);
    ASSERT_TRUE(reading.ok());
    EXPECT_EQ(reading->position, 0x2ABCDEFU);
    chip.simulator.advance(50 * mb4::sim::kPsPerUs);
    EXPECT_EQ(clocked(chip.simulator.slave(1))->actuator()->word(), 0x5AU);
    EXPECT_EQ(clocked(chip.simulator.slave(5))->actuator()->word(), 0xFEDCBA9876U);
  }
  // Registers of an actuator, as of any slave.
  const std::array<std::uint8_t, 2> bytes{1, 2};
  ASSERT_TRUE(chip.device.control().write_registers({2, 0}, 0x60, bytes).ok());
  EXPECT_EQ(chip.simulator.slave(5)->reg_read(0x61), 2);
}

// No sensor at all: frames run, and what goes wrong with them shows.
TEST(DriverActuatorLoop, OnlyActuators_FramesRunAndErrorsShow) {
  FaultyChip chip(on_channel(1, "mo = true\n") + device("biss-c", 16, kActuator));
  Config config = empty_config(Protocol::kBissC);
  add_actuator(config, 1, 16);
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.write_actuator(1, 0xBEEF).ok());
  Frame frame;
  ASSERT_TRUE(chip.device.read_all(frame).ok());
  chip.simulator.advance(50 * mb4::sim::kPsPerUs);
  EXPECT_EQ(clocked(chip.simulator.slave(1))->actuator()->word(), 0xBEEFU);
  config.frame_start = mb4::FrameStart::kRequireIdleLine;
  ASSERT_TRUE(chip.device.configure(config).ok());
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  EXPECT_EQ(chip.device.read_all(frame).error(), Error::kLineError);
}

// ---- Errors -------------------------------------------------------------------------------------

struct Actuated {
  explicit Actuated(bool automatic)
      : chip(on_channel(1, "mo = true\n") + device("biss-c", 12, kActuator) +
             device("biss-c", 12, "flag_bits = 0\nsource = \"ramp\"\n")) {
    Config config = empty_config(Protocol::kBissC);
    add_actuator(config, 1, 12);
    add(config, 2, 12, 0x43);
    EXPECT_TRUE(chip.device.configure(config).ok());
    if (automatic) {
      EXPECT_TRUE(chip.device.automatic().start().ok());
    }
    chip.bus.plan({});
  }
  FaultyChip chip;
};

TEST(DriverActuatorErrors, WrongUse_TouchesNothing) {
  {
    FaultyChip chip(on_channel(1) + device("biss-c", 12, ""));
    EXPECT_EQ(chip.device.write_actuator(1, 0).error(), Error::kNotConfigured);
  }
  Actuated one(true);
  EXPECT_EQ(one.chip.device.write_actuator(0, 0).error(), Error::kInvalidArgument);
  EXPECT_EQ(one.chip.device.write_actuator(2, 0).error(), Error::kInvalidArgument);  // a sensor
  EXPECT_EQ(one.chip.device.write_actuator(3, 0).error(), Error::kInvalidArgument);  // not there
  EXPECT_EQ(one.chip.device.write_actuator(9, 0).error(), Error::kInvalidArgument);
  EXPECT_EQ(one.chip.device.write_actuator(1, 0x1000).error(), Error::kInvalidArgument);
  EXPECT_EQ(one.chip.device.automatic().poll_slave(1).error(), Error::kInvalidArgument);
  EXPECT_EQ(one.chip.device.automatic().write_actuator(2, 0).error(), Error::kInvalidArgument);
  EXPECT_EQ(one.chip.bus.count(), 0U);
  ASSERT_TRUE(mb4_c::PolledAccess(one.chip.device).begin_read({1, 0}, 0, 1).ok());
  one.chip.bus.plan({});
  EXPECT_EQ(one.chip.device.write_actuator(1, 0).error(), Error::kBusy);
  EXPECT_EQ(one.chip.device.automatic().write_actuator(1, 0).error(), Error::kBusy);
  EXPECT_EQ(one.chip.bus.count(), 0U);
  Actuated single(false);
  EXPECT_EQ(single.chip.device.automatic().write_actuator(1, 0).error(), Error::kWrongMode);
  EXPECT_EQ(single.chip.bus.count(), 0U);
}

// Each transfer failing, lost, or with MISO stuck: an error, or the word arrives.
TEST(DriverActuatorErrors, EachTransferDisturbed_IsAnErrorOrTheWordArrives) {
  for (const bool automatic : {false, true}) {
    const auto write = [automatic](Actuated& one) {
      return automatic ? one.chip.device.automatic().write_actuator(1, 0x5A5)
                       : one.chip.device.write_actuator(1, 0x5A5);
    };
    std::size_t count = 0;
    {
      Actuated one(automatic);
      ASSERT_TRUE(write(one).ok());
      count = one.chip.bus.count();
      EXPECT_EQ(count, automatic ? 7U : 10U);
    }
    for (std::size_t index = 0; index < count; ++index) {
      for (const FaultKind kind :
           {FaultKind::kRefused, FaultKind::kFailedAfter, FaultKind::kLost, FaultKind::kMisoLow,
            FaultKind::kMisoHigh, FaultKind::kFlipMosi, FaultKind::kFlipMiso}) {
        SCOPED_TRACE(std::to_string(static_cast<int>(kind)) + " " + std::to_string(index));
        Actuated one(automatic);
        one.chip.bus.plan({kind, index, index, 13});
        const Error error = write(one).error();
        one.chip.bus.plan({});
        if (kind == FaultKind::kRefused || kind == FaultKind::kFailedAfter) {
          EXPECT_EQ(error, Error::kTransport);
        }
        // The next one works, and so do positions.
        EXPECT_TRUE(one.chip.device.write_actuator(1, 0x123).ok());
        Frame frame;
        // Behind a call that has failed the words that wait are dropped.
        if (automatic) static_cast<void>(one.chip.device.automatic().next(frame));
        const mb4::Result<void> read =
            automatic ? one.chip.device.automatic().next(frame) : one.chip.device.read_all(frame);
        EXPECT_TRUE(read.ok() && frame[2].ok())
            << mb4::to_string(error) << ", then " << mb4::to_string(read.error()) << ", "
            << mb4::to_string(frame[2].error());
        one.chip.simulator.advance(200 * mb4::sim::kPsPerUs);
        EXPECT_EQ(clocked(one.chip.simulator.slave(1))->actuator()->word(), 0x123U);
      }
    }
  }
}

// The release of the bank fails: positions that have waited in the held bank, or behind it, are not
// told as new, neither by the next read nor after the next word.
TEST(DriverActuatorErrors, ReleaseFails_NoOldPosition) {
  for (const bool again : {false, true}) {
    Actuated one(true);
    mb4::Automatic automatic = one.chip.device.automatic();
    const std::size_t release = 5;  // 0x07, status, 0x02, comparison, witness, 0x07
    one.chip.bus.plan({FaultKind::kRefused, release, release, 0});
    EXPECT_EQ(automatic.write_actuator(1, 0x5A5).error(), Error::kTransport);
    one.chip.bus.plan({});
    one.chip.simulator.advance(5'000 * mb4::sim::kPsPerUs);
    if (again) {
      EXPECT_TRUE(automatic.write_actuator(1, 0x123).ok());
    }
    const mb4::sim::Slave& sensor = *one.chip.simulator.slave(2);
    const std::uint64_t sent = sensor.frames();
    const mb4::Result<mb4::Reading> reading = automatic.poll_slave(2);
    if (reading.ok()) {  // a frame has ended behind the release
      EXPECT_TRUE(sensor.sent_in(sent) == reading->raw || sensor.sent_in(sent - 1) == reading->raw);
    } else {
      EXPECT_EQ(reading.error(), Error::kNoData);
    }
    one.chip.simulator.advance(1'000 * mb4::sim::kPsPerUs);
    EXPECT_TRUE(automatic.poll_slave(2).ok());
  }
}

// What the check is for: success means that all frames carry the word.
TEST(DriverActuatorErrors, EachTransferLost_SuccessMeansThatItArrives) {
  for (std::size_t index = 0; index < 10; ++index) {
    Actuated one(false);
    ASSERT_TRUE(one.chip.device.write_actuator(1, 0x123).ok());
    one.chip.bus.plan({FaultKind::kLost, index, index, 0});
    const bool done = one.chip.device.write_actuator(1, 0x5A5).ok();
    one.chip.bus.plan({});
    for (unsigned i = 0; done && i < 3; ++i) {
      Frame frame;
      ASSERT_TRUE(one.chip.device.read_all(frame).ok());
      one.chip.simulator.advance(60 * mb4::sim::kPsPerUs);
      EXPECT_EQ(clocked(one.chip.simulator.slave(1))->actuator()->word(), 0x5A5U) << index;
    }
  }
}

TEST(DriverActuatorErrors, MisoStuck_IsNotDetected) {
  for (const bool automatic : {false, true}) {
    for (const FaultKind kind : {FaultKind::kMisoLow, FaultKind::kMisoHigh}) {
      Actuated one(automatic);
      one.chip.bus.plan({kind, 0, kForEver, 0});
      EXPECT_EQ(one.chip.device.write_actuator(1, 0x5A5).error(), Error::kNotDetected);
      if (automatic) {
        EXPECT_EQ(one.chip.device.automatic().write_actuator(1, 0x5A5).error(),
                  Error::kNotDetected);
      }
    }
  }
}

// HOLDBANK or SWBANK that has not reached the chip.
TEST(DriverActuatorErrors, LostInstruction_IsCorrupted) {
  Actuated automatic(true);
  automatic.chip.bus.plan({FaultKind::kLost, 0, 0, 0});
  EXPECT_EQ(automatic.chip.device.automatic().write_actuator(1, 0x5A5).error(), Error::kCorrupted);
  Actuated single(false);
  single.chip.bus.plan({FaultKind::kLost, 3, 3, 0});
  EXPECT_EQ(single.chip.device.write_actuator(1, 0x5A5).error(), Error::kCorrupted);
}

TEST(DriverActuatorErrors, AfterAFailedRead_RecoversFirst) {
  Actuated one(false);
  one.chip.bus.plan({FaultKind::kRefused, 1, 1, 0});
  Frame frame;
  EXPECT_EQ(one.chip.device.read_all(frame).error(), Error::kTransport);
  one.chip.bus.plan({FaultKind::kRefused, 0, 0, 0});
  EXPECT_EQ(one.chip.device.write_actuator(1, 0x5A5).error(), Error::kTransport);
  one.chip.bus.plan({});
  EXPECT_TRUE(one.chip.device.write_actuator(1, 0x5A5).ok());
}

}  // namespace
