// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Slaves of BiSS C whose data is switched off (broadcast command 00): initialize() finds them, and
// Control::activate() switches them on (page 29).

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "drivers/c/mb4_c_access.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/driver/rtl/fault_bus.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::Config;
using mb4::Error;
using mb4::FrameStart;
using mb4::SpiCheck;
using mb4test::Chip;
using mb4test::FaultyChip;

const std::string kSlave = "[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n";
const std::string kFirst = kSlave + "control = true\ndata = 0x1111117\n";
const std::string kSecond = kSlave + "control = true\ndata = 0x2222223\n";
// Slaves 1 (ID 1) and 2 (ID 0) on channel 1, slave 5 (ID 0) on channel 2.
const std::string kBus =
    "[[channel]]\nnumber = 1\n" + kFirst + kSecond + "[[channel]]\nnumber = 2\n" + kFirst;
constexpr std::uint8_t kAll = 0x13;

Config bus_config() {
  Config config = mb4test::config26(10'000'000);
  config.channels[1].protocol = mb4::Protocol::kBissC;
  config.slaves[1] = config.slaves[0];
  config.slaves[4] = config.slaves[0];
  return config;
}

class DriverActivate : public testing::TestWithParam<SpiCheck> {
 protected:
  bool on(unsigned number) {
    return clocked(chip.simulator.slave(number))->control()->data_active();
  }
  bool listens(unsigned number) {
    return clocked(chip.simulator.slave(number))->control()->control_active();
  }
  // All slaves have their data off, and slave 2 no longer takes part in control communication.
  void switch_off() {
    ASSERT_TRUE(chip.device.configure(with(FrameStart::kWaitForLine)).ok());
    mb4::Command command;
    command.channels = 3;
    ASSERT_TRUE(chip.device.control().send(command).ok());
    command.channels = 1;
    command.ids = 1;
    command.code = 1;
    ASSERT_TRUE(chip.device.control().send(command).ok());
    ASSERT_FALSE(on(1) || on(2) || on(5) || listens(2));
  }
  Config with(FrameStart start) {
    Config config = bus_config();
    config.spi_check = GetParam();
    config.frame_start = start;
    config.frame_period_clk = start == FrameStart::kPeriodic ? 2000 : 0;
    return config;
  }
  void expect_words() {
    mb4::Frame frame;
    ASSERT_TRUE(chip.device.read_all(frame).ok());
    EXPECT_TRUE(frame.good(kAll));
    EXPECT_EQ(frame[1]->raw, 0x1111117U);
    EXPECT_EQ(frame[2]->raw, 0x2222223U);
  }

  Chip chip{kBus};
};

TEST_P(DriverActivate, EveryFrameStart_SwitchesAllOn) {
  for (const FrameStart start :
       {FrameStart::kWaitForLine, FrameStart::kRequireIdleLine, FrameStart::kPeriodic}) {
    switch_off();
    ASSERT_TRUE(chip.device.configure(with(start)).ok());
    EXPECT_EQ(chip.device.initialize().error(), Error::kNoWord);
    const mb4::Result<void> done = chip.device.control().activate();
    ASSERT_TRUE(done.ok()) << mb4::to_string(done.error());
    EXPECT_TRUE(on(1) && on(2) && on(5) && listens(2));
    EXPECT_TRUE(chip.device.initialize().ok());
    expect_words();
  }
}

TEST_P(DriverActivate, BesideAutomaticFrames_UsesThem) {
  switch_off();
  ASSERT_TRUE(chip.device.configure(with(FrameStart::kPeriodic)).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  ASSERT_TRUE(chip.device.control().activate().ok());
  EXPECT_TRUE(chip.device.automatic().running());
  mb4::Frame frame;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(chip.device.automatic().next(frame).ok());
  EXPECT_TRUE(frame.good(kAll));
}

TEST_P(DriverActivate, AtInitialize_WhenAskedTo) {
  switch_off();
  Config config = with(FrameStart::kPeriodic);
  config.activate_at_initialize = true;
  ASSERT_TRUE(chip.device.configure(config).ok());
  const mb4::Result<mb4::LineDelay> delay = chip.device.initialize();
  ASSERT_TRUE(delay.ok()) << mb4::to_string(delay.error());
  EXPECT_GE(delay->quarters[0], 1);
  EXPECT_TRUE(on(1) && on(2) && on(5));
  expect_words();
  // A slave that is missing does not acknowledge.
  config.slaves[2] = config.slaves[0];
  ASSERT_TRUE(chip.device.configure(config).ok());
  EXPECT_EQ(chip.device.initialize().error(), Error::kCommand);
}

// Exactly the IDs given must acknowledge.
TEST_P(DriverActivate, IdsGiven_AreThoseThatCount) {
  switch_off();
  EXPECT_EQ(chip.device.control().activate(0x04).error(), Error::kCommand);
  EXPECT_FALSE(on(1) || on(2) || on(5));
  ASSERT_TRUE(chip.device.control().activate(0x01).ok());
  EXPECT_TRUE(on(2) && !on(1) && !on(5));
  ASSERT_TRUE(chip.device.control().activate(0, 0x01).ok());
  EXPECT_TRUE(on(5) && !on(1));
}

// What the page warns of: slave 1 is off and passes on what comes from slave 2, with its CRC.
TEST_P(DriverActivate, OneSlaveOffInAChain_MovesTheWordOfTheOther) {
  switch_off();
  ASSERT_TRUE(chip.device.control().activate(0x01).ok());
  mb4::Frame frame;
  ASSERT_TRUE(chip.device.read_all(frame).ok());
  ASSERT_TRUE(frame[1].ok());
  EXPECT_EQ(frame[1]->raw, 0x2222223U);
  EXPECT_FALSE(frame[2].ok());
}

// initialize() gives what it gave where the word is bad in another way.
TEST_P(DriverActivate, OtherFaultsOfTheLastFrame_AreNone) {
  ASSERT_TRUE(chip.device.configure(with(FrameStart::kWaitForLine)).ok());
  Config config = with(FrameStart::kWaitForLine);
  config.slaves[0].crc_polynomial = 0x53;  // wrong
  ASSERT_TRUE(chip.device.configure(config).ok());
  EXPECT_TRUE(chip.device.initialize().ok());
}

// The caller makes the frames and the pauses.
TEST_P(DriverActivate, InSteps_AsTheBlockingCall) {
  for (const std::uint8_t ids : {std::uint8_t{0x03}, std::uint8_t{0x04}}) {
    switch_off();
    ASSERT_TRUE(chip.device.configure(with(FrameStart::kRequireIdleLine)).ok());
    mb4::Operation operation;
    ASSERT_TRUE(chip.device.control().plan_activate(operation, ids).ok());
    do {
      chip.simulator.advance(operation.pause_us() * mb4::sim::kPsPerUs);
    } while (!chip.device.finish(operation, operation.run(chip.bus), chip.clock.now_us()));
    const bool there = ids == 0x03;
    EXPECT_EQ(operation.result().error(), there ? Error::kNone : Error::kCommand);
    EXPECT_TRUE(on(1) == there && on(2) == there && !on(5));
  }
}

std::string name_of(const testing::TestParamInfo<SpiCheck>& test) {
  static const std::array<const char*, 4> kNames{"Off", "Crc", "Full", "FullAndRelease"};
  return kNames[static_cast<unsigned>(test.param)];
}

INSTANTIATE_TEST_SUITE_P(Checks, DriverActivate,
                         testing::Values(SpiCheck::kOff, SpiCheck::kCrc, SpiCheck::kFull,
                                         SpiCheck::kFullAndRelease),
                         name_of);

TEST(DriverActivateUse, WrongUse_TouchesNothing) {
  FaultyChip chip("[[channel]]\nnumber = 1\n" + kFirst);
  chip.bus.plan({});
  mb4::Operation operation;
  EXPECT_EQ(chip.device.control().activate().error(), Error::kNotConfigured);
  EXPECT_EQ(chip.device.control().plan_activate(operation).error(), Error::kNotConfigured);
  for (const mb4::Protocol protocol : {mb4::Protocol::kBissB, mb4::Protocol::kSsi}) {
    Config config = mb4test::config26(10'000'000);
    config.channels[0].protocol = protocol;
    ASSERT_TRUE(chip.device.configure(config).ok());
    chip.bus.plan({});
    const mb4::ErrorInfo info = chip.device.control().activate().info();
    EXPECT_EQ(info.code, Error::kUnsupported);
    EXPECT_EQ(info.field, mb4::ConfigField::kChannelProtocol);
    EXPECT_EQ(chip.device.control().plan_activate(operation).error(), Error::kUnsupported);
    EXPECT_EQ(chip.bus.count(), 0U);
  }
  ASSERT_TRUE(chip.device.configure(mb4test::config26(10'000'000)).ok());
  chip.bus.plan({});
  EXPECT_EQ(chip.device.control().activate(0, 1).error(), Error::kUnsupported);  // channel 2
  EXPECT_EQ(chip.bus.count(), 0U);
  ASSERT_TRUE(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0, 1).ok());
  chip.bus.plan({});
  EXPECT_EQ(chip.device.control().activate().error(), Error::kBusy);
  EXPECT_EQ(chip.device.control().plan_activate(operation).error(), Error::kBusy);
  EXPECT_EQ(chip.bus.count(), 0U);
}

// Each transfer refused: kTransport, or the call goes on; and the next call works.
TEST(DriverActivateUse, BusFails_IsTold) {
  using mb4test::FaultKind;
  const auto failed = [](FaultKind kind, std::size_t first, std::size_t last) {
    FaultyChip chip("[[channel]]\nnumber = 1\n" + kFirst);
    EXPECT_TRUE(chip.device.configure(mb4test::config26(10'000'000)).ok());
    chip.bus.plan({kind, first, last, 0});
    const Error error = chip.device.control().activate().error();
    chip.bus.plan({});
    if (!chip.device.configured()) {  // MISO was stuck where the configuration was compared
      EXPECT_TRUE(chip.device.configure(mb4test::config26(10'000'000)).ok());
    }
    EXPECT_TRUE(chip.device.control().activate().ok());
    EXPECT_TRUE(chip.device.initialize().ok());
    return error;
  };
  EXPECT_EQ(failed(FaultKind::kRefused, 0, 0), Error::kTransport);
  EXPECT_EQ(failed(FaultKind::kLost, 0, 0), Error::kNone);  // IDS were 0
  EXPECT_EQ(failed(FaultKind::kLost, 2, 2), Error::kCorrupted);
  EXPECT_EQ(failed(FaultKind::kMisoLow, 5, mb4test::kForEver), Error::kNotDetected);
}

TEST(DriverActivateUse, FaultOfTheBus_TheOperationTellsIt) {
  using mb4test::FaultKind;
  const auto failed = [](FaultKind kind, std::size_t first, std::size_t last) {
    FaultyChip chip("[[channel]]\nnumber = 1\n" + kFirst);
    EXPECT_TRUE(chip.device.configure(mb4test::config26(10'000'000)).ok());
    mb4::Operation operation;
    EXPECT_TRUE(chip.device.control().plan_activate(operation).ok());
    chip.bus.plan({kind, first, last, 0});
    while (!chip.device.finish(operation, operation.run(chip.bus), chip.clock.now_us())) {
    }
    return operation.result().error();
  };
  EXPECT_EQ(failed(FaultKind::kRefused, 0, 0), Error::kTransport);
  EXPECT_EQ(failed(FaultKind::kLost, 2, 2), Error::kCorrupted);
  EXPECT_EQ(failed(FaultKind::kMisoLow, 5, mb4test::kForEver), Error::kNotDetected);
}

TEST(DriverActivateUse, NoClock_IsTimeout) {
  FaultyChip chip("[chip]\nf_clk_hz = 0\n[[channel]]\nnumber = 1\n" + kFirst);
  ASSERT_TRUE(chip.device.configure(mb4test::config26(10'000'000)).ok());
  EXPECT_EQ(chip.device.control().activate().error(), Error::kTimeout);
  mb4::Operation operation;
  ASSERT_TRUE(chip.device.control().plan_activate(operation).ok());
  while (!chip.device.finish(operation, operation.run(chip.bus), chip.clock.now_us())) {
  }
  EXPECT_EQ(operation.result().error(), Error::kTimeout);
}

}  // namespace
