// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Control communication, transfer by transfer: pages 27 to 29, 34, 35.

#include "mb4/control.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "drivers/c/mb4_c_access.hpp"
#include "mb4/device.hpp"
#include "tests/driver/mb4/encoder26.hpp"
#include "tests/driver/mb4/strict_bus.hpp"
#include "tests/driver/mb4/three_slaves.hpp"

namespace {
namespace control_test {

using mb4::Error;
using mb4::ErrorInfo;
using mb4test::Bytes;
using mb4test::encoder26;
using mb4test::FakeClock;
using mb4test::join;
using mb4test::kBreak;
using mb4test::kClearValid1;
using mb4test::kReadStatus;
using mb4test::kRest;
using mb4test::StrictBus;
using mb4test::zeros;

const Bytes kFrame{0x07, 0x08};     // INSTR = 100: bits 3:1 of 0xF4 (table 45)
const Bytes kFrameAgs{0x07, 0x09};  // with AGS = 1
const Bytes kAgs{0x07, 0x01};
// 0xF0: nERR, nAGSERR, nDELAYERR, nSCDERR, nREGERR, REGEND, 1, EOT (tables 54 to 60); F3: REGBYTES.
Bytes status(std::uint8_t f0, std::uint8_t f4 = 0x00, std::uint8_t f3 = 0x00) {
  return {0x00, f0, 0x00, 0x00, f3, f4};
}
const Bytes kFrameRuns = status(0xFA, 0x08);
const Bytes kFrameOver = status(0xFB);
const Bytes kDone = status(0xFF);           // REGEND = 1, no error
const Bytes kRunsAgs = status(0xFB, 0x09);  // INSTR reads 100 until the end
const Bytes kDoneAgs = status(0xFF, 0x01);

class ControlTest : public testing::Test {
 protected:
  void configure(const mb4::Config& config = encoder26()) {
    mb4test::expect_configure(bus);
    ASSERT_TRUE(device.configure(config).ok());
  }
  void start_automatic(bool hold_beside_access = true) {
    mb4::Config config = encoder26();
    config.hold_beside_access = hold_beside_access;
    configure(config);
    bus.expect_write(kAgs);
    ASSERT_TRUE(device.automatic().start().ok());
  }
  // 0xE2: WNR and REGADR; 0xE3: REGNUM = count - 1; 0xE4: CHSEL; 0xE5: CTS, REGVERS, SLAVEID.
  void expect_begin(std::uint8_t e2, std::uint8_t e3, std::uint8_t e4, std::uint8_t e5) {
    bus.expect_proven({0x02, 0xE2, e2, e3, e4, e5});
    bus.expect_write(kFrame);
  }
  // Registers come in parts of eight.
  void expect_taken(const Bytes& registers) {
    for (std::size_t at = 0; at < registers.size(); at += 8) {
      const std::size_t end = at + 8 < registers.size() ? at + 8 : registers.size();
      const Bytes part(registers.begin() + static_cast<int>(at),
                       registers.begin() + static_cast<int>(end));
      bus.expect_read(join({{0x03, static_cast<std::uint8_t>(0x80 + at)}, zeros(part.size())}),
                      join({zeros(2), part}));
    }
  }
  void expect_filled(const Bytes& registers) {
    for (const bool back : {false, true}) {
      for (std::size_t at = 0; at < registers.size(); at += 8) {
        const std::size_t end = at + 8 < registers.size() ? at + 8 : registers.size();
        const Bytes part(registers.begin() + static_cast<int>(at),
                         registers.begin() + static_cast<int>(end));
        const std::uint8_t address = static_cast<std::uint8_t>(0x80 + at);
        if (back) {
          bus.expect_read(join({{0x03, address}, zeros(part.size())}), join({zeros(2), part}));
        } else {
          bus.expect_write(join({{0x02, address}, part}));
        }
      }
    }
  }
  // Two more frames, then the end.
  void expect_frames(const Bytes& end = kDone) {
    bus.expect_read(kReadStatus, kFrameOver);
    bus.expect_write(kFrame);
    bus.expect_read(kReadStatus, kFrameRuns);
    bus.expect_read(kReadStatus, end);
    expect_end();
  }
  void expect_end() {
    bus.expect_write(kClearValid1);
    bus.expect_write(kRest);
  }
  void expect_abort() {
    bus.expect_write(kBreak);
    bus.expect_write(kRest);
  }

  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device{bus, clock};
};

using Registers = ControlTest;
using RegistersAgs = ControlTest;
using Commands = ControlTest;
using Steps = ControlTest;

// ---- Registers without automatic frames ---------------------------------------------------------

TEST_F(Registers, ReadOne_OneInstructionAFrame) {
  configure();
  expect_begin(0x44, 0x00, 0x01, 0xC0);
  expect_frames();
  bus.expect_read({0x03, 0x80, 0x00}, {0x00, 0x00, 0x5F});
  std::uint8_t value = 0;
  ASSERT_TRUE(
      device.control().read_registers({1, 0}, 0x44, mb4::Span<std::uint8_t>(&value, 1)).ok());
  EXPECT_EQ(value, 0x5F);
}

// Table 31: SLAVEID in bits 5:3 of 0xE5.
TEST_F(Registers, ReadSixOfId5_HasItsFields) {
  configure();
  expect_begin(0x78, 0x05, 0x01, 0xE8);
  expect_frames();
  bus.expect_read(join({{0x03, 0x80}, zeros(6)}), {0, 0, 'M', 'U', 1, 2, 3, 4});
  std::array<std::uint8_t, 6> bytes{};
  ASSERT_TRUE(device.control().read_registers({1, 5}, 0x78, bytes).ok());
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 6>{'M', 'U', 1, 2, 3, 4}));
}

// Page 28: RDATA is written before INSTR; WNR is bit 7 of 0xE2.
TEST_F(Registers, WriteTwo_DataFirst) {
  configure();
  bus.expect_proven({0x02, 0x80, 0x12, 0x34});
  expect_begin(0xE0, 0x01, 0x01, 0xC0);
  expect_frames();
  const std::array<std::uint8_t, 2> data{0x12, 0x34};
  EXPECT_TRUE(device.control().write_registers({1, 0}, 0x60, data).ok());
}

// 128 registers are two accesses of 64.
TEST_F(Registers, ReadAll128_IsSplit) {
  configure();
  Bytes low(64, 0xA5);
  Bytes high(64, 0x5A);
  expect_begin(0x00, 0x3F, 0x01, 0xC0);
  expect_frames();
  expect_taken(low);
  expect_begin(0x40, 0x3F, 0x01, 0xC0);
  expect_frames();
  expect_taken(high);
  std::array<std::uint8_t, 128> bytes{};
  ASSERT_TRUE(device.control().read_registers({1, 0}, 0x00, bytes).ok());
  EXPECT_EQ(Bytes(bytes.begin(), bytes.end()), join({low, high}));
}

TEST_F(Registers, Write70_SecondPartContinues) {
  configure();
  std::array<std::uint8_t, 70> data{};
  for (std::size_t i = 0; i < data.size(); ++i) {
    data[i] = static_cast<std::uint8_t>(i);
  }
  expect_filled(Bytes(data.begin(), data.begin() + 64));
  expect_begin(0x80 | 0x10, 0x3F, 0x01, 0xC0);
  expect_frames();
  bus.expect_proven({0x02, 0x80, 64, 65, 66, 67, 68, 69});
  expect_begin(0x80 | 0x50, 0x05, 0x01, 0xC0);
  expect_frames(status(0x77, 0x00, 0x03));  // nREGERR = 0 after 3
  const ErrorInfo info = device.control().write_registers({1, 0}, 0x10, data).info();
  EXPECT_EQ(info.code, Error::kRegister);
  EXPECT_EQ(info.bytes(), 67);
}

// Table 57: nREGERR; table 63: REGBYTES.
TEST_F(Registers, RegisterError_NamesGoodBytes) {
  configure();
  expect_begin(0x10, 0x07, 0x01, 0xC0);
  expect_frames(status(0x77, 0x00, 0x05));
  std::array<std::uint8_t, 8> bytes{};
  const ErrorInfo info = device.control().read_registers({1, 0}, 0x10, bytes).info();
  EXPECT_EQ(info.code, Error::kRegister);
  EXPECT_EQ(info.bytes(), 5);
}

// Table 58: nDELAYERR, bit 5.
TEST_F(Registers, MissingStartBit_IsRegisterDelay) {
  configure();
  expect_begin(0x10, 0x00, 0x01, 0xC0);
  expect_frames(status(0x5F));
  std::array<std::uint8_t, 1> bytes{};
  EXPECT_EQ(device.control().read_registers({1, 0}, 0x10, bytes).error(), Error::kRegisterDelay);
}

TEST_F(Registers, SingleFrameAfterwards_NeedsNoRecovery) {
  configure();
  expect_begin(0x10, 0x00, 0x01, 0xC0);
  expect_frames(status(0x77));
  std::array<std::uint8_t, 1> bytes{};
  EXPECT_EQ(device.control().read_registers({1, 0}, 0x10, bytes).error(), Error::kRegister);
  bus.expect_write(mb4test::kStartFrame);
  bus.expect_read(kReadStatus, mb4test::kGoodFrame);
  bus.expect_read(mb4test::kReadData4, mb4test::kData4);
  bus.expect_write(kClearValid1);
  EXPECT_TRUE(device.read_frame().ok());
}

// A frame that does not end within frame_timeout_us().
TEST_F(Registers, SilentSlave_IsTimeoutAfterBreak) {
  configure();
  clock.step_us = 1000;
  expect_begin(0x10, 0x00, 0x01, 0xC0);
  bus.expect_read(kReadStatus, kFrameRuns);
  bus.expect_read(kReadStatus, kFrameRuns);  // after the time
  expect_abort();
  std::array<std::uint8_t, 1> bytes{};
  EXPECT_EQ(device.control().read_registers({1, 0}, 0x10, bytes).error(), Error::kTimeout);
}

// Without an end and with a clock that stands still the frames are counted: 49 for one register,
// one for each microsecond of register_busy_us, and one to round up.
TEST_F(Registers, NeverEnding_IsTimeoutAfterCountedFrames) {
  clock.step_us = 0;
  mb4::Config config = encoder26();
  config.register_busy_us = 39;
  mb4test::expect_configure(bus);
  ASSERT_TRUE(device.configure(config).ok());
  bus.expect_proven({0x02, 0xE2, 0x10, 0x00, 0x01, 0xC0});
  for (int frame = 0; frame < 49 + 39 + 1; ++frame) {
    bus.expect_write(kFrame);
    bus.expect_read(kReadStatus, kFrameOver);
  }
  expect_abort();
  std::array<std::uint8_t, 1> bytes{};
  EXPECT_EQ(device.control().read_registers({1, 0}, 0x10, bytes).error(), Error::kTimeout);
}

// REGEND = 1 may be left from the access before until the first frame has begun.
TEST_F(Registers, RegendOfTheLastAccess_IsNotTheEnd) {
  configure();
  expect_begin(0x10, 0x00, 0x01, 0xC0);
  bus.expect_read(kReadStatus, kDone);
  bus.expect_write(kFrame);
  bus.expect_read(kReadStatus, kDone);
  expect_end();
  bus.expect_read({0x03, 0x80, 0x00}, {0x00, 0x00, 0x01});
  std::array<std::uint8_t, 1> bytes{};
  EXPECT_TRUE(device.control().read_registers({1, 0}, 0x10, bytes).ok());
}

// A status that cannot be read is read again, up to twice, and so is the end sent again, which
// clears flags and brings the request at rest. A transfer that writes before is not repeated. The
// request at rest follows, because one bit of the address of RDATA may have reached it.
TEST(RegistersFailure, TransportAtEachTransfer_IsReportedAndNothingKeepsRunning) {
  for (std::size_t index = 0; index < 12; ++index) {
    StrictBus bus;
    FakeClock clock;
    mb4::Device<StrictBus, FakeClock> device(bus, clock);
    mb4test::expect_configure(bus);
    ASSERT_TRUE(device.configure(encoder26()).ok());
    bus.expect_proven({0x02, 0x80, 0x12});
    bus.expect_proven({0x02, 0xE2, 0xE0, 0x00, 0x01, 0xC0});
    bus.expect_write(kFrame);
    bus.expect_read(kReadStatus, kFrameOver);
    bus.expect_write(kFrame);
    bus.expect_read(kReadStatus, kFrameRuns);
    bus.expect_read(kReadStatus, kDone);
    bus.expect_write(kClearValid1);
    bus.expect_write(kRest);
    const bool all = index == 11;
    if (!all) {
      bus.fail_at(mb4test::kConfigureTransfers + index);
    }
    const bool looks = index == 5 || index == 7 || index == 8;
    for (int again = 0; looks && again < 2; ++again) {
      bus.expect_read(kReadStatus, kFrameOver).fail_last();
    }
    const bool runs = index >= 4 && index <= 8;
    if (runs) {
      bus.expect_write(kBreak);
    }
    if (index == 9 || index == 10) {
      bus.expect_write(kClearValid1);
    }
    if (!all) {
      bus.expect_write(kRest);
    }
    const std::array<std::uint8_t, 1> data{0x12};
    const mb4::Result<void> done = device.control().write_registers({1, 0}, 0x60, data);
    EXPECT_EQ(done.error(), index >= 9 ? Error::kNone : Error::kTransport) << index;
    EXPECT_EQ(mb4_c::PolledAccess(device).poll().error(), Error::kWrongMode) << index;
  }
}

// The end of a good access cannot be sent. Automatic frames must not go on beside a request that
// one disturbed bit would start; the next call sends the one at rest first, behind BREAK.
TEST_F(RegistersAgs, RequestAtRestLost_NextCallSendsItFirst) {
  start_automatic();
  const std::array<std::uint8_t, 1> data{0x12};
  bus.expect_proven({0x02, 0x80, 0x12});
  bus.expect_proven({0x02, 0xE2, 0xE0, 0x00, 0x01, 0xC0});
  bus.expect_write(kFrameAgs);
  bus.expect_read(kReadStatus, kDoneAgs);
  for (int tries = 0; tries < 3; ++tries) bus.expect_write(kRest).fail_last();
  EXPECT_EQ(device.control().write_registers({1, 0}, 0x60, data).error(), Error::kTransport);
  EXPECT_FALSE(device.automatic().running());
  expect_abort();
  bus.expect_write(kClearValid1);
  bus.expect_write(kAgs);
  EXPECT_TRUE(device.automatic().restart().ok());
  bus.expect_write(kBreak);
  EXPECT_TRUE(device.break_transmission().ok());
}

// ---- Wrong use ----------------------------------------------------------------------------------

TEST_F(Registers, WrongArguments_AreErrorsWithoutTransfer) {
  std::array<std::uint8_t, 129> bytes{};
  const mb4::Span<std::uint8_t> all(bytes);
  EXPECT_EQ(device.control().read_registers({1, 0}, 0, all.first(1)).error(),
            Error::kNotConfigured);
  configure();
  mb4_c::PolledAccess control(device);
  EXPECT_EQ(control.read_registers({1, 0}, 0x00, all).error(), Error::kInvalidArgument);
  EXPECT_EQ(control.read_registers({1, 0}, 0x00, all.first(0)).error(), Error::kInvalidArgument);
  EXPECT_EQ(control.read_registers({1, 0}, 0x7F, all.first(2)).error(), Error::kInvalidArgument);
  EXPECT_EQ(control.read_registers({1, 0}, 0x80, all.first(1)).error(), Error::kInvalidArgument);
  EXPECT_EQ(control.read_registers({1, 8}, 0x00, all.first(1)).error(), Error::kInvalidArgument);
  EXPECT_EQ(control.read_registers({0, 0}, 0x00, all.first(1)).error(), Error::kInvalidArgument);
  EXPECT_EQ(control.read_registers({3, 0}, 0x00, all.first(1)).error(), Error::kInvalidArgument);
  // Channel 2 is not in use.
  EXPECT_EQ(control.read_registers({2, 0}, 0x00, all.first(1)).error(), Error::kInvalidArgument);
  EXPECT_EQ(control.begin_read({1, 0}, 0x00, 65).error(), Error::kInvalidArgument);
  EXPECT_EQ(control.begin_write({1, 0}, 0x00, all.first(65)).error(), Error::kInvalidArgument);
  EXPECT_EQ(control.write_registers({1, 0}, 0x40, all.first(65)).error(), Error::kInvalidArgument);
  EXPECT_EQ(control.take(all.first(1)).error(), Error::kInvalidArgument);
  EXPECT_EQ(control.poll().error(), Error::kWrongMode);
}

// The frames of an access follow each other at once; SL is low then.
TEST(ControlConfig, FramesThatDoNotWait_AreUnsupported) {
  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device(bus, clock);
  mb4::Config config = encoder26();
  config.frame_start = mb4::FrameStart::kRequireIdleLine;
  mb4test::expect_configure(bus, 0xE8, 0x7D);
  ASSERT_TRUE(device.configure(config).ok());
  const ErrorInfo info = mb4_c::PolledAccess(device).begin_read({1, 0}, 0, 1).info();
  EXPECT_EQ(info.code, Error::kUnsupported);
  EXPECT_EQ(info.field, mb4::ConfigField::kFrameStart);
}

// ---- Step by step -------------------------------------------------------------------------------

TEST_F(Steps, Poll_NeverWaits) {
  configure();
  expect_begin(0x10, 0x01, 0x01, 0xC0);
  mb4_c::PolledAccess control(device);
  ASSERT_TRUE(control.begin_read({1, 0}, 0x10, 2).ok());
  EXPECT_EQ(control.begin_read({1, 0}, 0x10, 2).error(), Error::kBusy);
  EXPECT_EQ(device.read_frame().error(), Error::kBusy);
  EXPECT_EQ(device.automatic().start().error(), Error::kBusy);
  EXPECT_EQ(device.automatic().stop().error(), Error::kBusy);
  bus.expect_read(kReadStatus, kFrameRuns);
  EXPECT_FALSE(*control.poll());
  bus.expect_read(kReadStatus, kFrameOver);
  bus.expect_write(kFrame);
  EXPECT_FALSE(*control.poll());
  // A failed look changes nothing, twice in a row.
  bus.expect_read(kReadStatus, kDone).fail_last();
  EXPECT_FALSE(*control.poll());
  bus.expect_read(kReadStatus, Bytes(6, 0xFF));
  EXPECT_FALSE(*control.poll());
  bus.expect_read(kReadStatus, kDone);
  expect_end();
  EXPECT_TRUE(*control.poll());
  std::array<std::uint8_t, 3> bytes{};
  EXPECT_EQ(control.take(bytes).error(), Error::kInvalidArgument);
  bus.expect_read({0x03, 0x80, 0, 0}, {0, 0, 1, 2});
  EXPECT_TRUE(control.take(mb4::Span<std::uint8_t>(bytes.data(), 2)).ok());
  EXPECT_EQ(control.poll().error(), Error::kWrongMode);
}

TEST_F(Steps, Abort_BreaksAndFreesTheChip) {
  configure();
  expect_begin(0x10, 0x00, 0x01, 0xC0);
  ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x10, 1).ok());
  expect_abort();
  EXPECT_TRUE(device.control().abort().ok());
  EXPECT_EQ(mb4_c::PolledAccess(device).poll().error(), Error::kWrongMode);
  // The aborted access may still run: BREAK and the slaves' timeout come first.
  bus.expect_write(kBreak);
  bus.expect_write(kClearValid1);
  bus.expect_proven({0x02, 0xE2, 0x11, 0x00, 0x01, 0xC0});
  bus.expect_write(kFrame);
  EXPECT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x11, 1).ok());
}

TEST_F(Steps, ThreeFailedLooks_AreTheEnd) {
  configure();
  expect_begin(0x10, 0x00, 0x01, 0xC0);
  mb4_c::PolledAccess control(device);
  ASSERT_TRUE(control.begin_read({1, 0}, 0x10, 1).ok());
  for (int look = 0; look < 2; ++look) {
    bus.expect_read(kReadStatus, zeros(6));
    EXPECT_FALSE(*control.poll());
  }
  bus.expect_read(kReadStatus, zeros(6));
  expect_abort();
  EXPECT_EQ(control.poll().error(), Error::kNotDetected);
  EXPECT_EQ(control.poll().error(), Error::kWrongMode);
}

// An access of an Operation is not that of poll().
TEST_F(Steps, PollOfAnOperation_IsWrongMode) {
  configure();
  expect_begin(0x10, 0x00, 0x01, 0xC0);
  ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x10, 1).ok());
  expect_abort();
  ASSERT_TRUE(device.control().abort().ok());
  mb4::Operation operation;
  std::uint8_t value = 0;
  ASSERT_TRUE(device.control().plan_read(operation, {1, 0}, 0x10, {&value, 1}).ok());
  EXPECT_EQ(mb4_c::PolledAccess(device).poll().error(), Error::kWrongMode);
}

// Positions are read meanwhile: by next() too, which waits for the end of a frame.
TEST_F(RegistersAgs, NextMeanwhile_AccessGoesOn) {
  start_automatic();
  bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
  bus.expect_write(kFrameAgs);
  ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
  bus.expect_read(kReadStatus, {0, 0xFB, 0x02, 0, 0, 0x09});
  bus.expect_write({0x07, 0x41});
  bus.expect_read(mb4test::kReadData4, mb4test::kData4);
  bus.expect_read(kReadStatus, {0, 0xFB, 0x02, 0, 0, 0x41});
  bus.expect_write(mb4test::kClearValid1AndRelease);
  mb4::Frame frame;
  ASSERT_TRUE(device.automatic().next(frame).ok());
  EXPECT_TRUE(frame.one_frame);
  EXPECT_FALSE(*mb4_c::PolledAccess(device).poll());  // what next() has seen
  // And so is the configuration compared.
  for (const auto& one : mb4test::comparison(mb4test::read_back(), kRunsAgs)) {
    bus.expect_read(one.mosi, one.miso);
  }
  EXPECT_TRUE(device.verify().ok());
  bus.expect_read(kReadStatus, kDoneAgs);
  bus.expect_write(kRest);
  EXPECT_TRUE(*mb4_c::PolledAccess(device).poll());
}

// next() restarts after a bad frame, but not while an access runs: that would end it.
TEST_F(RegistersAgs, NextAfterABadFrame_RestartsWhenTheAccessHasEnded) {
  start_automatic();
  mb4::Frame frame;
  const auto expect_frame = [this](std::uint8_t f4, bool good) {
    const std::uint8_t f0 = good ? 0xFB : 0x6B;  // nSCDERR = 0, nERR = 0
    const std::uint8_t valid = good ? 0x02 : 0x00;
    bus.expect_read(kReadStatus, {0, f0, valid, 0, 0, f4});
    bus.expect_write({0x07, 0x41});
    bus.expect_read(mb4test::kReadData4, mb4test::kData4);
    bus.expect_read(kReadStatus, {0, f0, valid, 0, 0, 0x41});
    bus.expect_write(good ? mb4test::kClearValid1AndRelease : kAgs);
  };
  for (const bool access : {true, false}) {
    expect_frame(0x01, false);
    ASSERT_TRUE(device.automatic().next(frame).ok());
    EXPECT_EQ(frame[1].error(), Error::kCrc);
    if (access) {
      bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
      bus.expect_write(kFrameAgs);
      ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
    } else {
      bus.expect_write(kBreak);
      bus.expect_write(kClearValid1);
      bus.expect_write(kAgs);
    }
    expect_frame(access ? 0x09 : 0x01, true);
    ASSERT_TRUE(device.automatic().next(frame).ok());
    EXPECT_TRUE(frame[1].ok());
    if (access) {
      EXPECT_FALSE(*mb4_c::PolledAccess(device).poll());  // what next() has seen
      bus.expect_read(kReadStatus, kDoneAgs);
      bus.expect_write(kRest);
      EXPECT_TRUE(*mb4_c::PolledAccess(device).poll());
      std::array<std::uint8_t, 1> value{};
      EXPECT_EQ(mb4_c::PolledAccess(device).take(mb4::Span<std::uint8_t>(value).first(0)).error(),
                Error::kInvalidArgument);
      bus.expect_read({0x03, 0x80, 0x00}, {0, 0, 0x77});
      ASSERT_TRUE(mb4_c::PolledAccess(device).take(value).ok());
      EXPECT_EQ(value[0], 0x77);
    }
  }
}

// ---- After a failed call ------------------------------------------------------------------------

// An access whose BREAK was lost may still run: it must not take the bytes of the next one.
TEST_F(Registers, AfterALostBreak_BreakComesBeforeTheBytes) {
  configure();
  expect_begin(0x10, 0x00, 0x01, 0xC0);
  bus.expect_read(kReadStatus, kFrameRuns);
  for (int look = 0; look < 3; ++look) bus.expect_read(kReadStatus, kFrameRuns).fail_last();
  bus.expect_write(kBreak).fail_last();
  std::array<std::uint8_t, 1> bytes{0x77};
  EXPECT_EQ(device.control().read_registers({1, 0}, 0x10, bytes).error(), Error::kTransport);
  expect_abort();
  bus.expect_write(kClearValid1);
  bus.expect_proven({0x02, 0x80, 0x77});
  bus.expect_write({0x02, 0xE2, 0xA0, 0x00, 0x01, 0xC0}).fail_last();
  bus.expect_write(kRest).fail_last();
  EXPECT_EQ(device.control().write_registers({1, 0}, 0x20, bytes).error(), Error::kTransport);
}

// Bytes of RDATA that arrive disturbed may have gone to other registers, 0xF4 among them: next()
// starts the frames again.
TEST_F(RegistersAgs, DisturbedFill_IsFollowedByARestart) {
  mb4::Config config = encoder26();
  config.spi_check = mb4::SpiCheck::kFull;
  mb4test::expect_configure(bus, 0xE7, 0x00);
  ASSERT_TRUE(device.configure(config).ok());
  const Bytes answer = mb4test::answer_at_full();
  mb4test::expect_start_at_full(bus, kClearValid1, answer);
  ASSERT_TRUE(device.automatic().start().ok());
  const std::array<std::uint8_t, 1> data{0x12};
  bus.expect_write({0x02, 0x80, 0x12});
  bus.expect_read({0x03, 0x00, 0x01}, {0, 0, 0x34});
  bus.expect_read({0x03, 0x80, 0x00}, {0, 0, 0x02});
  bus.expect_read({0x03, 0xC0, 0x00}, {0, 0, 0x5B});
  bus.expect_read(mb4test::kReadWitness, {0, 0xFB, 0, 0, 0, 0x01, 0});
  mb4test::expect_rest_at_full(bus);  // the bytes may be there; the configuration is compared
  const Bytes word{0x34, 0x12, 0, 0, 0, 0, 0, 0x2A};  // in SCDATA1
  for (const auto& one : mb4test::comparison(answer, {0, 0xFB, 0, 0, 0, 0x01}, word)) {
    bus.expect_read(one.mosi, one.miso);
  }
  EXPECT_EQ(device.control().write_registers({1, 0}, 0x60, data).error(), Error::kCorrupted);
  bus.expect_write({0x07, 0x80, 0x00}).fail_last();
  mb4::Frame frame;
  EXPECT_EQ(device.automatic().next(frame).error(), Error::kTransport);
}

// One status that cannot be read beside automatic frames: they go on.
TEST_F(RegistersAgs, DisturbedStatus_FramesGoOn) {
  start_automatic();
  bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
  bus.expect_write(kFrameAgs);
  bus.expect_read(kReadStatus, kRunsAgs).fail_last();
  bus.expect_read(kReadStatus, Bytes(6, 0xFF));
  bus.expect_read(kReadStatus, kDoneAgs);
  bus.expect_write(kRest);
  bus.expect_read({0x03, 0x80, 0x00}, {0x00, 0x00, 0x77});
  std::array<std::uint8_t, 1> bytes{};
  EXPECT_TRUE(device.control().read_registers({1, 0}, 0x44, bytes).ok());
  EXPECT_TRUE(device.automatic().running());
}

// ---- Registers beside automatic frames ----------------------------------------------------------

TEST_F(RegistersAgs, ReadOne_OneInstructionForAll) {
  start_automatic();
  bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
  bus.expect_write(kFrameAgs);
  bus.expect_read(kReadStatus, kRunsAgs);
  bus.expect_read(kReadStatus, kRunsAgs);
  bus.expect_read(kReadStatus, kDoneAgs);
  bus.expect_write(kRest);
  bus.expect_read({0x03, 0x80, 0x00}, {0x00, 0x00, 0x77});
  std::array<std::uint8_t, 1> bytes{};
  ASSERT_TRUE(device.control().read_registers({1, 0}, 0x44, bytes).ok());
  EXPECT_EQ(bytes[0], 0x77);
  EXPECT_TRUE(device.automatic().running());
}

// 49 frames of 220 us, 4096 * 64 periods of MA and a quarter, 200 us of margin: 174 860 us.
TEST_F(RegistersAgs, NeverEnding_IsTimeoutAndFramesCanBeRestarted) {
  start_automatic();
  bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
  bus.expect_write(kFrameAgs);
  ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
  clock.time_us += 174'800;
  bus.expect_read(kReadStatus, kRunsAgs);
  EXPECT_FALSE(*mb4_c::PolledAccess(device).poll());
  clock.time_us += 100;
  bus.expect_read(kReadStatus, kRunsAgs);
  expect_abort();
  EXPECT_EQ(mb4_c::PolledAccess(device).poll().error(), Error::kTimeout);
  EXPECT_FALSE(device.automatic().running());
  bus.expect_write(kBreak);
  bus.expect_write(kClearValid1);
  bus.expect_write(kAgs);
  bus.expect_read(kReadStatus, {0, 0xFB, 0x02, 0, 0, 1}).fail_last();
  mb4::Frame frame;
  EXPECT_EQ(device.automatic().next(frame).error(), Error::kTransport);
}

// With Config::hold_beside_access = false 0xF4 is never written.
class PollBesideControl : public ControlTest {
 protected:
  void SetUp() override {
    start_automatic(false);
    bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
    bus.expect_write(kFrameAgs);
    ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
  }
  void expect_read(const Bytes& after) {
    bus.expect_read(kReadStatus, {0, 0xFB, 0x02, 0, 0, 0x09});
    bus.expect_write(kClearValid1);
    bus.expect_read(mb4test::kReadData4, mb4test::kData4);
    bus.expect_read(kReadStatus, after);
  }
  mb4::Frame frame;
};

TEST_F(PollBesideControl, NoSwitch_IsRead) {
  expect_read(kRunsAgs);
  ASSERT_TRUE(device.automatic().poll(frame).ok());
  EXPECT_EQ(frame[1]->position, mb4test::kPosition);
}

// A frame may have ended behind the first look, and then a whole period is left.
TEST_F(PollBesideControl, NothingNew_IsLookedForTwice) {
  bus.expect_read(kReadStatus, kRunsAgs);
  expect_read(kRunsAgs);
  ASSERT_TRUE(device.automatic().poll(frame).ok());
  EXPECT_EQ(frame[1]->position, mb4test::kPosition);
  bus.expect_read(kReadStatus, kRunsAgs);
  bus.expect_read(kReadStatus, kRunsAgs);
  ASSERT_TRUE(device.automatic().poll(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kNoData);
}

// SVALID is 1 again: a frame has ended meanwhile.
TEST_F(PollBesideControl, GoodFrameEnded_IsReadAgain) {
  expect_read({0, 0xFB, 0x02, 0, 0, 0x09});
  expect_read(kRunsAgs);
  ASSERT_TRUE(device.automatic().poll(frame).ok());
  EXPECT_EQ(frame[1]->position, mb4test::kPosition);
}

TEST_F(PollBesideControl, GoodFrameEndedTwice_IsBankSwitched) {
  expect_read({0, 0xFB, 0x02, 0, 0, 0x09});
  expect_read({0, 0xFB, 0x02, 0, 0, 0x09});
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kBankSwitched);
  EXPECT_FALSE(frame[1].ok());
}

TEST_F(PollBesideControl, SwitchedTwice_IsCounted) {
  mb4_counts counts{};
  device.automatic().count(&counts);
  expect_read({0, 0xFB, 0x02, 0, 0, 0x09});
  expect_read({0, 0xFB, 0x02, 0, 0, 0x09});
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kBankSwitched);
  EXPECT_EQ(counts.switched, 1U);
}

TEST_F(PollBesideControl, NoStatus_IsNotDetected) {
  bus.expect_read(kReadStatus, zeros(6));
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kNotDetected);
  expect_read(Bytes(6, 0xFF));
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kNotDetected);
  EXPECT_FALSE(frame[1].ok());
}

// SpiCheck::kFull reads a word without a stored CRC twice: 64 bits leave no room for it.
TEST(PollBesideControlFull, WordWithoutCrc_IsReadTwice) {
  for (const bool same : {true, false}) {
    StrictBus bus;
    FakeClock clock;
    mb4::Device<StrictBus, FakeClock> device(bus, clock);
    mb4::Config config = encoder26();
    config.slaves[0].data_bits = 64;
    config.spi_check = mb4::SpiCheck::kFull;
    config.hold_beside_access = false;
    Bytes image = mb4test::configuration();
    Bytes answer = mb4test::read_back();
    for (Bytes* bytes : {&image, &answer}) {
      (*bytes)[0] = 0x40 | 63;
      (*bytes)[0xE7 - 0xC0] = 0x00;
    }
    mb4test::expect_image(bus, image, answer);
    ASSERT_TRUE(device.configure(config).ok());
    mb4test::expect_start_at_full(bus, kClearValid1, answer);
    ASSERT_TRUE(device.automatic().start().ok());
    bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
    bus.expect_write(kFrameAgs);
    bus.expect_read(kReadStatus, kRunsAgs);
    ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
    const Bytes read = join({{0x09}, Bytes(8, mb4test::kFiller)});
    const Bytes word{0, 3, 2, 3, 4, 5, 6, 7, 8};
    Bytes again = word;
    if (!same) again[8] ^= 1;
    bus.expect_read(kReadStatus, {0, 0xFB, 0x02, 0, 0, 0x09});
    bus.expect_read(kReadStatus, {0, 0xFB, 0x02, 0, 0, 0x09});
    bus.expect_write(kClearValid1);
    bus.expect_read(read, word);
    bus.expect_read(kReadStatus, kRunsAgs);
    bus.expect_read(read, again);
    bus.expect_read(kReadStatus, kRunsAgs);
    const mb4::Result<mb4::Reading> reading = device.automatic().poll_slave(1);
    EXPECT_EQ(reading.error(), same ? Error::kNone : Error::kCorrupted);
    if (reading) {
      EXPECT_EQ(reading->raw, 0x0807060504030203U);
    }
  }
}

// The plan of a chain is not that of a read beside an access without HOLDBANK.
TEST(PollBesideAccess, PlannedBefore_IsPlannedAnew) {
  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device(bus, clock);
  mb4::Config config = encoder26();
  config.hold_beside_access = false;
  mb4test::expect_configure(bus);
  ASSERT_TRUE(device.configure(config).ok());
  bus.expect_write(kAgs);
  ASSERT_TRUE(device.automatic().start().ok());
  mb4::CyclicRead read;
  const auto answer = [&read](std::size_t frame, const Bytes& bytes) {
    ASSERT_EQ(read.rx(frame).size(), bytes.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) read.rx(frame)[i] = bytes[i];
  };
  ASSERT_TRUE(device.automatic().plan_slave(1, read).ok());
  ASSERT_EQ(read.frames(), 4U);
  answer(1, mb4test::kData4);
  answer(2, {0, 0xFB, 0x02, 0, 0, 0x41});
  ASSERT_TRUE(device.automatic().finish(read, true, 2000));
  EXPECT_EQ(read.result()->position, mb4test::kPosition);
  bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
  bus.expect_write(kFrameAgs);
  ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
  ASSERT_TRUE(device.automatic().plan_slave(1, read).ok());
  ASSERT_EQ(read.frames(), 1U);
  EXPECT_EQ(read.tx(0)[0], 0x05);
  answer(0, {0, 0xFB, 0x02, 0, 0, 0x09});
  ASSERT_FALSE(device.automatic().finish(read, true, 2000));
  ASSERT_EQ(read.frames(), 3U);  // SVALID = 0, data, status
  answer(1, mb4test::kData4);
  answer(2, kRunsAgs);
  ASSERT_TRUE(device.automatic().finish(read, true, 2000));
  EXPECT_EQ(read.result()->position, mb4test::kPosition);
}

// So does a bad one, which leaves SVALID at 0.
TEST_F(PollBesideControl, BadFrameEnded_IsBankSwitched) {
  expect_read({0, 0x6B, 0x00, 0, 0, 0x09});
  expect_read({0, 0x6B, 0x00, 0, 0, 0x09});
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kBankSwitched);
}

// The second try finds nothing new. What the first one has read stays dropped.
TEST_F(PollBesideControl, BadFrameEndedAndThenNothingNew_IsNoData) {
  expect_read({0, 0x6B, 0x00, 0, 0, 0x09});
  bus.expect_read(kReadStatus, {0, 0x6B, 0x00, 0, 0, 0x09});
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNoData);
}

TEST_F(PollBesideControl, Restart_IsBusy) {
  EXPECT_EQ(device.automatic().restart().error(), Error::kBusy);
  EXPECT_EQ(device.automatic().stop().error(), Error::kBusy);
}

TEST(PollBesideControlFailure, TransportAtEachTransfer_LeavesNoReading) {
  for (std::size_t index = 0; index < 4; ++index) {
    StrictBus bus;
    FakeClock clock;
    mb4::Device<StrictBus, FakeClock> device(bus, clock);
    mb4test::expect_configure(bus);
    bus.expect_write(kAgs);
    bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
    bus.expect_write(kFrameAgs);
    mb4::Config config = encoder26();
    config.hold_beside_access = false;
    ASSERT_TRUE(device.configure(config).ok());
    ASSERT_TRUE(device.automatic().start().ok());
    ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
    bus.expect_read(kReadStatus, {0, 0xFB, 0x02, 0, 0, 0x09});
    bus.expect_write(kClearValid1);
    bus.expect_read(mb4test::kReadData4, mb4test::kData4);
    bus.expect_read(kReadStatus, kRunsAgs);
    bus.fail_at(mb4test::kConfigureTransfers + 4 + index);
    mb4::Frame frame;
    EXPECT_EQ(device.automatic().poll(frame).error(), Error::kTransport) << index;
    EXPECT_FALSE(frame[1].ok()) << index;
  }
}

// Table 69 beside an access: the byte with HOLDBANK has INSTR = 000, never 100.
class HoldBesideControl : public ControlTest {
 protected:
  void begin(mb4::SpiCheck check) {
    mb4::Config config = encoder26();
    config.spi_check = check;
    mb4test::expect_configure(bus, 0xE7, check == mb4::SpiCheck::kOff ? 0x02 : 0x00);
    ASSERT_TRUE(device.configure(config).ok());
    if (check == mb4::SpiCheck::kFull) {
      mb4test::expect_start_at_full(bus, kClearValid1, mb4test::answer_at_full());
    } else {
      bus.expect_write(kAgs);
    }
    ASSERT_TRUE(device.automatic().start().ok());
    bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
    bus.expect_write(kFrameAgs);
    if (check == mb4::SpiCheck::kFull) {
      bus.expect_read(kReadStatus, {0, kRuns, 0, 0, 0, 0x09});
    }
    ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
  }
  // Nothing new; 0xF0 as given.
  void expect_look(std::uint8_t f0, bool full = false) {
    bus.expect_write({0x07, 0x41});
    if (!full) {
      bus.expect_read(mb4test::kReadData4, mb4test::kData4);
    }
    bus.expect_read(kReadStatus, {0, f0, 0, 0, 0, 0x41});
    bus.expect_write(kAgs);
  }
  static constexpr std::uint8_t kRuns = 0xFB;
  static constexpr std::uint8_t kEnded = 0xFF;
};

TEST_F(HoldBesideControl, NewFrame_FollowsTable69) {
  begin(mb4::SpiCheck::kOff);
  bus.expect_write({0x07, 0x41});
  bus.expect_read(mb4test::kReadData4, mb4test::kData4);
  bus.expect_read(kReadStatus, {0, 0xFB, 0x02, 0, 0, 0x41});
  bus.expect_write(mb4test::kClearValid1AndRelease);
  EXPECT_EQ(device.automatic().poll_slave(1)->position, mb4test::kPosition);
}

// What the read of positions has seen needs no transfer of its own, once.
TEST_F(HoldBesideControl, StatusOfTheRead_ServesTheAccess) {
  begin(mb4::SpiCheck::kOff);
  expect_look(kRuns);
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNoData);
  EXPECT_FALSE(*mb4_c::PolledAccess(device).poll());
  bus.expect_read(kReadStatus, {0, kRuns, 0, 0, 0, 0x01});
  EXPECT_FALSE(*mb4_c::PolledAccess(device).poll());
  expect_look(kEnded);
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNoData);
  bus.expect_read(kReadStatus, {0, kEnded, 0, 0, 0, 0x01});
  bus.expect_write(kRest);
  EXPECT_TRUE(*mb4_c::PolledAccess(device).poll());
}

// Behind the time limit the status is read once more, whatever a read has seen.
TEST_F(HoldBesideControl, TimeOver_IsTimeoutAfterAnotherLook) {
  begin(mb4::SpiCheck::kOff);
  expect_look(kRuns);
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNoData);
  clock.time_us += 200'000;
  bus.expect_read(kReadStatus, {0, kRuns, 0, 0, 0, 0x01});
  expect_abort();
  EXPECT_EQ(mb4_c::PolledAccess(device).poll().error(), Error::kTimeout);
}

// INSTR = 000 is the driver's own: one bit more must not look like the end.
TEST_F(HoldBesideControl, FlippedRegend_DoesNotEndTheAccess) {
  begin(mb4::SpiCheck::kFull);
  expect_look(kRuns, true);
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNoData);
  EXPECT_FALSE(*mb4_c::PolledAccess(device).poll());
  bus.expect_read(kReadStatus, {0, kEnded, 0, 0, 0, 0x01});
  bus.expect_read(kReadStatus, {0, kRuns, 0, 0, 0, 0x01});
  EXPECT_FALSE(*mb4_c::PolledAccess(device).poll());
  bus.expect_read(kReadStatus, {0, kEnded, 0, 0, 0, 0x01});
  bus.expect_read(kReadStatus, {0, kEnded, 0, 0, 0, 0x01});
  bus.expect_read({0x03, 0x80, mb4test::kFiller}, {0, 0, 0x77});  // RDATA1, which take() compares
  bus.expect_read(mb4test::kReadWitness, {0, kEnded, 0, 0, 0, 0x01, 0});
  mb4test::expect_rest_at_full(bus);
  EXPECT_TRUE(*mb4_c::PolledAccess(device).poll());
}

// ---- Commands -----------------------------------------------------------------------------------

// Table 32: IDS0 is bit 7 of 0x80. Table 33: CMD in bits 5:4, table 34: IDA_TEST bit 3 of 0xE5.
TEST_F(Commands, AddressedWithTest_HasItsFields) {
  configure();
  bus.expect_proven({0x02, 0x80, 0xA0});        // ID 0 and ID 2
  bus.expect_proven({0x02, 0xE4, 0x01, 0x58});  // CTS = 0, REGVERS = 1, CMD = 01, IDA_TEST = 1
  bus.expect_write(kFrame);
  expect_frames();
  mb4::Command command;
  command.ids = 0x05;
  command.code = 1;
  command.test_acknowledge = true;
  EXPECT_TRUE(device.control().send(command).ok());
}

TEST_F(Commands, Broadcast_HasNoIds) {
  configure();
  bus.expect_proven({0x02, 0x80, 0x00});
  bus.expect_proven({0x02, 0xE4, 0x01, 0x60});
  bus.expect_write(kFrame);
  expect_frames();
  mb4::Command command;
  command.code = 2;
  EXPECT_TRUE(device.control().send(command).ok());
}

// Page 34: nREGERR is also the error in IDA.
TEST_F(Commands, NotAcknowledged_IsCommand) {
  configure();
  bus.expect_proven({0x02, 0x80, 0x01});
  bus.expect_proven({0x02, 0xE4, 0x01, 0x40});
  bus.expect_write(kFrame);
  expect_frames(status(0x77));
  mb4::Command command;
  command.ids = 0x80;
  EXPECT_EQ(device.control().send(command).error(), Error::kCommand);
}

TEST(CommandChannels, BothAtOnce_IsAllowed) {
  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device(bus, clock);
  mb4test::expect_configure_three(bus);
  ASSERT_TRUE(device.configure(mb4test::three_slaves()).ok());
  bus.expect_proven({0x02, 0x80, 0x00});
  bus.expect_proven({0x02, 0xE4, 0x03, 0x40});
  bus.expect_write(kFrame);
  mb4::Command command;
  command.channels = 3;
  EXPECT_TRUE(mb4_c::PolledAccess(device).begin_command(command).ok());
}

TEST_F(Commands, WrongArguments_AreErrorsWithoutTransfer) {
  EXPECT_EQ(device.control().send({}).error(), Error::kNotConfigured);
  configure();
  const mb4::Command wrong[] = {{0, 1, 0, false}, {2, 1, 0, false}, {3, 1, 0, false},
                                {4, 1, 0, false}, {1, 1, 4, false}, {1, 0, 3, false},
                                {1, 0, 0, true}};
  for (const mb4::Command& command : wrong) {
    EXPECT_EQ(device.control().send(command).error(), Error::kInvalidArgument);
  }
}

// ---- IDs: the far end of the chain is ID 0 ------------------------------------------------------

static_assert(mb4::slave_address(mb4test::three_slaves(), 1).id == 1);
static_assert(mb4::slave_address(mb4test::three_slaves(), 2).id == 0);
static_assert(mb4::slave_address(mb4test::three_slaves(), 5).id == 0);
static_assert(mb4::slave_address(mb4test::three_slaves(), 5).channel == 2);
static_assert(mb4::slave_address(encoder26(), 1).id == 0);

}  // namespace control_test
}  // namespace
