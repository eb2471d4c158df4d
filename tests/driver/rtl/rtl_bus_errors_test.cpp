// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Errors of the public calls on the Verilated chip that a disturbed bus causes, or a call at an
// unusual moment.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>

#include "drivers/c/mb4_c_access.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/driver/rtl/fault_bus.hpp"
#include "tests/driver/rtl/rtl_calls.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using namespace mb4test;  // NOLINT: the states and names of rtl_calls.hpp

TEST(DriverCallErrors, AutomaticFramesOnOneBank_AreUnsupported) {
  FaultyChip chip(kEncoder);
  Config config = encoder(false);
  config.single_bank = true;
  ASSERT_TRUE(chip.device.configure(config).ok());
  EXPECT_EQ(chip.device.automatic().start().error(), Error::kUnsupported);
}

TEST(DriverCallErrors, ControlOnPeriodicFrames_IsUnsupported) {
  FaultyChip chip(kEncoder);
  ASSERT_TRUE(chip.device.configure(encoder(true)).ok());
  chip.bus.plan({});
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0, 1).error(), Error::kUnsupported);
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_write({1, 0}, 0, kBytes).error(),
            Error::kUnsupported);
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_command(activate()).error(),
            Error::kUnsupported);
  EXPECT_EQ(chip.device.control().read_registers({1, 0}, 0, buffer).error(), Error::kUnsupported);
  EXPECT_EQ(chip.device.control().write_registers({1, 0}, 0, kBytes).error(), Error::kUnsupported);
  EXPECT_EQ(chip.device.control().send(activate()).error(), Error::kUnsupported);
  EXPECT_EQ(chip.bus.count(), 0U);
}

// The request is lost: the chip is idle, has no error and no new data.
TEST(DriverCallErrors, MissedFrames_AreNoData) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kConfigured);
  chip.bus.plan({FaultKind::kLost, 0, 0, 0});
  EXPECT_EQ(chip.device.read_frame().error(), Error::kNoData);
  chip.bus.plan({FaultKind::kLost, 3, 3, 0});  // behind BREAK, SVALID and the status
  Frame frame;
  ASSERT_TRUE(chip.device.read_all(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kNoData);
}

// Bit 12 of the transfer is in the first byte of data. It is the transfer after the last status.
TEST(DriverCallErrors, FlippedDataBit_IsCorrupted) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kConfigured);
  Frame frame;
  chip.bus.plan({});
  ASSERT_TRUE(chip.device.read_frame().ok());
  const std::size_t data = chip.bus.count() - 4;  // data, status, SVALID, status
  chip.bus.plan({FaultKind::kFlipMiso, data, data, 12});
  EXPECT_EQ(chip.device.read_frame().error(), Error::kCorrupted);
  ASSERT_TRUE(chip.device.read_frame().ok());
  chip.bus.plan({FaultKind::kFlipMiso, data, data, 12});
  ASSERT_TRUE(chip.device.read_all(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kCorrupted);

  FaultyChip other(kEncoder);
  prepare(other, State::kAutomatic);
  other.bus.plan({FaultKind::kFlipMiso, 2, 2, 12});  // behind HOLDBANK and status
  ASSERT_TRUE(other.device.automatic().poll(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kCorrupted);
  other.simulator.advance(120 * mb4::sim::kPsPerUs);
  other.bus.plan({FaultKind::kFlipMiso, 2, 2, 12});
  EXPECT_EQ(other.device.automatic().poll_slave(1).error(), Error::kCorrupted);
}

// A poll takes longer than the frames are apart: another one always ends in between.
TEST(DriverCallErrors, FrameEndsBesideControl_IsBankSwitched) {
  FaultyChip chip("[host]\nsclk_hz = 1000000\ncycle_ns = 15000\n" + kEncoder);
  Config config = encoder(true);
  config.hold_beside_access = false;
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  chip.simulator.advance(250 * mb4::sim::kPsPerUs);
  ASSERT_TRUE(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x44, 4).ok());
  Frame frame;
  EXPECT_EQ(chip.device.automatic().poll_slave(1).error(), Error::kBankSwitched);
  chip.simulator.advance(120 * mb4::sim::kPsPerUs);
  EXPECT_EQ(chip.device.automatic().poll(frame).error(), Error::kBankSwitched);
  EXPECT_EQ(chip.device.automatic().next(frame).error(), Error::kBankSwitched);
}

TEST(DriverCallErrors, NoSlave_NextIsTimeout) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kAutomatic);
  clocked(chip.simulator.line(1))->faults().stick(true);
  chip.simulator.refresh_lines();
  Frame frame;
  mb4::Result<void> done = chip.device.automatic().next(frame);
  for (int i = 0; i < 3 && done; ++i) done = chip.device.automatic().next(frame);
  EXPECT_EQ(done.error(), Error::kTimeout);
}

// AGS = 1 is the first transfer of a start and the fourth of a restart; its status comes last.
TEST(DriverCallErrors, StartDisturbed_IsToldFromFullOn) {
  for (const int number : {0, 1, 2, 3}) {
    const bool again = number % 2 != 0;
    for (const Error error : {Error::kCorrupted, Error::kNotDetected}) {
      FaultyChip chip(kEncoder);
      Config config = encoder(true);
      config.spi_check = number < 2 ? mb4::SpiCheck::kFull : mb4::SpiCheck::kFullAndRelease;
      ASSERT_TRUE(chip.device.configure(config).ok());
      const std::size_t ags = again ? 3 : 0;
      const std::size_t status = again ? 7 : 4;
      chip.bus.plan(error == Error::kCorrupted ? Fault{FaultKind::kFlipMosi, ags, ags, 10}
                                               : Fault{FaultKind::kMisoLow, status, status, 0});
      const auto start = [&] {
        return again ? chip.device.automatic().restart() : chip.device.automatic().start();
      };
      EXPECT_EQ(start().error(), error);
      EXPECT_EQ(chip.bus.count(), status + 1);
      EXPECT_FALSE(chip.device.automatic().running());
      chip.bus.plan({});
      EXPECT_TRUE(start().ok());
      chip.simulator.advance(150 * mb4::sim::kPsPerUs);
      EXPECT_TRUE(chip.device.automatic().poll_slave(1).ok());
    }
  }
}

// What an interrupt may rely on, whatever is checked and whether or not the data has a CRC.
TEST(DriverCall, PollSlave_KeepsToItsTransfers) {
  for (const mb4::SpiCheck check : {mb4::SpiCheck::kOff, mb4::SpiCheck::kCrc, mb4::SpiCheck::kFull,
                                    mb4::SpiCheck::kFullAndRelease}) {
    const bool full = check >= mb4::SpiCheck::kFull;
    const unsigned proof = check == mb4::SpiCheck::kFullAndRelease ? 1 : 0;
    FaultyChip chip(
        "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
        "data_bits = 28\ndata = 0\n");
    Config config = encoder(true);
    config.slaves[0].flags = mb4::Flags::kNone;
    config.spi_check = check;
    config.slaves[0].flags = mb4::Flags::kNone;  // nE of this word is 0
    ASSERT_TRUE(chip.device.configure(config).ok());
    ASSERT_TRUE(chip.device.automatic().start().ok());
    chip.simulator.advance(150 * mb4::sim::kPsPerUs);
    chip.bus.plan({});
    ASSERT_TRUE(chip.device.automatic().poll_slave(1).ok());
    // All zeros are read twice with kFull.
    EXPECT_EQ(chip.bus.count(), full ? 8U + proof : 4U);
    EXPECT_LE(chip.bus.count(),
              full ? mb4::kMaxPollSlaveTransfersChecked + proof : mb4::kMaxPollSlaveTransfers);
    Error again = Error::kNone;  // the first read may have been so long that a frame has ended
    for (unsigned i = 0; i < 3 && again == Error::kNone; ++i) {
      chip.bus.plan({});
      again = chip.device.automatic().poll_slave(1).error();
    }
    EXPECT_EQ(again, Error::kNoData);
    EXPECT_EQ(chip.bus.count(), full ? 3U + proof : 4U);
    // The release is refused, so the next read begins with it and drops what waits: it is longest
    // where a frame ends meanwhile.
    const std::size_t release = full ? 2U : 3U;
    chip.bus.plan({mb4test::FaultKind::kRefused, release, mb4test::kForEver});
    EXPECT_EQ(chip.device.automatic().poll_slave(1).error(), Error::kTransport);
    unsigned most = 0;
    for (unsigned phase = 0; phase < 100; ++phase) {
      chip.simulator.advance((70 + phase) * mb4::sim::kPsPerUs);
      chip.bus.plan({});
      static_cast<void>(chip.device.automatic().poll_slave(1));
      most = std::max<unsigned>(most, static_cast<unsigned>(chip.bus.count()));
      chip.bus.plan({mb4test::FaultKind::kRefused, release, mb4test::kForEver});
      static_cast<void>(chip.device.automatic().poll_slave(1));
    }
    EXPECT_GT(most, full ? 7U : 4U);
    EXPECT_LE(most,
              full ? mb4::kMaxPollSlaveTransfersChecked + proof : mb4::kMaxPollSlaveTransfers);
  }
}

// The instruction of the second access is lost: REGEND = 1 is that of the first one.
TEST(DriverCallErrors, LostInstructionBesideFrames_IsCorrupted) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kAutomatic);
  ASSERT_TRUE(chip.device.control().read_registers({1, 0}, 0x44, buffer).ok());
  chip.bus.plan({FaultKind::kLost, 3, 3, 0});  // request, reading, witness, instruction
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x46, 1).error(),
            Error::kCorrupted);
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).poll().error(), Error::kWrongMode);
  // A status that is disturbed once does not hide the access.
  chip.bus.plan({FaultKind::kFlipMiso, 3, 3, 13});  // REGEND: bit 2 of the second byte
  EXPECT_TRUE(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x46, 1).ok());
  EXPECT_EQ(chip.bus.count(), 5U);
  EXPECT_TRUE(chip.device.control().abort().ok());
  // MISO stuck from the instruction on.
  ASSERT_TRUE(chip.device.automatic().restart().ok());
  chip.bus.plan({FaultKind::kMisoLow, 3, 4, 0});
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x46, 1).error(),
            Error::kNotDetected);
  EXPECT_TRUE(chip.device.control().abort().ok());
}

TEST(DriverCallErrors, FlippedRegisterBit_IsCorrupted) {
  for (const std::size_t transfer : {0U, 2U}) {  // a status is between the two readings
    FaultyChip chip(kEncoder);
    prepare(chip, State::kReadEnded);
    chip.bus.plan({FaultKind::kFlipMiso, transfer, transfer, 20});
    EXPECT_EQ(mb4_c::PolledAccess(chip.device).take(buffer).error(), Error::kCorrupted);
    // The disturbed bit may have made a write of the reading.
    EXPECT_EQ(mb4_c::PolledAccess(chip.device).take(buffer).error(), Error::kInvalidArgument);
  }
}

// MOSI: what is written to start an access is read back, so that no other register of the slave can
// be hit. Every bit of address, count, channel and control byte.
TEST(DriverCallErrors, FlippedBitOfARequest_WritesNothingElsewhere) {
  unsigned corrupted = 0;
  for (const std::size_t transfer : {0U, 4U}) {  // each is followed by what reads it back
    for (std::size_t bit = 16; bit < 48; ++bit) {
      FaultyChip chip(kEncoder);
      prepare(chip, State::kConfigured);
      chip.bus.plan({FaultKind::kFlipMosi, transfer, transfer, bit});
      const mb4::Result<void> written = chip.device.control().write_registers({1, 0}, 0x60, kBytes);
      // Reserved bits of the chip stay 0 and change nothing.
      EXPECT_TRUE(written || written.error() == Error::kCorrupted);
      corrupted += written ? 0 : 1;
      chip.bus.plan({});
      EXPECT_TRUE(chip.device.control().read_registers({1, 0}, 0x60, buffer).ok());
      EXPECT_EQ(buffer, written ? kBytes : (std::array<std::uint8_t, 4>{}))
          << "transfer " << transfer << " bit " << bit;
    }
  }
  // 32 of data; WNR and address, count, channel and control byte without reserved bits.
  EXPECT_GE(corrupted, 32U + 8U + 6U + 2U + 7U);
}

// From the first status of the access on.
TEST(DriverCallErrors, MisoStuckInAnAccess_IsNotDetected) {
  for (const FaultKind kind : {FaultKind::kMisoLow, FaultKind::kMisoHigh}) {
    FaultyChip chip(kEncoder);
    prepare(chip, State::kConfigured);
    chip.bus.plan({kind, 6, kForEver, 0});
    EXPECT_EQ(chip.device.control().read_registers({1, 0}, 0x44, buffer).error(),
              Error::kNotDetected);
    prepare(chip, State::kFresh);
    chip.bus.plan({});
    ASSERT_TRUE(chip.device.configure(encoder(false)).ok());
    chip.bus.plan({kind, 6, kForEver, 0});
    EXPECT_EQ(chip.device.control().write_registers({1, 0}, 0x60, kBytes).error(),
              Error::kNotDetected);
    chip.bus.plan({});
    ASSERT_TRUE(chip.device.configure(encoder(false)).ok());
    chip.bus.plan({kind, 6, kForEver, 0});
    EXPECT_EQ(chip.device.control().send(activate()).error(), Error::kNotDetected);
  }
}

TEST(DriverCallErrors, ScanOnABrokenBus_IsTransport) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kConfigured);
  chip.bus.plan({});
  ASSERT_TRUE(mb4::scan_bus(chip.device, 1, {}).ok());
  const std::size_t transfers = chip.bus.count();
  ASSERT_GT(transfers, 100U);
  // From anywhere on: in the identity of a slave, in its EDS, in the search for the next one.
  for (std::size_t part = 0; part < 16; ++part) {
    const std::size_t transfer = transfers * part / 16;
    chip.bus.plan({FaultKind::kRefused, transfer, kForEver, 0});
    EXPECT_EQ(mb4::scan_bus(chip.device, 1, {}).error(), Error::kTransport) << transfer;
  }
}

}  // namespace
