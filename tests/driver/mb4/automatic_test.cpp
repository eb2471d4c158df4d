// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Automatic frames, transfer by transfer: pages 31 to 33, table 69.

#include "mb4/automatic.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "mb4/device.hpp"
#include "tests/driver/mb4/encoder26.hpp"
#include "tests/driver/mb4/strict_bus.hpp"
#include "tests/driver/mb4/three_slaves.hpp"

namespace {
namespace automatic_test {

using mb4::Error;
using mb4::Frame;
using mb4test::Bytes;
using mb4test::encoder26;
using mb4test::FakeClock;
using mb4test::join;
using mb4test::kBreak;
using mb4test::kClearValid1;
using mb4test::kClearValid1AndRelease;
using mb4test::kData4;
using mb4test::kReadData4;
using mb4test::kReadStatus;
using mb4test::status;
using mb4test::StrictBus;
using mb4test::zeros;

const Bytes kAgs{0x07, 0x01};   // AGS: bit 0 of 0xF4 (table 44)
const Bytes kHold{0x07, 0x41};  // and HOLDBANK, bit 6 (table 48)
const Bytes kOff{0x07, 0x00};
// 0xF4 reads AGS = 1; EOT = 0, as a frame may run at any time.
const Bytes kNothingNew = status(0xFA, 0x00, 0x01);
const Bytes kNew = status(0xFA, 0x02, 0x01);
const Bytes kBad = status(0x6A, 0x00, 0x01);  // nSCDERR = 0, nERR = 0
const Bytes kHeldNothingNew = status(0xFA, 0x00, 0x41);
const Bytes kHeldNew = status(0xFA, 0x02, 0x41);
const Bytes kHeldBad = status(0x6A, 0x00, 0x41);

class AutomaticTest : public testing::Test {
 protected:
  void configure(mb4::Config config = encoder26()) {
    mb4test::expect_configure(bus);
    ASSERT_TRUE(device.configure(config).ok());
  }
  void start() {
    configure();
    bus.expect_write(kAgs);
    ASSERT_TRUE(device.automatic().start().ok());
  }
  // Table 69: HOLDBANK, data, SVALID read and reset, HOLDBANK off.
  void expect_read() { expect_read(kHeldNew, kClearValid1AndRelease); }
  void expect_read(const Bytes& answer, const Bytes& end) {
    bus.expect_write(kHold);
    bus.expect_read(kReadData4, kData4);
    bus.expect_read(kReadStatus, answer);
    bus.expect_write(end);
  }
  void expect_restart() {
    bus.expect_write(kBreak);
    bus.expect_write(kClearValid1);
    bus.expect_write(kAgs);
  }

  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device{bus, clock};
  Frame frame;
};

using Start = AutomaticTest;
using Poll = AutomaticTest;
using Next = AutomaticTest;

TEST_F(Start, Configured_WritesAgsAlone) {
  start();
  EXPECT_TRUE(device.automatic().running());
}

TEST_F(Start, WrongUse_IsAnErrorWithoutTransfer) {
  EXPECT_EQ(device.automatic().start().error(), Error::kNotConfigured);
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kWrongMode);
  EXPECT_EQ(device.automatic().next(frame).error(), Error::kWrongMode);
  start();
  EXPECT_EQ(device.automatic().start().error(), Error::kWrongMode);
  EXPECT_EQ(device.read_frame().error(), Error::kWrongMode);
  EXPECT_EQ(device.read_all(frame).error(), Error::kWrongMode);
}

// Table 38: with one bank nothing holds the data.
TEST_F(Start, SingleBank_IsUnsupported) {
  mb4::Config config = encoder26();
  config.single_bank = true;
  mb4test::expect_configure(bus, 0xE7, 0x03);
  ASSERT_TRUE(device.configure(config).ok());
  const mb4::ErrorInfo info = device.automatic().start().info();
  EXPECT_EQ(info.code, Error::kUnsupported);
  EXPECT_EQ(info.field, mb4::ConfigField::kSingleBank);
}

TEST_F(Start, TransportFailure_LeavesOffAndRecoversNext) {
  configure();
  bus.expect_write(kAgs).fail_last();
  EXPECT_EQ(device.automatic().start().error(), Error::kTransport);
  EXPECT_FALSE(device.automatic().running());
  expect_restart();
  EXPECT_TRUE(device.automatic().start().ok());
}

// The running frame comes to its end by itself; a single frame afterwards begins with BREAK.
TEST_F(Start, Stop_ClearsAgsAndSingleFramesWork) {
  start();
  bus.expect_write(kOff);
  EXPECT_TRUE(device.automatic().stop().ok());
  bus.expect_write(kBreak);
  bus.expect_write(kClearValid1);
  bus.expect_write(mb4test::kStartFrame);
  bus.expect_read(kReadStatus, mb4test::kGoodFrame);
  bus.expect_read(kReadData4, kData4);
  bus.expect_write(kClearValid1);
  EXPECT_TRUE(device.read_frame().ok());
}

TEST_F(Start, Restart_BreaksWaitsClearsAndStarts) {
  start();
  expect_restart();
  const std::uint32_t before = clock.time_us;
  EXPECT_TRUE(device.automatic().restart().ok());
  EXPECT_GE(clock.time_us - before, 100U);
}

TEST_F(Start, Configure_EndsAutomaticFrames) {
  start();
  configure();
  EXPECT_FALSE(device.automatic().running());
}

TEST_F(Poll, NewFrame_FollowsTable69) {
  start();
  expect_read();
  const std::size_t before = bus.transfers();
  ASSERT_TRUE(device.automatic().poll(frame).ok());
  EXPECT_EQ(bus.transfers() - before, 4U);  // 3 + one slave
  EXPECT_EQ(frame[1]->position, mb4test::kPosition);
}

TEST_F(Poll, NothingNew_IsNoData) {
  start();
  expect_read(kHeldNothingNew, kAgs);
  ASSERT_TRUE(device.automatic().poll(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kNoData);
}

TEST_F(Poll, BadFrame_IsCrc) {
  start();
  expect_read(kHeldBad, kAgs);
  ASSERT_TRUE(device.automatic().poll(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kCrc);
}

// nSCDERR is about the last frame on the line; the bank that is held is an earlier, good one.
TEST_F(Poll, LaterFrameBad_HeldOneIsGood) {
  start();
  expect_read(status(0x6A, 0x02, 0x41), kClearValid1AndRelease);
  ASSERT_TRUE(device.automatic().poll(frame).ok());
  EXPECT_TRUE(frame[1].ok());
}

// HOLDBANK must not stay 1: the driver releases it after every failure too.
TEST(PollFailure, TransportAtEachTransfer_ReleasesTheBank) {
  for (std::size_t index = 0; index < 4; ++index) {
    StrictBus bus;
    FakeClock clock;
    mb4::Device<StrictBus, FakeClock> device(bus, clock);
    mb4test::expect_configure(bus);
    bus.expect_write(kAgs);
    ASSERT_TRUE(device.configure(encoder26()).ok());
    ASSERT_TRUE(device.automatic().start().ok());
    bus.expect_write(kHold);
    bus.expect_read(kReadData4, kData4);
    bus.expect_read(kReadStatus, kHeldNew);
    bus.expect_write(kClearValid1AndRelease);
    bus.fail_at(mb4test::kConfigureTransfers + 1 + index);
    bus.expect_write(kAgs);
    Frame frame;
    EXPECT_EQ(device.automatic().poll(frame).error(), Error::kTransport) << index;
    EXPECT_FALSE(frame[1].ok()) << index;
  }
}

TEST_F(Poll, ImplausibleStatus_IsNotDetected) {
  start();
  expect_read(Bytes(6, 0xFF), kAgs);
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kNotDetected);
}

TEST(PollThree, OneSlaveBad_OthersAreRead) {
  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device(bus, clock);
  mb4test::expect_configure_three(bus);
  bus.expect_write(kAgs);
  ASSERT_TRUE(device.configure(mb4test::three_slaves()).ok());
  ASSERT_TRUE(device.automatic().start().ok());
  bus.expect_write(kHold);
  mb4test::expect_three_data(bus);
  bus.expect_read(kReadStatus, {0x00, 0x6B, 0x02, 0x02, 0x00, 0x41});  // nSCDERR = 0
  bus.expect_write(join({mb4test::kThreeClear, {0xFF, 0x01}}));
  Frame frame;
  const std::size_t before = bus.transfers();
  ASSERT_TRUE(device.automatic().poll(frame).ok());
  EXPECT_EQ(bus.transfers() - before, 6U);  // 3 + three slaves
  EXPECT_TRUE(frame[1].ok());
  EXPECT_EQ(frame[2].error(), Error::kCrc);
  EXPECT_TRUE(frame[5].ok());
}

TEST_F(Next, FrameComes_IsFetched) {
  start();
  bus.expect_read(kReadStatus, kNothingNew);
  bus.expect_read(kReadStatus, kNew);
  expect_read();
  ASSERT_TRUE(device.automatic().next(frame).ok());
  EXPECT_EQ(frame[1]->position, mb4test::kPosition);
}

// Table 69: SVALID = 0 after reading: BREAK, then AGS again; here before the next frame.
// nE = 0 is no fault of the line, so nothing is restarted.
TEST_F(Next, SlaveError_IsFetchedWithoutRestart) {
  start();
  for (const std::uint8_t low : {std::uint8_t{0xBD}, std::uint8_t{0xBF}}) {
    bus.expect_read(kReadStatus, kNew);
    bus.expect_write(kHold);
    bus.expect_read(kReadData4, {0x00, low, 0x37, 0xAF, 0x0A});
    bus.expect_read(kReadStatus, kHeldNew);
    bus.expect_write(kClearValid1AndRelease);
    ASSERT_TRUE(device.automatic().next(frame).ok());
    EXPECT_EQ(frame[1].error(), low == 0xBD ? Error::kSlaveError : Error::kNone);
    EXPECT_EQ(frame[1].reading().position, mb4test::kPosition);
  }
}

TEST_F(Next, BadFrame_NextOneBeginsWithRestart) {
  start();
  bus.expect_read(kReadStatus, kBad);
  expect_read(kHeldBad, kAgs);
  ASSERT_TRUE(device.automatic().next(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kCrc);
  expect_restart();
  bus.expect_read(kReadStatus, kNew);
  expect_read();
  ASSERT_TRUE(device.automatic().next(frame).ok());
  bus.expect_read(kReadStatus, kNew);
  expect_read();  // once is enough
  ASSERT_TRUE(device.automatic().next(frame).ok());
}

// The line answers with SL1, bit 0 of 0xF8 (table 67).
void expect_line(StrictBus& bus, std::uint8_t level) {
  bus.expect_write(kBreak);
  bus.expect_read(join({{0x05}, zeros(9)}), join({zeros(9), {level}}));
}

TEST_F(Next, NoFrameInTime_IsTimeoutAfterBreakAndRestarts) {
  start();
  clock.step_us = 100'000;
  bus.expect_read(kReadStatus, kNothingNew);  // the time begins
  bus.expect_read(kReadStatus, kNothingNew);
  bus.expect_read(kReadStatus, kNothingNew);  // after the time
  expect_line(bus, 0x51);
  EXPECT_EQ(device.automatic().next(frame).error(), Error::kTimeout);
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kWrongMode);
  expect_restart();
  bus.expect_read(kReadStatus, kNew);
  expect_read();
  EXPECT_TRUE(device.automatic().next(frame).ok());
}

TEST_F(Next, LineLow_IsLineError) {
  start();
  clock.step_us = 100'000;
  for (int look = 0; look < 3; ++look) {
    bus.expect_read(kReadStatus, status(0x3B, 0x00, 0x01));
  }
  expect_line(bus, 0x50);
  bus.expect_read(join({{0x05}, zeros(9)}), join({zeros(9), {0x50}}));
  bus.expect_read(join({{0x05}, zeros(9)}), join({zeros(9), {0x50}}));
  EXPECT_EQ(device.automatic().next(frame).error(), Error::kLineError);
}

// Clock stands still: 220 us, one frame's 220 us, and 33 us for the clock's step.
TEST_F(Next, ClockStandsStill_EndsAfterBoundedPolls) {
  start();
  clock.step_us = 0;
  for (int poll = 0; poll < 4 * (440 + 33) + 1; ++poll) {
    bus.expect_read(kReadStatus, kNothingNew);
  }
  expect_line(bus, 0x51);
  EXPECT_EQ(device.automatic().next(frame).error(), Error::kTimeout);
}

TEST_F(Next, TransportFailureWhileWaiting_RestartsNextTime) {
  start();
  bus.expect_read(kReadStatus, kNothingNew).fail_last();
  EXPECT_EQ(device.automatic().next(frame).error(), Error::kTransport);
  bus.expect_write(kBreak).fail_last();
  EXPECT_EQ(device.automatic().next(frame).error(), Error::kTransport);
  expect_restart();
  bus.expect_read(kReadStatus, kNew);
  expect_read();
  EXPECT_TRUE(device.automatic().next(frame).ok());
}

// FREQAGS = AGSINFINITE: without a pulse at GETSENS there is no frame, and nothing is wrong.
TEST_F(Next, NoPulseAtGetsens_IsNoDataAndChangesNothing) {
  mb4::Config config = encoder26();
  config.frame_start = mb4::FrameStart::kOnPin;
  mb4test::expect_configure(bus, 0xE8, 0x7D);
  bus.expect_write(kAgs);
  ASSERT_TRUE(device.configure(config).ok());
  ASSERT_TRUE(device.automatic().start().ok());
  clock.step_us = 100'000;
  for (int look = 0; look < 3; ++look) {
    bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x01));
  }
  EXPECT_EQ(device.automatic().next(frame).error(), Error::kNoData);
  bus.expect_read(kReadStatus, kNew);
  expect_read();
  EXPECT_TRUE(device.automatic().next(frame).ok());
}

// SL is not looked at when BREAK could not be sent.
TEST_F(Next, NoFrameInTimeAndBreakFails_IsTransport) {
  start();
  clock.step_us = 100'000;
  for (int look = 0; look < 3; ++look) bus.expect_read(kReadStatus, kNothingNew);
  bus.expect_write(kBreak).fail_last();
  EXPECT_EQ(device.automatic().next(frame).error(), Error::kTransport);
  EXPECT_FALSE(device.automatic().running());
}

}  // namespace automatic_test
}  // namespace
