// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// SpiCheck::kFull, transfer by transfer: the second readings, and the error that a difference
// causes.

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/c/mb4_c_access.hpp"
#include "mb4/mb4.hpp"
#include "tests/driver/mb4/encoder26.hpp"
#include "tests/driver/mb4/strict_bus.hpp"

namespace {
namespace full_check_test {

using mb4::Error;
using mb4test::Bytes;
using mb4test::FakeClock;
using mb4test::join;
using mb4test::kClearValid1;
using mb4test::kGoodFrame;
using mb4test::kIdleStatus;
using mb4test::kReadStatus;
using mb4test::kStartFrame;
using mb4test::status;
using mb4test::StrictBus;
using mb4test::zeros;

const Bytes kAgs{0x07, 0x01};                      // AGS: bit 0 of 0xF4 (table 44)
const Bytes kHold{0x07, 0x41};                     // and HOLDBANK, bit 6 (table 48)
const Bytes kBreakAndInterface{0x07, 0x80, 0x00};  // BREAK: bit 7; 0xF5 as configured
const Bytes kReadAll =
    join({{0x09}, Bytes(8, mb4test::kFiller)});  // eight bytes, the CRC in the last (page 26)
const Bytes kAllOf = join({mb4test::kData4, {0, 0, 0, mb4test::kCrc6}});
const Bytes kNew = status(0xFA, 0x02, 0x41);
const Bytes kCleared = status(0xFA, 0x00, 0x41);

const Bytes kClearBoth{0x02, 0xF1, 0xF5, 0xFF};  // SVALID of slaves 1 and 2

// Slave 2 as slave 1.
void configure_two(StrictBus& bus, mb4::Device<StrictBus, FakeClock>& device, mb4::SpiCheck check,
                   bool hold_beside_access = true) {
  mb4::Config config = mb4test::encoder26();
  config.spi_check = check;
  config.hold_beside_access = hold_beside_access;
  config.slaves[1] = config.slaves[0];
  Bytes image = mb4test::configuration();
  Bytes answer = mb4test::read_back();
  for (Bytes* bytes : {&image, &answer}) {
    (*bytes)[0xE7 - 0xC0] = 0x00;  // NOCRC = 0 (table 21)
    (*bytes)[4] = 0x5B;
    (*bytes)[5] = 0x06;
  }
  mb4test::expect_image(bus, image, answer);
  ASSERT_TRUE(device.configure(config).ok());
}

class FullCheck : public testing::Test {
 protected:
  FullCheck() {
    mb4::Config config = mb4test::encoder26();
    config.spi_check = mb4::SpiCheck::kFull;
    configure(config);
  }
  void configure(const mb4::Config& config) {
    const bool crc = config.slaves[0].crc_polynomial != 0;
    Bytes image = mb4test::configuration();
    answer = mb4test::read_back();
    for (Bytes* bytes : {&image, &answer}) {
      (*bytes)[0xE7 - 0xC0] = 0x00;  // NOCRC = 0 (table 21)
      (*bytes)[1] = crc ? 0x06 : 0x00;
    }
    mb4test::expect_image(bus, image, answer);
    EXPECT_TRUE(device.configure(config).ok());
  }
  void start() {
    mb4test::expect_start_at_full(bus, kClearValid1, answer);
    ASSERT_TRUE(device.automatic().start().ok());
  }
  void start_two() {
    mb4test::expect_start_at_full(bus, kClearBoth, answer);
    ASSERT_TRUE(device.automatic().start().ok());
  }
  // The next single frame begins with this.
  void expect_recovery() {
    bus.expect_write(kBreakAndInterface);
    bus.expect_write(kClearValid1);
    bus.expect_read(mb4test::kReadWitness, mb4test::witness(status(0xFF, 0x00)));
  }
  void expect_good_frame() {
    bus.expect_write(kStartFrame);
    bus.expect_read(kReadStatus, kGoodFrame);
    bus.expect_read(kReadAll, kAllOf);
    bus.expect_read(kReadStatus, kGoodFrame);
    bus.expect_write(kClearValid1);
    bus.expect_read(kReadStatus, kIdleStatus);
  }

  Bytes answer;  // 0xC0..0xF5
  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device{bus, clock};
  mb4::Frame frame;
};

TEST_F(FullCheck, GoodFrame_TakesSixTransfers) {
  expect_good_frame();
  const std::size_t before = bus.transfers();
  const mb4::Result<mb4::Reading> reading = device.read_frame();
  ASSERT_TRUE(reading.ok());
  EXPECT_EQ(reading->position, mb4test::kPosition);
  EXPECT_EQ(bus.transfers() - before, 6U);
}

// 0xF4 still holds something although the frame has ended: it was disturbed on its way.
TEST_F(FullCheck, InstructionNotDone_IsCorrupted) {
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, status(0xFB, 0x02, 0x20));  // SWBANK
  EXPECT_EQ(device.read_frame().error(), Error::kCorrupted);
  expect_recovery();
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

// In the status after the data: SVALID is 0, or a frame runs that the driver has not requested.
TEST_F(FullCheck, StatusBehindTheData_HasToBeTheSame) {
  for (const Bytes& after : {kIdleStatus, status(0xFA, 0x02)}) {
    bus.expect_write(kStartFrame);
    bus.expect_read(kReadStatus, kGoodFrame);
    bus.expect_read(kReadAll, kAllOf);
    bus.expect_read(kReadStatus, after);
    EXPECT_EQ(device.read_frame().error(), Error::kCorrupted);
    expect_recovery();
  }
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

// MISO is stuck from there on.
TEST_F(FullCheck, NoStatusBehindTheData_IsNotDetected) {
  for (const bool cleared : {false, true}) {
    bus.expect_write(kStartFrame);
    bus.expect_read(kReadStatus, kGoodFrame);
    bus.expect_read(kReadAll, kAllOf);
    bus.expect_read(kReadStatus, cleared ? kGoodFrame : zeros(6));
    if (cleared) {
      bus.expect_write(kClearValid1);
      bus.expect_read(kReadStatus, Bytes(6, 0xFF));
    }
    EXPECT_EQ(device.read_frame().error(), Error::kNotDetected);
    expect_recovery();
  }
  expect_good_frame();
  EXPECT_TRUE(device.read_frame().ok());
}

// The chip may take a moment to clear the flag, but not longer.
TEST_F(FullCheck, FlagNotCleared_IsLookedAtTwice) {
  for (const bool cleared : {true, false}) {
    bus.expect_write(kStartFrame);
    bus.expect_read(kReadStatus, kGoodFrame);
    bus.expect_read(kReadAll, kAllOf);
    bus.expect_read(kReadStatus, kGoodFrame);
    bus.expect_write(kClearValid1);
    bus.expect_read(kReadStatus, kGoodFrame);
    bus.expect_read(kReadStatus, cleared ? kIdleStatus : kGoodFrame);
    if (!cleared) {  // the write may have reached the configuration
      for (const auto& one : mb4test::comparison(answer, kIdleStatus)) {
        bus.expect_read(one.mosi, one.miso);
      }
    }
    EXPECT_EQ(device.read_frame().error(), cleared ? Error::kNone : Error::kCorrupted);
  }
}

// One disturbed bit of a status, before the data or behind it: SVALID = 0. The word is not dropped;
// the next read brings it.
TEST_F(FullCheck, SvalidDisturbed_KeepsTheWord) {
  start();
  for (const bool behind : {true, false}) {
    bus.expect_write(kHold);
    bus.expect_read(kReadStatus, behind ? kNew : kCleared);
    if (behind) {
      bus.expect_read(kReadAll, kAllOf);
      bus.expect_read(kReadStatus, kCleared);
    }
    bus.expect_write(kAgs);
    EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNoData);
    bus.expect_write(kHold);
    bus.expect_read(kReadStatus, kNew);
    bus.expect_read(kReadAll, kAllOf);
    bus.expect_read(kReadStatus, kNew);
    bus.expect_write(kClearValid1);
    bus.expect_read(kReadStatus, kCleared);
    bus.expect_write(kAgs);
    EXPECT_TRUE(device.automatic().poll_slave(1).ok());
  }
}

// ... of one of two slaves: only the flag of the other one is cleared.
TEST_F(FullCheck, SvalidOfOneDisturbed_KeepsItsWord) {
  configure_two(bus, device, mb4::SpiCheck::kFull);
  start_two();
  for (const bool behind : {true, false}) {
    bus.expect_write(kHold);
    bus.expect_read(kReadStatus, status(0xFA, behind ? 0x0A : 0x02, 0x41));
    bus.expect_read(join({{0x09}, Bytes(16, mb4test::kFiller)}),
                    join({kAllOf, Bytes(kAllOf.begin() + 1, kAllOf.end())}));
    bus.expect_read(kReadStatus, status(0xFA, behind ? 0x02 : 0x0A, 0x41));
    bus.expect_write(kClearValid1);
    bus.expect_read(kReadStatus, status(0xFA, 0x08, 0x41));
    bus.expect_write(kAgs);
    ASSERT_TRUE(device.automatic().poll(frame).ok());
    EXPECT_TRUE(frame[1].ok());
    EXPECT_EQ(frame[2].error(), Error::kNoData);
  }
}

// The mark of a bad word goes to SCDATAx. One disturbed bit of the address, and RDATA would change:
// beside an access, and before its registers are taken, the word gets no mark and is told again.
TEST_F(FullCheck, BadWordBesideAnAccess_IsNotMarked) {
  const Bytes bad = status(0xEA, 0x00, 0x41);  // nSCDERR = 0
  const Bytes bad_word = join({mb4test::kData4, {0, 0, 0, mb4test::kCrc6 ^ 1}});
  const auto poll = [&](bool marks) {
    bus.expect_write(kHold);
    bus.expect_read(kReadStatus, bad);
    bus.expect_read(kReadAll, bad_word);
    bus.expect_read(kReadStatus, bad);
    if (marks) bus.expect_write({0x02, 0x07, mb4test::kCrc6 ^ 0xFE});
    bus.expect_write(kAgs);
    EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kCrc);
  };
  const Bytes done = status(0xFF, 0x00, 0x01);
  start();
  poll(true);
  bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
  bus.expect_write({0x07, 0x09});  // INSTR = 100
  bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x09));
  ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
  poll(false);
  EXPECT_FALSE(*mb4_c::PolledAccess(device).poll());  // the read has seen that it runs
  bus.expect_read(kReadStatus, done);
  bus.expect_read(kReadStatus, done);
  bus.expect_read({0x03, 0x80, mb4test::kFiller}, {0, 0, 0x77});
  bus.expect_read(mb4test::kReadWitness, mb4test::witness(done));
  mb4test::expect_rest_at_full(bus, mb4test::rest_back(answer));
  ASSERT_TRUE(*mb4_c::PolledAccess(device).poll());
  poll(false);
  for (const bool again : {false, true}) {
    for (const std::uint8_t filler : {mb4test::kFiller, std::uint8_t{0x00}}) {
      bus.expect_read({0x03, 0x80, filler}, {0, 0, 0x77});
      bus.expect_read(mb4test::kReadWitness, mb4test::witness(done));
    }
    std::array<std::uint8_t, 1> value{};
    ASSERT_TRUE(mb4_c::PolledAccess(device).take(value).ok()) << again;
    poll(true);
  }
}

// Data that is read twice and differs: all equal bits, which a stuck line makes.
TEST_F(FullCheck, SecondReadingDiffers_IsCorrupted) {
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kGoodFrame);
  bus.expect_read(kReadAll, zeros(9));
  bus.expect_read(kReadAll, kAllOf);
  bus.expect_read(kReadStatus, kGoodFrame);
  bus.expect_write(kClearValid1);
  bus.expect_read(kReadStatus, kIdleStatus);
  EXPECT_EQ(device.read_frame().error(), Error::kCorrupted);
}

TEST_F(FullCheck, SecondReadingDiffersInAPoll_IsCorrupted) {
  start();
  for (const bool one : {false, true}) {
    bus.expect_write(kHold);
    bus.expect_read(kReadStatus, kNew);
    bus.expect_read(kReadAll, zeros(9));
    bus.expect_read(kReadStatus, kNew);
    bus.expect_read(kReadAll, kAllOf);
    bus.expect_write(kClearValid1);
    bus.expect_read(kReadStatus, kCleared);
    bus.expect_write(kAgs);
    if (one) {
      EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kCorrupted);
    } else {
      ASSERT_TRUE(device.automatic().poll(frame).ok());
      EXPECT_EQ(frame[1].error(), Error::kCorrupted);
    }
  }
}

// Without HOLDBANK: a switch between the two readings of the first try is no fault of the second.
TEST_F(FullCheck, BankSwitchedBetweenTwoReadings_SecondTryIsGood) {
  mb4::Config config = mb4test::encoder26();
  config.spi_check = mb4::SpiCheck::kFull;
  config.hold_beside_access = false;
  configure(config);
  start();
  bus.expect_write({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
  bus.expect_read({0x03, 0xE2, 0, 0, 0, 0}, {0, 0, 0x44, 0x00, 0x01, 0xC0});
  bus.expect_write({0x07, 0x09});  // INSTR = 100
  bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x09));
  ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
  const Bytes fresh = status(0xFB, 0x02, 0x09);
  const Bytes still = status(0xFB, 0x00, 0x09);
  for (const bool one : {false, true}) {
    for (const bool second : {false, true}) {
      // The second try looks whether the write of SVALID has forced MA in 0xF5.
      bus.expect_read(second ? join({kReadStatus, {0}}) : kReadStatus,
                      second ? join({fresh, {0}}) : fresh);
      bus.expect_read(kReadStatus, fresh);
      bus.expect_write(kClearValid1);
      if (!second) {
        bus.expect_read(kReadAll, zeros(9));
      }
      if (second) {
        bus.expect_read(kReadAll, kAllOf);
      }
      bus.expect_read(kReadStatus, second ? still : fresh);
    }
    if (one) {
      EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNone);
    } else {
      ASSERT_TRUE(device.automatic().poll(frame).ok());
      EXPECT_EQ(frame[1].error(), Error::kNone);
    }
  }
}

// A write of SVALID = 0 that is not seen may have gone to 0xF5 and forced MA: the reads behind it
// look there, and are kCorrupted until no line is forced. The words that have waited are dropped.
TEST_F(FullCheck, ClearThatIsNotSeen_ReadsWaitForAnUnforcedLine) {
  mb4::Config config = mb4test::encoder26();
  config.spi_check = mb4::SpiCheck::kFull;
  configure(config);
  start();
  const Bytes fresh = status(0xFB, 0x02, 0x41);
  const Bytes free_bank{0x07, 0x01};
  bus.expect_write(kHold);
  bus.expect_read(kReadStatus, fresh);
  bus.expect_read(kReadAll, kAllOf);
  bus.expect_read(kReadStatus, fresh);
  bus.expect_write(kClearValid1);
  bus.expect_read(kReadStatus, fresh);
  bus.expect_read(kReadStatus, fresh);
  bus.expect_write(free_bank);
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kCorrupted);
  // 0xFF is what a bus leaves that stores too little.
  for (const unsigned forced : {0xFDU, 0x50U, 0xFFU}) {
    bus.expect_write(free_bank);
    bus.expect_read(join({kReadStatus, {0}}),
                    join({status(0xFB, 0x02, 0x01), {static_cast<std::uint8_t>(forced)}}));
    EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kCorrupted);
  }
  bus.expect_write(free_bank);
  bus.expect_read(join({kReadStatus, {0}}), join({status(0xFB, 0x02, 0x01), {0x01}}));
  bus.expect_write(kHold);
  bus.expect_read(kReadStatus, fresh);
  bus.expect_read(kReadAll, kAllOf);
  bus.expect_read(kReadStatus, fresh);
  bus.expect_write(kClearValid1);
  bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x41));
  bus.expect_write(free_bank);
  EXPECT_TRUE(device.automatic().poll_slave(1).ok());
  // Then as ever.
  bus.expect_write(kHold);
  bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x41));
  bus.expect_write(free_bank);
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNoData);
}

// Opcode 0x03 sends an address. One wrong bit of it reads the word of another slave, whose CRC
// fits: only a second reading, with its own address, tells.
TEST_F(FullCheck, WordByAddress_IsReadTwice) {
  configure_two(bus, device, mb4::SpiCheck::kFull);
  const Bytes& clear = kClearBoth;
  const Bytes by_address = join({{0x03, 0x08}, Bytes(8, mb4test::kFiller)});
  const Bytes word = join({{0}, kAllOf});
  const Bytes other = join({zeros(9), {mb4test::kCrc6}});
  // A single frame.
  for (const bool same : {true, false}) {
    bus.expect_write(kStartFrame);
    bus.expect_read(kReadStatus, status(0xFB, 0x0A));
    bus.expect_read(by_address, word);
    bus.expect_read(by_address, same ? word : other);
    bus.expect_read(kReadStatus, status(0xFB, 0x0A));
    bus.expect_write(clear);
    bus.expect_read(kReadStatus, kIdleStatus);
    EXPECT_EQ(device.read_frame(2).error(), same ? Error::kNone : Error::kCorrupted);
  }
  // Automatic frames.
  bus.expect_write(kBreakAndInterface);
  bus.expect_write(clear);
  bus.expect_read(mb4test::kReadWitness, mb4test::witness(status(0xFB, 0x00)));
  start_two();
  for (const bool same : {true, false}) {
    bus.expect_write(kHold);
    bus.expect_read(kReadStatus, status(0xFA, 0x0A, 0x41));
    bus.expect_read(by_address, word);
    bus.expect_read(kReadStatus, status(0xFA, 0x0A, 0x41));
    bus.expect_read(by_address, same ? word : other);
    bus.expect_write({0x02, 0xF1, 0xF7, 0xFF});
    bus.expect_read(kReadStatus, status(0xFA, 0x02, 0x41));
    bus.expect_write(kAgs);
    EXPECT_EQ(device.automatic().poll_slave(2).error(), same ? Error::kNone : Error::kCorrupted);
  }
  // All slaves share one frame, which begins at register 0 and sends no address.
  bus.expect_write(kHold);
  bus.expect_read(kReadStatus, status(0xFA, 0x0A, 0x41));
  bus.expect_read(join({{0x09}, Bytes(16, mb4test::kFiller)}),
                  join({kAllOf, Bytes(kAllOf.begin() + 1, kAllOf.end())}));
  bus.expect_read(kReadStatus, status(0xFA, 0x0A, 0x41));
  bus.expect_write(clear);
  bus.expect_read(kReadStatus, kCleared);
  bus.expect_write(kAgs);
  ASSERT_TRUE(device.automatic().poll(frame).ok());
  EXPECT_TRUE(frame[1].ok());
  EXPECT_TRUE(frame[2].ok());
}

// Of two statuses that tell of a new frame one is none.
TEST_F(FullCheck, NoStatusWithoutHoldbank_IsNotDetected) {
  mb4::Config config = mb4test::encoder26();
  config.spi_check = mb4::SpiCheck::kFull;
  config.hold_beside_access = false;
  configure(config);
  start();
  bus.expect_write({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
  bus.expect_read({0x03, 0xE2, 0, 0, 0, 0}, {0, 0, 0x44, 0x00, 0x01, 0xC0});
  bus.expect_write({0x07, 0x09});  // INSTR = 100
  bus.expect_read(kReadStatus, status(0xFB, 0x00, 0x09));
  ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
  const Bytes fresh = status(0xFB, 0x02, 0x09);
  for (const bool first : {false, true}) {
    bus.expect_read(kReadStatus, first ? zeros(6) : fresh);
    bus.expect_read(kReadStatus, first ? fresh : zeros(6));
    EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNotDetected);
  }
}

// Without HOLDBANK a bad word of slave 2 is not marked: another bank may be there by then.
TEST(CrcCheckUnheld, BadWordOfTheOtherSlave_IsNotWritten) {
  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device(bus, clock);
  configure_two(bus, device, mb4::SpiCheck::kCrc, false);
  bus.expect_write(kAgs);
  ASSERT_TRUE(device.automatic().start().ok());
  bus.expect_proven({0x02, 0xE2, 0x44, 0x00, 0x01, 0xC0});
  bus.expect_write({0x07, 0x09});
  ASSERT_TRUE(mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1).ok());
  const Bytes word = join({mb4test::kData4, {0, 0, 0, mb4test::kCrc6}});
  for (int i = 0; i < 2; ++i) {
    bus.expect_read(kReadStatus, status(0x6B, 0x02, 0x09));
    bus.expect_write({0x02, 0xF1, 0xFD, 0xFF});
    bus.expect_read(join({{0x09}, zeros(16)}), join({word, Bytes(8, 0x11)}));
    bus.expect_read(kReadStatus, status(0x6B, 0x00, 0x09));
  }
  mb4::Frame frame;
  EXPECT_EQ(device.automatic().poll(frame).error(), Error::kBankSwitched);
}

// HOLDBANK has not arrived, or something else has with it.
TEST_F(FullCheck, HoldbankNotInTheChip_IsCorruptedAndReleased) {
  start();
  // AGS may have ended by an error.
  bus.expect_write(kHold);
  bus.expect_read(kReadStatus, status(0xFA, 0x00, 0x40));
  bus.expect_write(kAgs);
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kNoData);
  for (const std::uint8_t held : Bytes{0x01, 0x51, 0x61}) {
    bus.expect_write(kHold);
    bus.expect_read(kReadStatus, status(0xFA, 0x02, held));
    bus.expect_write(kAgs);
    EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kCorrupted) << unsigned{held};
  }
  // SWBANK has swapped the banks meanwhile: the next read drops what waits.
  bus.expect_write(kAgs).fail_last();
  EXPECT_EQ(device.automatic().poll_slave(1).error(), Error::kTransport);
}

// After a failed read each of these begins with BREAK, and says so if that fails.
TEST_F(FullCheck, RecoveryFails_IsTransport) {
  const auto fails_first = [this](auto call) {
    bus.expect_write(kBreakAndInterface).fail_last();
    EXPECT_EQ(call().error(), Error::kTransport);
  };
  bus.expect_write(kStartFrame).fail_last();
  EXPECT_EQ(device.read_frame().error(), Error::kTransport);
  fails_first([this] { return device.read_frame(); });
  fails_first([this] { return device.read_all(frame); });
  fails_first([this] { return device.initialize(); });
  fails_first([this] { return device.automatic().start(); });
  fails_first([this] { return mb4_c::PolledAccess(device).begin_read({1, 0}, 0x44, 1); });
}

}  // namespace full_check_test
}  // namespace
