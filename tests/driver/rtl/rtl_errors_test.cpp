// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Errors of the public calls on the Verilated chip that the bus does not cause: wrong use, wrong
// configuration, INIT, and faults of the line.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "drivers/c/mb4_c_access.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/driver/rtl/fault_bus.hpp"
#include "tests/driver/rtl/rtl_calls.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using namespace mb4test;  // NOLINT: the states and names of rtl_calls.hpp

// ---- Errors of single calls ---------------------------------------------------------------------

TEST(DriverCallErrors, NotConfigured_TouchesNothing) {
  FaultyChip chip(kEncoder);
  chip.bus.plan({});
  Frame frame;
  EXPECT_EQ(chip.device.verify().error(), Error::kNotConfigured);
  EXPECT_EQ(chip.device.initialize().error(), Error::kNotConfigured);
  EXPECT_EQ(chip.device.read_frame().error(), Error::kNotConfigured);
  EXPECT_EQ(chip.device.read_all(frame).error(), Error::kNotConfigured);
  EXPECT_EQ(chip.device.automatic().start().error(), Error::kNotConfigured);
  EXPECT_EQ(chip.device.automatic().restart().error(), Error::kNotConfigured);
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0, 1).error(),
            Error::kNotConfigured);
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_write({1, 0}, 0, kBytes).error(),
            Error::kNotConfigured);
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_command({}).error(), Error::kNotConfigured);
  EXPECT_EQ(chip.device.control().read_registers({1, 0}, 0, buffer).error(), Error::kNotConfigured);
  EXPECT_EQ(chip.device.control().write_registers({1, 0}, 0, kBytes).error(),
            Error::kNotConfigured);
  EXPECT_EQ(chip.device.control().send({}).error(), Error::kNotConfigured);
  EXPECT_EQ(mb4::scan_bus(chip.device, 1, {}).error(), Error::kNotConfigured);
  EXPECT_EQ(chip.bus.count(), 0U);
}

TEST(DriverCallErrors, WrongMode_TouchesNothing) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kConfigured);
  chip.bus.plan({});
  Frame frame;
  EXPECT_EQ(chip.device.automatic().poll(frame).error(), Error::kWrongMode);
  EXPECT_EQ(chip.device.automatic().poll_slave(1).error(), Error::kWrongMode);
  EXPECT_EQ(chip.device.automatic().next(frame).error(), Error::kWrongMode);
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).poll().error(), Error::kWrongMode);
  EXPECT_EQ(chip.bus.count(), 0U);
  ASSERT_TRUE(chip.device.automatic().start().ok());
  chip.bus.plan({});
  EXPECT_EQ(chip.device.automatic().start().error(), Error::kWrongMode);
  EXPECT_EQ(chip.device.initialize().error(), Error::kWrongMode);
  EXPECT_EQ(chip.device.read_frame().error(), Error::kWrongMode);
  EXPECT_EQ(chip.device.read_all(frame).error(), Error::kWrongMode);
  EXPECT_EQ(chip.bus.count(), 0U);
}

TEST(DriverCallErrors, Busy_TouchesNothing) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kReadBegun);
  chip.bus.plan({});
  Frame frame;
  EXPECT_EQ(chip.device.initialize().error(), Error::kBusy);
  EXPECT_EQ(chip.device.read_frame().error(), Error::kBusy);
  EXPECT_EQ(chip.device.read_all(frame).error(), Error::kBusy);
  EXPECT_EQ(chip.device.automatic().start().error(), Error::kBusy);
  EXPECT_EQ(chip.device.automatic().stop().error(), Error::kBusy);
  EXPECT_EQ(chip.device.automatic().restart().error(), Error::kBusy);
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0, 1).error(), Error::kBusy);
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_write({1, 0}, 0, kBytes).error(), Error::kBusy);
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_command({}).error(), Error::kBusy);
  EXPECT_EQ(chip.device.control().read_registers({1, 0}, 0, buffer).error(), Error::kBusy);
  EXPECT_EQ(chip.device.control().write_registers({1, 0}, 0, kBytes).error(), Error::kBusy);
  EXPECT_EQ(chip.device.control().send({}).error(), Error::kBusy);
  EXPECT_EQ(mb4::scan_bus(chip.device, 1, {}).error(), Error::kBusy);
  EXPECT_EQ(chip.bus.count(), 0U);
}

TEST(DriverCallErrors, InvalidArgument_TouchesNothing) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kAutomatic);
  chip.bus.plan({});
  mb4::Device<mb4test::FaultBus, mb4::tool::SimClock>& device = chip.device;
  EXPECT_EQ(device.automatic().poll_slave(0).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.automatic().poll_slave(2).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.automatic().poll_slave(9).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.clear_valid(0).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.clear_valid(9).error(), Error::kInvalidArgument);
  EXPECT_EQ(mb4_c::PolledAccess(device).begin_read({3, 0}, 0, 1).error(), Error::kInvalidArgument);
  EXPECT_EQ(mb4_c::PolledAccess(device).begin_write({1, 8}, 0, kBytes).error(),
            Error::kInvalidArgument);
  EXPECT_EQ(mb4_c::PolledAccess(device).take(buffer).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.control().read_registers({1, 0}, 125, buffer).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.control().write_registers({1, 0}, 125, kBytes).error(), Error::kInvalidArgument);
  mb4::Command reserved;
  reserved.code = 4;
  EXPECT_EQ(mb4_c::PolledAccess(device).begin_command(reserved).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.control().send(reserved).error(), Error::kInvalidArgument);
  EXPECT_EQ(mb4::scan_bus(device, 3, {}).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.fields().modify<regs::FREQS>(32).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.opcodes().write_registers(0xFE, kBytes).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.opcodes().read_registers(0xFE, buffer).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.opcodes().read_status({}).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.opcodes().write_instruction({}).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.opcodes().read_registers0({}).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.opcodes().write_registers0({}).error(), Error::kInvalidArgument);
  ASSERT_TRUE(device.automatic().stop().ok());
  chip.bus.plan({});
  EXPECT_EQ(device.read_frame(0).error(), Error::kInvalidArgument);
  EXPECT_EQ(device.read_frame(2).error(), Error::kInvalidArgument);
  EXPECT_EQ(chip.bus.count(), 0U);
}

TEST(DriverCallErrors, ImpossibleConfiguration_IsRefusedBeforeAnyWrite) {
  FaultyChip chip(kEncoder);
  chip.bus.plan({});
  Config config = encoder(false);
  config.ma_hz = 3'000'000;  // not in table 35
  EXPECT_EQ(chip.device.configure(config).error(), Error::kInvalidConfig);
  config = encoder(false);
  config.spi_check = static_cast<mb4::SpiCheck>(4);
  EXPECT_EQ(chip.device.configure(config).info().field, mb4::ConfigField::kSpiCheck);
  EXPECT_EQ(chip.bus.count(), 0U);
}

// The driver finds and names a register that has changed without its knowledge.
TEST(DriverCallErrors, ConfigurationChanged_VerifyNamesIt) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kConfigured);
  const std::array<std::uint8_t, 1> other{0x5A};
  ASSERT_TRUE(chip.device.opcodes().write_registers(0xC0, other).ok());
  const mb4::Result<void> verified = chip.device.verify();
  EXPECT_EQ(verified.error(), Error::kVerify);
  EXPECT_EQ(verified.info().address(), 0xC0);
  EXPECT_EQ(chip.device.read_frame().error(), Error::kNotConfigured);
  ASSERT_TRUE(chip.device.configure(encoder(false)).ok());
  EXPECT_TRUE(chip.device.verify().ok());
}

// Also while frames run and beside a register access.
TEST(DriverCallErrors, VerifyBesideFramesAndControl_IsGood) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kAutomatic);
  EXPECT_TRUE(chip.device.verify().ok());
  ASSERT_TRUE(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x44, 4).ok());
  EXPECT_TRUE(chip.device.verify().ok());
}

// A write that is lost, of the configuration or of a reset.
TEST(DriverCallErrors, LostWrite_ConfigureAndResetAreVerify) {
  FaultyChip chip(kEncoder);
  chip.bus.plan({FaultKind::kLost, 1, 1, 0});
  EXPECT_EQ(chip.device.configure(encoder(false)).error(), Error::kVerify);
  prepare(chip, State::kConfigured);
  chip.bus.plan({FaultKind::kLost, 1, 1, 0});
  EXPECT_EQ(chip.device.reset().error(), Error::kVerify);
}

// Page 21: after power-on all registers are 0.
TEST(DriverCall, Reset_LeavesTheRegistersOfPowerOn) {
  FaultyChip chip(kEncoder);
  std::array<std::uint8_t, 48> fresh{};
  std::array<std::uint8_t, 48> after{};
  ASSERT_TRUE(chip.device.opcodes().read_registers(0xC0, fresh).ok());
  prepare(chip, State::kConfigured);
  ASSERT_TRUE(chip.device.read_frame().ok());
  ASSERT_TRUE(chip.device.reset().ok());
  ASSERT_TRUE(chip.device.opcodes().read_registers(0xC0, after).ok());
  EXPECT_EQ(after, fresh);
  EXPECT_EQ(chip.device.read_frame().error(), Error::kNotConfigured);
}

// Page 33: t = SCDATA / (4 f_MA). A cable of 500 ns at 5 MHz is ten quarters and the one that the
// edge itself takes.
TEST(DriverInitialize, LineDelay_IsMeasuredOnBothChannels) {
  const auto slave = [](const std::string& delay, unsigned number) {
    return "[[channel]]\nnumber = " + std::to_string(number) + "\ndelay_ns = " + delay +
           "\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n";
  };
  for (const mb4::SpiCheck check : {mb4::SpiCheck::kOff, mb4::SpiCheck::kFull}) {
    FaultyChip chip(slave("520", 1) + slave("1020", 2));
    Config config = encoder(false);
    config.spi_check = check;
    config.channels[1].protocol = mb4::Protocol::kBissC;
    config.slaves[4] = config.slaves[0];
    ASSERT_TRUE(chip.device.configure(config).ok());
    const mb4::Result<mb4::LineDelay> delay = chip.device.initialize();
    ASSERT_TRUE(delay.ok());
    // At most the figure, and more than one quarter (50 ns) less.
    for (const unsigned channel : {0U, 1U}) {
      const std::uint32_t ns = mb4::line_delay_ns(config, delay->quarters[channel]);
      EXPECT_GE(ns, 520U + 500U * channel);
      EXPECT_LE(ns, 520U + 500U * channel + 100U);
    }
    EXPECT_TRUE(chip.device.read_frame().ok());
  }
}

TEST(DriverInitialize, DelayBeyond255Quarters_IsLineDelay) {
  FaultyChip chip(
      "[[channel]]\nnumber = 1\ndelay_ns = 14000\n[[channel.slave]]\n"
      "protocol = \"biss-c\"\ndata_bits = 28\n");
  ASSERT_TRUE(chip.device.configure(encoder(false)).ok());
  EXPECT_EQ(chip.device.initialize().error(), Error::kLineDelay);
}

// Without a system clock, or with a line that never moves, nothing is measured.
TEST(DriverInitialize, NoClock_IsAnError) {
  FaultyChip chip("[chip]\nf_clk_hz = 0\n" + kEncoder);
  ASSERT_TRUE(chip.device.configure(encoder(false)).ok());
  EXPECT_EQ(chip.device.initialize().error(), Error::kTimeout);
}

// SL without an edge is no error of INIT (page 33), but there is no delay either; without a slave
// SL stays high and the count runs over.
TEST(DriverInitialize, LineStuck_IsAnError) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kConfigured);
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  EXPECT_EQ(chip.device.initialize().error(), Error::kLineError);
  clocked(chip.simulator.line(1))->faults().stick(true);
  chip.simulator.refresh_lines();
  EXPECT_EQ(chip.device.initialize().error(), Error::kLineDelay);
  clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
  EXPECT_TRUE(chip.device.initialize().ok());
}

TEST(DriverInitialize, BusyChip_IsTimeout) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kConfigured);
  // An instruction that another host has left: a frame without end on a line that stays high.
  clocked(chip.simulator.line(1))->faults().stick(true);
  chip.simulator.refresh_lines();
  const std::array<std::uint8_t, 1> frame{0x04};
  ASSERT_TRUE(chip.device.opcodes().write_instruction(frame).ok());
  chip.simulator.advance(100 * mb4::sim::kPsPerUs);
  EXPECT_EQ(chip.device.initialize().error(), Error::kTimeout);
}

TEST(DriverInitialize, AfterAFailedRead_RecoversFirst) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kConfigured);
  chip.bus.plan({FaultKind::kRefused, 1, 1, 0});
  EXPECT_EQ(chip.device.read_frame().error(), Error::kTransport);
  chip.bus.plan({});
  EXPECT_TRUE(chip.device.initialize().ok());
  chip.bus.plan({FaultKind::kRefused, 1, 1, 0});
  EXPECT_EQ(chip.device.read_frame().error(), Error::kTransport);
  chip.bus.plan({FaultKind::kRefused, 0, 0, 0});
  EXPECT_EQ(chip.device.initialize().error(), Error::kTransport);
}

// The delay is read twice: a flipped bit in one of them shows.
TEST(DriverInitialize, FlippedBitInTheDelay_IsCorrupted) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kConfigured);
  ASSERT_TRUE(chip.device.initialize().ok());  // behind the reset it takes longer
  chip.bus.plan({});
  ASSERT_TRUE(chip.device.initialize().ok());
  std::size_t delay = 0;  // the first transfer that reads registers
  while (chip.bus.opcodes()[delay] != 0x03) ++delay;
  chip.bus.plan({FaultKind::kFlipMiso, delay, delay, 20});
  EXPECT_EQ(chip.device.initialize().error(), Error::kCorrupted);
}

// ---- Errors that the line causes ----------------------------------------------------------------

TEST(DriverCallErrors, BrokenFrames_EachCallTellsWhatIsWrong) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kConfigured);
  clocked(chip.simulator.line(1))->faults().flip_next_frame({10});
  EXPECT_EQ(chip.device.read_frame().error(), Error::kCrc);
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  EXPECT_EQ(chip.device.read_frame().error(), Error::kLineError);
  Frame frame;
  EXPECT_EQ(chip.device.read_all(frame).error(), Error::kLineError);
  clocked(chip.simulator.line(1))->faults().stick(true);
  chip.simulator.refresh_lines();
  EXPECT_EQ(chip.device.read_frame().error(), Error::kTimeout);
  EXPECT_EQ(chip.device.read_all(frame).error(), Error::kTimeout);
}

TEST(DriverCallErrors, BrokenAutomaticFrames_EachCallTellsWhatIsWrong) {
  FaultyChip chip(kEncoder);
  prepare(chip, State::kAutomatic);
  Frame frame;
  ASSERT_TRUE(chip.device.automatic().poll_slave(1).ok());
  // Behind a word that has just come, the next one is far.
  bool new_word = false;
  for (int i = 0; i < 100 && !new_word; ++i) {
    chip.simulator.advance(2 * mb4::sim::kPsPerUs);
    new_word = chip.device.automatic().poll_slave(1).ok();
  }
  ASSERT_TRUE(new_word);
  EXPECT_EQ(chip.device.automatic().poll_slave(1).error(), Error::kNoData);
  ASSERT_TRUE(chip.device.automatic().poll(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kNoData);
  // A bad frame may end while the bank is held, and the next one then overwrites it.
  Error error = Error::kNone;
  for (int i = 0; i < 100 && error != Error::kCrc; ++i) {
    if (error == Error::kNone) clocked(chip.simulator.line(1))->faults().flip_next_frame({10});
    chip.simulator.advance(10 * mb4::sim::kPsPerUs);
    error = chip.device.automatic().poll_slave(1).error();
  }
  EXPECT_EQ(error, Error::kCrc);
  // It counts once.
  ASSERT_TRUE(chip.device.automatic().poll(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kNoData);
  chip.simulator.advance(100 * mb4::sim::kPsPerUs);
  ASSERT_TRUE(chip.device.automatic().poll(frame).ok());
  ASSERT_TRUE(frame[1].ok());
  error = Error::kNone;
  for (int i = 0; i < 100 && error != Error::kCrc; ++i) {
    if (error == Error::kNone) clocked(chip.simulator.line(1))->faults().flip_next_frame({10});
    chip.simulator.advance(10 * mb4::sim::kPsPerUs);
    ASSERT_TRUE(chip.device.automatic().poll(frame).ok());
    error = frame[1].error();
  }
  EXPECT_EQ(error, Error::kCrc);
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  while (chip.device.automatic().next(frame).ok()) {
  }
  EXPECT_EQ(chip.device.automatic().next(frame).error(), Error::kLineError);
}

}  // namespace
