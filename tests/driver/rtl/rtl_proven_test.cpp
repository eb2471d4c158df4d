// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// SpiCheck::kFull, and an encoder that is gone: no transfer that is lost or disturbed, in the call
// before or in the read itself, turns a word from before into a position. Each call leaves SVALID
// of frames that it has made, or that have run, and the frame of the read is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/c/mb4_c_access.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/driver/rtl/c99_read.hpp"
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

// A frame each 100 us.
Config config() {
  Config config = mb4test::config26(10'000'000);
  config.spi_check = mb4::SpiCheck::kFull;
  config.frame_start = FrameStart::kPeriodic;
  config.frame_period_clk = 20 * 100;
  return config;
}

enum class Before : std::uint8_t { kStop, kActivate, kConfigure, kFailedRead };

std::string name_of(const testing::TestParamInfo<Before>& test) {
  constexpr std::array<const char*, 4> kNames{"Stop", "Activate", "Configure", "FailedRead"};
  return kNames[static_cast<unsigned>(test.param)];
}

class DriverProven : public testing::TestWithParam<Before> {
 protected:
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

// Bytes for registers of the encoder, on their way to RDATA (0x80), reach SCDATA1 (0x00) by one bit
// of the address, while a word waits there. Zeros are a word whose CRC fits, and RDATA is 0
// already, so that it reads back right.
TEST(DriverProvenWrite, ZerosThatReachAWord_AreNoPosition) {
  FaultyChip chip(
      "[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = "
      "\"biss-c\"\ncontrol = true\ndata_bits = 28\nflag_bits = 0\nsource = \"ramp\"\nstart = "
      "0x12345\nstep = 4\n");
  Config without_flags = config();
  without_flags.slaves[0].flags = mb4::Flags::kNone;
  ASSERT_TRUE(chip.device.configure(without_flags).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  chip.simulator.advance(150 * sim::kPsPerUs);
  ASSERT_TRUE(chip.device.automatic().poll_slave(1).ok());
  chip.simulator.advance(150 * sim::kPsPerUs);  // a word waits
  const std::array<std::uint8_t, 8> zeros{};
  mb4::Operation op;
  ASSERT_TRUE(
      chip.device.control()
          .plan_write(op, {1, 0}, 0x60, mb4::Span<const std::uint8_t>(zeros.data(), zeros.size()))
          .ok());
  chip.bus.plan({FaultKind::kFlipMosi, 0, 0, 8});
  bool over = chip.device.finish(op, op.run(chip.bus), chip.clock.now_us());
  ASSERT_FALSE(over);
  for (int i = 0; i < 4; ++i) {
    const mb4::Result<mb4::Reading> reading = chip.device.automatic().poll_slave(1);
    EXPECT_TRUE(!reading.ok() || reading->position != 0) << i;
    EXPECT_EQ(reading.ok(), i != 0) << i << " " << mb4::to_string(reading.error());
    chip.simulator.advance(150 * sim::kPsPerUs);
  }
  while (!over) over = chip.device.finish(op, op.run(chip.bus), chip.clock.now_us());
}

// The instruction that ends all is lost, or comes as another one, or its proof does: it is sent
// again. Without SpiCheck::kFull it is not.
TEST(DriverProvenStop, OneFault_ChipStopsNevertheless) {
  for (const unsigned kind : {0U, 1U, 2U}) {
    const auto begin = [kind](FaultyChip& chip) {
      ASSERT_TRUE(chip.device.configure(config()).ok());
      ASSERT_TRUE(chip.device.automatic().start().ok());
      if (kind == 2) {
        ASSERT_TRUE(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x60, 1).ok());
      }
      chip.simulator.advance(150 * sim::kPsPerUs);
    };
    const auto call = [kind](FaultyChip& chip) {
      return kind == 0   ? chip.device.automatic().stop()
             : kind == 1 ? chip.device.break_transmission()
                         : chip.device.control().abort();
    };
    std::vector<Fault> faults;
    {
      FaultyChip chip(kEncoder);
      begin(chip);
      chip.bus.plan({});
      ASSERT_TRUE(call(chip).ok());
      faults = mb4test::all_faults(chip.bus.bits(), 1);
    }
    ASSERT_GE(faults.size(), 40U);
    for (const Fault& fault : faults) {
      if (fault.last == mb4test::kForEver) continue;
      FaultyChip chip(kEncoder);
      begin(chip);
      chip.bus.plan(fault);
      const mb4::Result<void> done = call(chip);
      const bool told = fault.kind == FaultKind::kRefused || fault.kind == FaultKind::kFailedAfter;
      // The request at rest may reach the configuration.
      const bool verify = kind == 2 && done.error() == Error::kVerify;
      EXPECT_TRUE(done.ok() || told || verify || done.error() == Error::kCorrupted)
          << kind << " " << fault.text() << " " << mb4::to_string(done.error());
      chip.bus.plan({});
      if (done.ok()) {
        // A frame that the disturbed byte has begun ends by itself.
        chip.simulator.advance(150 * sim::kPsPerUs);
        const mb4::Result<mb4::Status> status = chip.device.read_status();
        ASSERT_TRUE(status.ok());
        EXPECT_EQ(status->instruction(), 0U) << kind << " " << fault.text();
      }
    }
  }
}

// A start writes the request at rest where it is already, and clears SVALID twice. One bit of an
// address makes them reach the rate of the frames (0xE2 and 0xE6), or the request (0xF1 and 0xE1),
// and what they have missed looks as it should.
TEST(DriverProvenStart, OneFlippedBit_NoOtherRegisterIsWrittenUnseen) {
  // An access was planned, and given up before its first frame.
  const auto begin = [](FaultyChip& chip, bool restarts) {
    ASSERT_TRUE(chip.device.configure(config()).ok());
    if (!restarts) return;
    ASSERT_TRUE(chip.device.automatic().start().ok());
    chip.simulator.advance(150 * sim::kPsPerUs);
    mb4::Operation op;
    std::array<std::uint8_t, 1> byte{};
    ASSERT_TRUE(chip.device.control().plan_read(op, {1, 0}, 0x44, byte).ok());
    while (!chip.device.finish(op, false, chip.clock.now_us())) {
    }
  };
  const auto call = [](FaultyChip& chip, bool restarts) {
    return restarts ? chip.device.automatic().restart() : chip.device.automatic().start();
  };
  for (const bool restarts : {false, true}) {
    std::vector<Fault> faults;
    {
      FaultyChip chip(kEncoder);
      begin(chip, restarts);
      chip.bus.plan({});
      ASSERT_TRUE(call(chip, restarts).ok());
      faults = mb4test::all_faults(chip.bus.bits(), 1);
    }
    ASSERT_GE(faults.size(), 100U);
    unsigned told = 0;
    for (const Fault& fault : faults) {
      if (fault.last == mb4test::kForEver || fault.kind != FaultKind::kFlipMosi) continue;
      FaultyChip chip(kEncoder);
      begin(chip, restarts);
      chip.bus.plan(fault);
      const mb4::Result<void> done = call(chip, restarts);
      chip.bus.plan({});
      told += done.ok() ? 0 : 1;
      const mb4::Result<void> same = chip.device.verify();
      // The word of another slave comes with a wrong CRC then.
      const bool of_a_slave = same.error() == Error::kVerify && same.info().detail < 0xE0;
      EXPECT_TRUE(!done.ok() || same.ok() || of_a_slave)
          << restarts << " " << fault.text() << " " << mb4::to_string(same.error()) << " at 0x"
          << std::hex << unsigned{same.info().detail};
    }
    EXPECT_GT(told, 0U);
  }
}

// Bytes for RDATA reach the request by one bit of their address: 0xA0 and 0xE0. Whatever the call
// says, the request at rest stands behind it.
TEST(DriverProvenRest, FlippedAddressOfALongWrite_RequestAtRestStands) {
  for (const mb4::SpiCheck check :
       {mb4::SpiCheck::kOff, mb4::SpiCheck::kCrc, mb4::SpiCheck::kFull}) {
    Config of_check = config();
    of_check.spi_check = check;
    std::array<std::uint8_t, 40> bytes{};
    bytes.fill(0x3C);
    unsigned told = 0;
    for (std::size_t transfer = 0; transfer < 5; ++transfer) {
      for (std::size_t bit = 8; bit < 16; ++bit) {
        FaultyChip chip(kEncoder);
        ASSERT_TRUE(chip.device.configure(of_check).ok());
        ASSERT_TRUE(chip.device.automatic().start().ok());
        chip.bus.plan({FaultKind::kFlipMosi, transfer, transfer, bit});
        const mb4::Result<void> done = chip.device.control().write_registers({1, 0}, 0x10, bytes);
        chip.bus.plan({});
        told += done.ok() ? 0 : 1;
        const std::array<std::uint8_t, 6> tx{0x03, 0xE2};
        std::array<std::uint8_t, 6> rx{};
        ASSERT_TRUE(chip.bus.transfer({tx.data(), tx.size()}, {rx.data(), rx.size()}));
        const std::array<std::uint8_t, 6> rest{0, 0, 0x00, 0x00, 0x00, 0xC0};
        EXPECT_EQ(rx, rest) << static_cast<unsigned>(check) << ", transfer " << transfer << ", bit "
                            << bit << ": " << mb4::to_string(done.error());
      }
    }
    EXPECT_GE(told, 20U);
  }
}

// One bit more in the release of a read, 0x09 for 0x01, begins the access at rest, and no later
// transfer of the read shows it. Its end is not that of the access behind it.
TEST(DriverProvenAccess, ReleaseThatBeginsAnother_EndIsNotTakenForItsOwn) {
  FaultyChip chip(kEncoder);
  ASSERT_TRUE(chip.device.configure(config()).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  std::array<std::uint8_t, 2> bytes{};
  ASSERT_TRUE(chip.device.control().read_registers({1, 0}, 0x60, bytes).ok());
  // They are 0: the word that waits is dropped.
  ASSERT_EQ(chip.device.automatic().poll_slave(1).error(), Error::kNoData);
  chip.simulator.advance(150 * sim::kPsPerUs);
  chip.bus.plan({FaultKind::kFlipMosi, 6, 6, 12});
  ASSERT_TRUE(chip.device.automatic().poll_slave(1).ok());
  ASSERT_EQ(chip.bus.count(), 7U);
  chip.bus.plan({});
  chip.simulator.advance(500 * sim::kPsPerUs);  // its first frames
  bytes = {0x5C, 0xA3};
  const mb4::Result<void> written = chip.device.control().write_registers({1, 0}, 0x60, bytes);
  const sim::Slave& slave = *chip.simulator.slave(1);
  EXPECT_TRUE(!written.ok() || slave.reg_read(0x60) == 0x5C);
  EXPECT_EQ(written.error(), Error::kCorrupted);
  ASSERT_TRUE(chip.device.automatic().restart().ok());
  EXPECT_TRUE(chip.device.control().write_registers({1, 0}, 0x60, bytes).ok());
  EXPECT_EQ(slave.reg_read(0x61), 0xA3);
}

// SVALID = 0 goes to 0xF1. By one bit of its address it reaches 0xF5 and forces MA while a frame
// runs: its word is none of the encoder, and without a CRC nothing in it tells.
TEST(DriverProvenClear, FlippedAddressForcesMa_NoWordOfThatFrameIsGood) {
  Config of_check = config();
  of_check.slaves[0].crc_polynomial = 0;
  unsigned told = 0;
  for (unsigned phase = 0; phase < 160; ++phase) {
    FaultyChip chip(kEncoder + "crc = 0\n");
    ASSERT_TRUE(chip.device.configure(of_check).ok());
    ASSERT_TRUE(chip.device.automatic().start().ok());
    chip.simulator.advance(250 * sim::kPsPerUs);
    chip.bus.plan({});
    ASSERT_TRUE(chip.device.automatic().poll_slave(1).ok());
    const std::vector<std::uint8_t>& opcodes = chip.bus.opcodes();
    const std::size_t clear = static_cast<std::size_t>(
        std::find(opcodes.begin(), opcodes.end(), std::uint8_t{0x02}) - opcodes.begin());
    ASSERT_LT(clear, opcodes.size());
    // The write meets each place of a frame, and the time around it.
    chip.simulator.advance(70 * sim::kPsPerUs + phase * 250 * sim::kPsPerNs);
    chip.bus.plan({FaultKind::kFlipMosi, clear, clear, 13});
    const Error first = chip.device.automatic().poll_slave(1).error();
    chip.bus.plan({});
    if (first != Error::kCorrupted) continue;  // no frame was new, and nothing was cleared
    ++told;
    for (unsigned i = 0; i < 30; ++i) {
      const auto reading = chip.device.automatic().poll_slave(1);
      if (reading.ok()) {
        const std::uint64_t position = reading.value().position;
        EXPECT_TRUE(position < 60 && position % 4 == 0)
            << position << " in phase " << phase << ", poll " << i;
      }
      chip.simulator.advance(5 * sim::kPsPerUs);
    }
    EXPECT_FALSE(chip.device.automatic().poll_slave(1).ok());
    ASSERT_TRUE(chip.device.automatic().restart().ok());
    chip.simulator.advance(250 * sim::kPsPerUs);
    EXPECT_TRUE(chip.device.automatic().poll_slave(1).ok()) << "phase " << phase;
  }
  EXPECT_GE(told, 30U);
}

// A program in C starts the frames itself, and sets `held`: words may wait from before. Each fault
// of its first read, and the encoder has gone meanwhile.
TEST(DriverProvenCyclic, HeldAtTheStart_NoFaultBringsAWordFromBefore) {
  for (const unsigned way : {0U, 1U, 2U, 3U}) {
    const mb4::SpiCheck check =
        way % 2 == 0 ? mb4::SpiCheck::kFull : mb4::SpiCheck::kFullAndRelease;
    const bool holds = way >= 2;
    Config of_check = config();
    of_check.spi_check = check;
    const auto prepare = [&of_check, holds](FaultyChip& chip, mb4test::C99Read& c) {
      ASSERT_TRUE(chip.device.configure(of_check).ok());
      ASSERT_TRUE(chip.device.automatic().start().ok());
      chip.simulator.advance(350 * sim::kPsPerUs);  // frames of both banks
      if (holds) {  // a program that was given up has left the bank held, and frames wait behind it
        const std::array<std::uint8_t, 2> hold{0x07, 0x41};
        std::array<std::uint8_t, 2> none{};
        ASSERT_TRUE(chip.bus.transfer({hold.data(), 2}, {none.data(), 0}));
        chip.simulator.advance(250 * sim::kPsPerUs);
      }
      clocked(chip.simulator.line(1))->faults().stick(false);
      chip.simulator.refresh_lines();
      chip.simulator.advance(150 * sim::kPsPerUs);
      c.set_up(of_check);
      c.started(chip.clock.now_us());
      chip.bus.plan({});
    };
    std::vector<Fault> faults;
    {
      FaultyChip chip(kEncoder);
      mb4test::C99Read c;
      prepare(chip, c);
      EXPECT_NE(c.run(chip.bus, chip.clock), MB4_OK);
      faults = mb4test::all_faults(chip.bus.bits(), 1);
    }
    ASSERT_GE(faults.size(), 100U);
    for (const Fault& fault : faults) {
      if (fault.last == mb4test::kForEver) continue;
      const bool swaps = fault.kind == FaultKind::kFlipMosi && fault.first == 0 && fault.bit == 10;
      if (swaps && check == mb4::SpiCheck::kFull) continue;
      FaultyChip chip(kEncoder);
      mb4test::C99Read c;
      prepare(chip, c);
      chip.bus.plan(fault);
      EXPECT_NE(c.run(chip.bus, chip.clock), MB4_OK) << fault.text();
      chip.bus.plan({});
      EXPECT_NE(c.run(chip.bus, chip.clock), MB4_OK) << "second, " << fault.text();
    }
  }
}

// The same start beside running frames of an encoder without a CRC: SVALID = 0 forces MA by one bit
// of its address.
TEST(DriverProvenCyclic, ClearAtTheStartForcesMa_NoWordOfThatFrameIsGood) {
  Config without_crc = config();
  without_crc.slaves[0].crc_polynomial = 0;
  unsigned told = 0;
  for (unsigned phase = 0; phase < 160; ++phase) {
    for (const bool unheld : {false, true}) {
      FaultyChip chip(kEncoder + "crc = 0\n");
      ASSERT_TRUE(chip.device.configure(without_crc).ok());
      ASSERT_TRUE(chip.device.automatic().start().ok());
      chip.simulator.advance(250 * sim::kPsPerUs);
      mb4test::C99Read c;
      c.set_up(without_crc);
      c.started(chip.clock.now_us());
      c.read.unheld = unheld;
      chip.simulator.advance(70 * sim::kPsPerUs + phase * 250 * sim::kPsPerNs);
      const std::size_t clear = unheld ? 0 : 1;
      chip.bus.plan({FaultKind::kFlipMosi, clear, clear, 13});
      told += c.run(chip.bus, chip.clock) == MB4_CORRUPTED ? 1 : 0;
      ASSERT_EQ(chip.bus.opcodes()[clear], 0x02);
      chip.bus.plan({});
      for (unsigned i = 0; i < 30; ++i) {
        if (c.run(chip.bus, chip.clock) == MB4_OK) {
          mb4_reading reading;
          mb4_slot_reading(c.words.data(), c.slots.data(), &reading, mb4test::kCounting);
          EXPECT_TRUE(reading.position < 60 && reading.position % 4 == 0)
              << reading.position << " in phase " << phase << ", poll " << i << unheld;
        }
        chip.simulator.advance(5 * sim::kPsPerUs);
      }
      // Frames are started anew, with the same read.
      ASSERT_TRUE(chip.device.automatic().restart().ok());
      chip.simulator.advance(250 * sim::kPsPerUs);
      c.watch.held = true;
      c.started(chip.clock.now_us());
      static_cast<void>(c.run(chip.bus, chip.clock));
      chip.simulator.advance(150 * sim::kPsPerUs);
      EXPECT_EQ(c.run(chip.bus, chip.clock), MB4_OK) << "phase " << phase << unheld;
    }
  }
  EXPECT_GE(told, 300U);
}

}  // namespace
