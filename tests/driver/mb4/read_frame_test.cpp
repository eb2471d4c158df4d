// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// read_frame(), transfer by transfer: the good frame, each way a frame can go wrong, and the rule
// that no bad frame ever yields a position.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mb4/device.hpp"
#include "tests/driver/mb4/encoder26.hpp"
#include "tests/driver/mb4/strict_bus.hpp"

namespace {
namespace read_frame_test {

using mb4::Error;
using mb4::Reading;
using mb4::Result;
using mb4test::Bytes;
using mb4test::encoder26;
using mb4test::FakeClock;
using mb4test::join;
using mb4test::kBreak;
using mb4test::kClearValid1;
using mb4test::kData4;
using mb4test::kGoodFrame;
using mb4test::kIdleStatus;
using mb4test::kReadData4;
using mb4test::kReadStatus;
using mb4test::kRunning;
using mb4test::kStartFrame;
using mb4test::status;
using mb4test::StrictBus;
using mb4test::zeros;

// Status with 0xF0..0xF8, as the driver reads it after a timeout; bit 0 of 0xF8 is SL1 (table 67).
const Bytes kReadLine = join({{0x05}, zeros(9)});
Bytes line_level(unsigned sl1) {
  return {0x00, 0xFB, 0x00, 0x00, 0x00,
          0x00, 0x00, 0x00, 0x00, static_cast<std::uint8_t>(0x54 | sl1)};
}

class ReadFrame : public testing::Test {
 protected:
  void configure(mb4::Config config = encoder26()) {
    mb4test::expect_configure(bus);
    ASSERT_TRUE(device.configure(config).ok());
  }
  // What comes first after a failed read.
  void expect_recovery() {
    bus.expect_write(kBreak);
    bus.expect_write(kClearValid1);
  }
  void expect_good_frame() {
    bus.expect_write(kStartFrame);
    bus.expect_read(kReadStatus, kGoodFrame);
    bus.expect_read(kReadData4, kData4);
    bus.expect_write(kClearValid1);
  }

  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device{bus, clock};
};

// ---- Good frames --------------------------------------------------------------------------------

TEST_F(ReadFrame, GoodFrame_ReturnsPosition) {
  configure();
  bus.expect_write(kStartFrame);             // opcode 0x07, INSTR = 010 (table 45)
  bus.expect_read(kReadStatus, kRunning);    // opcode 0x05, EOT = 0 (table 54)
  bus.expect_read(kReadStatus, kGoodFrame);  // EOT = 1, SVALID1 = 1 (table 61)
  bus.expect_read(kReadData4, kData4);       // opcode 0x09 (page 19), 28 bits are 4 bytes
  bus.expect_write(kClearValid1);            // note of table 61
  const Result<Reading> reading = device.read_frame();
  ASSERT_TRUE(reading.ok());
  EXPECT_EQ(reading->raw, mb4test::kRaw);
  EXPECT_EQ(reading->position, mb4test::kPosition);
  EXPECT_FALSE(reading->slave_error);
  EXPECT_FALSE(reading->slave_warning);
}

TEST_F(ReadFrame, FrameAlreadyOverAtFirstPoll_TakesFourTransfers) {
  configure();
  expect_good_frame();
  const std::size_t before = bus.transfers();
  ASSERT_TRUE(device.read_frame().ok());
  EXPECT_EQ(bus.transfers() - before, 4U);
}

TEST_F(ReadFrame, SecondFrame_NeedsNoExtraTransfer) {
  configure();
  expect_good_frame();
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
  EXPECT_TRUE(device.read_frame().ok());
}

// EOT is still 1 and INSTR still 010 before the frame has begun: that is not the end.
TEST_F(ReadFrame, InstructionStillPending_IsNotTheEnd) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x04));
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kGoodFrame);
  bus.expect_read(kReadData4, kData4);
  bus.expect_write(kClearValid1);
  EXPECT_TRUE(device.read_frame().ok());
}

// Table 22: with NOCRC = 0 the CRC is in byte 7; all eight bytes are read.
TEST_F(ReadFrame, StoredCrc_IsReadAndReturned) {
  mb4::Config config = encoder26();
  config.spi_check = mb4::SpiCheck::kCrc;
  mb4test::expect_configure(bus, 0xE7, 0x00);
  ASSERT_TRUE(device.configure(config).ok());
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kGoodFrame);
  bus.expect_read(join({{0x09}, zeros(8)}), {0x00, 0xBF, 0x37, 0xAF, 0x0A, 0x00, 0x00, 0x00, 0x18});
  bus.expect_write(kClearValid1);
  const Result<Reading> reading = device.read_frame();
  ASSERT_TRUE(reading.ok());
  EXPECT_TRUE(reading->crc_stored);
  EXPECT_EQ(reading->crc, 0x18);
}

TEST_F(ReadFrame, SlaveReportsError_IsSlaveErrorWithItsReading) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kGoodFrame);
  bus.expect_read(kReadData4, {0x00, 0xBD, 0x37, 0xAF, 0x0A});  // nE = 0, nW = 1
  bus.expect_write(kClearValid1);
  const Result<Reading> reading = device.read_frame();
  EXPECT_EQ(reading.error(), Error::kSlaveError);
  EXPECT_TRUE(reading.reading().slave_error);
  EXPECT_FALSE(reading.reading().slave_warning);
  EXPECT_EQ(reading.reading().position, mb4test::kPosition);
  // The frame was good: the next one needs no BREAK.
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kGoodFrame);
  bus.expect_read(kReadData4, mb4test::kData4);
  bus.expect_write(kClearValid1);
  EXPECT_TRUE(device.read_frame().ok());
}

// ---- Wrong use ----------------------------------------------------------------------------------

TEST_F(ReadFrame, NotConfigured_IsAnErrorWithoutTransfer) {
  EXPECT_EQ(device.read_frame().error(), Error::kNotConfigured);
}

TEST_F(ReadFrame, SlaveNotEnabledOrOutOfRange_IsInvalidArgumentWithoutTransfer) {
  configure();
  EXPECT_EQ(device.read_frame(0).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.read_frame(2).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.read_frame(9).error(), Error::kInvalidArgument);
}

// ---- Bad frames ---------------------------------------------------------------------------------

// Table 55: nSCDERR is bit 4 of 0xF0; nERR, bit 7, follows it. The data is read only to see whether
// it is all 0.
TEST_F(ReadFrame, CrcError_IsCrc) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0x6B, 0x00));
  bus.expect_read(kReadData4, kData4);
  EXPECT_EQ(device.read_frame().error(), Error::kCrc);
}

// No CRC is stored, the chip says that the CRC is wrong, and all data bits are 0: the slave has
// sent nothing if its line is at 1 again (0xF8). While it is not, the driver looks again, for 100
// us.
TEST_F(ReadFrame, AllZeroAndLineIdle_IsNoWord) {
  const auto lines = [this](std::uint8_t f8) {
    bus.expect_read(mb4test::join({{0x05}, mb4test::zeros(9)}),
                    mb4test::join({mb4test::zeros(9), {f8}}));
  };
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0x6B, 0x00));
  bus.expect_read(kReadData4, mb4test::zeros(5));
  lines(0x00);
  lines(0x01);
  EXPECT_EQ(device.read_frame().error(), Error::kNoWord);
  expect_recovery();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0x6B, 0x00));
  bus.expect_read(kReadData4, mb4test::zeros(5));
  clock.step_us = 1000;
  lines(0x00);
  lines(0x00);
  lines(0x00);
  EXPECT_EQ(device.read_frame().error(), Error::kCrc);
}

// A chip that says both "CRC error" and "valid" contradicts itself: with one slave there is no
// other whose error it could be.
TEST_F(ReadFrame, CrcErrorWithValidFlag_IsCrc) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0x6B, 0x02));
  EXPECT_EQ(device.read_frame().error(), Error::kCrc);
}

TEST_F(ReadFrame, NoValidFlag_IsNoData) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kIdleStatus);
  EXPECT_EQ(device.read_frame().error(), Error::kNoData);
}

// SVALID of every other slave says nothing about slave 1.
TEST_F(ReadFrame, ValidFlagOfOtherSlaves_IsNoData) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, {0x00, 0xFB, 0xA8, 0xAA, 0x00, 0x00});
  EXPECT_EQ(device.read_frame().error(), Error::kNoData);
}

// Table 59 and page 32: nAGSERR is bit 6; the frame was not started. BREAK restores the flag.
TEST_F(ReadFrame, LineLowAtStart_IsLineErrorAfterBreak) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0x3B, 0x00));
  bus.expect_write(kBreak);
  EXPECT_EQ(device.read_frame().error(), Error::kLineError);
}

TEST_F(ReadFrame, UnusedBitsSet_IsCorrupted) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kGoodFrame);
  bus.expect_read(kReadData4, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF});
  bus.expect_write(kClearValid1);
  EXPECT_EQ(device.read_frame().error(), Error::kCorrupted);
}

TEST_F(ReadFrame, StatusAllOnesOrAllZeros_IsNotDetected) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, Bytes(6, 0xFF));
  EXPECT_EQ(device.read_frame().error(), Error::kNotDetected);
  expect_recovery();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, Bytes(6, 0x00));
  EXPECT_EQ(device.read_frame().error(), Error::kNotDetected);
}

TEST(ReadFrameFailure, TransportAtEachTransfer_IsReportedWithoutPosition) {
  for (std::size_t index = 0; index < 5; ++index) {
    StrictBus bus;
    FakeClock clock;
    mb4::Device<StrictBus, FakeClock> device(bus, clock);
    mb4test::expect_configure(bus);
    bus.expect_write(kStartFrame);
    bus.expect_read(kReadStatus, kRunning);
    bus.expect_read(kReadStatus, kGoodFrame);
    bus.expect_read(kReadData4, kData4);
    bus.expect_write(kClearValid1);
    bus.fail_at(mb4test::kConfigureTransfers + index);
    ASSERT_TRUE(device.configure(encoder26()).ok());
    const Result<Reading> reading = device.read_frame();
    EXPECT_FALSE(reading.ok()) << index;
    EXPECT_EQ(reading.error(), Error::kTransport) << index;
    EXPECT_EQ(reading.value_or(Reading()).raw, 0U) << index;
  }
}

// ---- A chip whose nAGSERR is 0 after each write of 0xF4 -----------------------------------------
// Page 34 can be read so; AGSERR_ON_INSTR_WRITE = 1 in the RTL of this project.
// 0x3B is 0xFB with nAGSERR (bit 6) and nERR (bit 7) at 0; 0x2B has nSCDERR (bit 4) at 0, too.

TEST_F(ReadFrame, StartErrorFlagFromTheWrite_DoesNotSpoilGoodFrame) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0x3B, 0x00, 0x04));  // not yet begun
  bus.expect_read(kReadStatus, status(0x3A, 0x00, 0x04));  // running
  bus.expect_read(kReadStatus, status(0x3B, 0x02));
  bus.expect_read(kReadData4, kData4);
  bus.expect_write(kClearValid1);
  const Result<Reading> reading = device.read_frame();
  ASSERT_TRUE(reading.ok());
  EXPECT_EQ(reading->position, mb4test::kPosition);
  expect_good_frame();  // and nothing has to be recovered
  EXPECT_TRUE(device.read_frame().ok());
}

TEST_F(ReadFrame, StartErrorFlagFromTheWriteAndCrcError_IsCrc) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0x2B, 0x00));
  bus.expect_read(kReadData4, kData4);
  EXPECT_EQ(device.read_frame().error(), Error::kCrc);
}

TEST_F(ReadFrame, StartErrorFlagAndCrcErrorWithValidFlag_IsCrc) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0x2B, 0x02));
  EXPECT_EQ(device.read_frame().error(), Error::kCrc);
}

// ---- After a failed read ------------------------------------------------------------------------
// Its frame may still run, and the chip ignores an equal INSTR until that frame's end: the result
// of the old request would pass for the new one's. BREAK first, then SVALID, then the request.

TEST_F(ReadFrame, FirstPollFailsInTransport_NextReadBreaksOldFrameFirst) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kRunning).fail_last();
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
  expect_recovery();
  expect_good_frame();
  const std::size_t before = bus.transfers();
  EXPECT_TRUE(device.read_frame().ok());
  EXPECT_EQ(bus.transfers() - before, 6U);
  expect_good_frame();  // only once
  EXPECT_TRUE(device.read_frame().ok());
}

TEST_F(ReadFrame, FirstPollReadsAllOnes_NextReadBreaksOldFrameFirst) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, Bytes(6, 0xFF));
  EXPECT_EQ(device.read_frame().error(), Error::kNotDetected);
  expect_recovery();
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

// The transfer may have reached the chip although the bus says that it failed.
TEST_F(ReadFrame, RequestFailsInTransport_NextReadBreaksFirst) {
  configure();
  bus.expect_write(kStartFrame).fail_last();
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
  expect_recovery();
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

TEST_F(ReadFrame, BadFrame_NextReadBreaksAndClearsOldValidFlagFirst) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0x6B, 0x00));
  bus.expect_read(kReadData4, kData4);
  EXPECT_EQ(device.read_frame().error(), Error::kCrc);
  expect_recovery();
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

// Bits were lost on SPI: the status that said "ended" is as doubtful as the data.
TEST_F(ReadFrame, CorruptedData_NextReadBreaksFirst) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kGoodFrame);
  bus.expect_read(kReadData4, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF});
  bus.expect_write(kClearValid1);
  EXPECT_EQ(device.read_frame().error(), Error::kCorrupted);
  expect_recovery();
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

TEST_F(ReadFrame, TransportFailureOfRecovery_StartsNoFrameAndIsRepeated) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kIdleStatus);
  EXPECT_EQ(device.read_frame().error(), Error::kNoData);
  bus.expect_write(kBreak).fail_last();
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
  bus.expect_write(kBreak);
  bus.expect_write(kClearValid1).fail_last();
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
  expect_recovery();
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

TEST_F(ReadFrame, WrongArgument_NeedsNoRecovery) {
  configure();
  EXPECT_EQ(device.read_frame(2).error(), Error::kInvalidArgument);
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

// configure() sends BREAK and clears SVALID itself.
TEST_F(ReadFrame, ConfiguredAfterFailedRead_NeedsNoRecovery) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kRunning).fail_last();
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
  configure();
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

// The time of each transfer.
struct TimedBus {
  StrictBus& bus;
  FakeClock& clock;
  std::vector<std::uint32_t> times_us{};

  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
    times_us.push_back(clock.time_us);
    return bus.transfer(tx, rx);
  }
};

// BREAK has stopped MA in the middle of the old frame. Until its timeout (40 us at most) the slave
// would take the clock of the new frame for the rest of the old one, and SL = 1 may be a data bit.
TEST(ReadFrameRecovery, SlaveCutOffByBreak_GetsItsTimeoutBeforeTheRequest) {
  StrictBus strict;
  FakeClock clock;
  TimedBus bus{strict, clock};
  mb4::Device<TimedBus, FakeClock> device(bus, clock);
  mb4test::expect_configure(strict);
  strict.expect_write(kStartFrame);
  strict.expect_read(kReadStatus, kRunning).fail_last();
  ASSERT_TRUE(device.configure(encoder26()).ok());
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
  strict.expect_write(kBreak);
  strict.expect_write(kClearValid1);
  strict.expect_write(kStartFrame).fail_last();
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
  // Configuration, request and status; then BREAK, SVALID and the request.
  constexpr std::size_t kBreakSent = mb4test::kConfigureTransfers + 2;
  ASSERT_EQ(bus.times_us.size(), kBreakSent + 3);
  EXPECT_GE(bus.times_us[kBreakSent + 1] - bus.times_us[kBreakSent], 100U);
}

TEST_F(ReadFrame, ClockStandsStillAfterFailedRead_RecoveryEnds) {
  configure();
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kRunning).fail_last();
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
  clock.step_us = 0;
  expect_recovery();
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

// ---- Timeouts -----------------------------------------------------------------------------------

mb4::Config with_timeout(std::uint32_t timeout_us) {
  mb4::Config config = encoder26();
  config.frame_timeout_us = timeout_us;
  return config;
}

// A clock of 32 kHz may show 133 us after 100 us (enc/bus.hpp). Asked at 0 (start), 45, 90, 135 us:
// the poll after the third is the last.
TEST_F(ReadFrame, SilentSlave_IsTimeoutAfterBreak) {
  configure(with_timeout(100));
  clock.step_us = 45;
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_write(kBreak);
  bus.expect_read(kReadLine, line_level(1));
  EXPECT_EQ(device.read_frame().error(), Error::kTimeout);
}

// The frame may end in the very last poll.
TEST_F(ReadFrame, EndSeenByLastPoll_IsGood) {
  configure(with_timeout(100));
  clock.step_us = 1000;
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kGoodFrame);
  bus.expect_read(kReadData4, kData4);
  bus.expect_write(kClearValid1);
  EXPECT_TRUE(device.read_frame().ok());
}

TEST_F(ReadFrame, ClockWraps_TimeoutIsUnchanged) {
  configure(with_timeout(100));
  clock.time_us = 0xFFFFFFE0;
  clock.step_us = 45;
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_write(kBreak);
  bus.expect_read(kReadLine, line_level(1));
  EXPECT_EQ(device.read_frame().error(), Error::kTimeout);
}

// The line gets 100 us to return to 1 after BREAK; within that it is only the slaves' timeout.
TEST_F(ReadFrame, LineReleasedAfterBreak_IsTimeout) {
  configure(with_timeout(100));
  clock.step_us = 67;
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_write(kBreak);
  bus.expect_read(kReadLine, line_level(0));
  bus.expect_read(kReadLine, line_level(1));
  EXPECT_EQ(device.read_frame().error(), Error::kTimeout);
}

TEST_F(ReadFrame, LineStaysLowAfterBreak_IsLineError) {
  configure(with_timeout(100));
  clock.step_us = 67;
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_write(kBreak);
  for (int look = 0; look < 4; ++look) bus.expect_read(kReadLine, line_level(0));
  EXPECT_EQ(device.read_frame().error(), Error::kLineError);
}

// No system clock: the chip keeps EOT = 1 and the instruction; that must not pass for a frame.
TEST_F(ReadFrame, InstructionNeverTaken_IsTimeout) {
  configure(with_timeout(100));
  clock.step_us = 133;
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x04));
  bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x04));
  bus.expect_write(kBreak);
  bus.expect_read(kReadLine, line_level(1));
  EXPECT_EQ(device.read_frame().error(), Error::kTimeout);
}

// 10 us with a clock that stands still: 4 polls a microsecond, and 33 us for the clock's step.
TEST_F(ReadFrame, ClockStandsStill_EndsAfterBoundedPolls) {
  configure(with_timeout(10));
  clock.step_us = 0;
  bus.expect_write(kStartFrame);
  for (int poll = 0; poll < 4 * (10 + 33); ++poll) {
    bus.expect_read(kReadStatus, kRunning);
  }
  bus.expect_write(kBreak);
  bus.expect_read(kReadLine, line_level(1));
  EXPECT_EQ(device.read_frame().error(), Error::kTimeout);
}

TEST(TimeoutFailure, TransportWhileStopping_IsTransport) {
  for (std::size_t index = 0; index < 2; ++index) {
    StrictBus bus;
    FakeClock clock;
    clock.step_us = 1000;
    mb4::Device<StrictBus, FakeClock> device(bus, clock);
    mb4test::expect_configure(bus);
    bus.expect_write(kStartFrame);
    bus.expect_read(kReadStatus, kRunning);
    bus.expect_read(kReadStatus, kRunning);
    bus.expect_write(kBreak);
    bus.expect_read(kReadLine, line_level(1));
    bus.fail_at(mb4test::kConfigureTransfers + 3 + index);
    ASSERT_TRUE(device.configure(encoder26()).ok());
    EXPECT_EQ(device.read_frame().error(), Error::kTransport) << index;
  }
}

TEST_F(ReadFrame, BreakAfterTimeoutFailsInTransport_NextReadBreaksAgain) {
  configure(with_timeout(100));
  clock.step_us = 1000;
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_write(kBreak).fail_last();
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
  expect_recovery();
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

}  // namespace read_frame_test
}  // namespace
