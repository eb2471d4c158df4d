// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// BiSS B by the driver on the Verilated chip: frames, registers by the hand-over and through MO,
// INIT, and what goes wrong (pages 16, 28, 30, 32, 34).

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/c/mb4_c_access.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/driver/rtl/protocol_bus.hpp"

namespace {

using namespace mb4test;  // NOLINT: scenarios and configurations
using mb4::Config;
using mb4::Error;
using mb4::Protocol;
using mb4::SlaveAddress;
using mb4::Span;

// The parameter: through MO.
class DriverBissB : public testing::TestWithParam<bool> {
 protected:
  // Configures `chip` for the bus of biss_b_bus().
  static void configure(FaultyChip& chip) {
    ASSERT_TRUE(chip.device.configure(biss_b_config(GetParam())).ok());
  }
  // ID of the only slave: 1 with MO, which has ID 0 for itself.
  static SlaveAddress slave() { return mb4::slave_address(biss_b_config(GetParam()), 1); }
};

INSTANTIATE_TEST_SUITE_P(Entry, DriverBissB, testing::Bool(),
                         [](const auto& test) { return test.param ? "Mo" : "HandOver"; });

TEST_P(DriverBissB, Registers_AreWrittenAndReadBetweenFrames) {
  FaultyChip chip(biss_b_bus(GetParam(), "data = 0xABCDEF7"));
  configure(chip);
  EXPECT_EQ(slave().id, GetParam() ? 1 : 0);
  for (const std::size_t count : {1U, 2U, 63U, 64U, 65U, 128U}) {
    std::vector<std::uint8_t> bytes(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(0x35 * i + count);
    const Span<const std::uint8_t> data(bytes.data(), count);
    ASSERT_TRUE(chip.device.control().write_registers(slave(), 0, data).ok()) << count;
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(chip.simulator.slave(1)->reg_read(static_cast<std::uint8_t>(i)), bytes[i]) << i;
    }
    std::vector<std::uint8_t> back(count);
    ASSERT_TRUE(
        chip.device.control().read_registers(slave(), 0, Span<std::uint8_t>(back.data(), count)))
        << count;
    EXPECT_EQ(back, bytes);
    const mb4::Result<mb4::Reading> reading = chip.device.read_frame();
    ASSERT_TRUE(reading.ok()) << mb4::to_string(reading.error());
    EXPECT_EQ(reading->position, 0xABCDEF7U);
  }
}

// Every FREQR, and the slowest MA with it.
TEST_P(DriverBissB, EveryRegisterClock_Works) {
  for (unsigned freqr = 0; freqr < 8; ++freqr) {
    const std::uint16_t divider = static_cast<std::uint16_t>(2U << freqr);
    const std::string timeout = std::to_string(0.8 * 0.5 * divider);
    FaultyChip chip(on_channel(1, GetParam() ? "mo = true\n" : "") +
                    device("biss-b", 16, "timeout = 2\nregister_timeout = " + timeout));
    Config config = biss_b_config(GetParam());
    config.slaves[0].data_bits = 16;
    config.register_divider = divider;
    config.register_timeout_us = 110;
    ASSERT_TRUE(chip.device.configure(config).ok());
    const std::array<std::uint8_t, 1> byte{static_cast<std::uint8_t>(divider / 2 + 3)};
    std::array<std::uint8_t, 1> back{};
    ASSERT_TRUE(chip.device.control().write_registers(slave(), 0x21, byte).ok()) << divider;
    ASSERT_TRUE(chip.device.control().read_registers(slave(), 0x21, back).ok()) << divider;
    EXPECT_EQ(back, byte) << divider;
  }
}

// A slave that is busy, within the chip's limit of 4096 register clocks and beyond.
TEST_P(DriverBissB, BusySlave_IsWaitedForUpToTheLimit) {
  for (const unsigned clocks : {0U, 100U, 4000U}) {
    FaultyChip chip(biss_b_bus(
        GetParam(), "registers = { 0x30 = [7, 8] }\nread_busy_clocks = " + std::to_string(clocks)));
    configure(chip);
    std::array<std::uint8_t, 2> back{};
    ASSERT_TRUE(chip.device.control().read_registers(slave(), 0x30, back).ok()) << clocks;
    EXPECT_EQ(back[0], 7);
    EXPECT_EQ(back[1], 8);
  }
  FaultyChip chip(biss_b_bus(GetParam(), "read_busy_clocks = \"forever\""));
  configure(chip);
  std::array<std::uint8_t, 1> back{};
  EXPECT_EQ(chip.device.control().read_registers(slave(), 0x30, back).error(),
            Error::kRegisterDelay);
  EXPECT_TRUE(chip.device.read_frame().ok());
}

// Without a system clock nothing begins.
TEST_P(DriverBissB, NoClock_IsTimeout) {
  FaultyChip chip("[chip]\nf_clk_hz = 0\n" + biss_b_bus(GetParam()));
  configure(chip);
  std::array<std::uint8_t, 1> back{};
  EXPECT_EQ(chip.device.control().read_registers(slave(), 0x30, back).error(), Error::kTimeout);
}

TEST_P(DriverBissB, SecondRegisterMissing_ErrorCountsTheFirst) {
  FaultyChip chip(biss_b_bus(GetParam(), "missing = [0x31]\nregisters = { 0x30 = 7 }"));
  configure(chip);
  std::array<std::uint8_t, 2> back{};
  const mb4::Result<void> read = chip.device.control().read_registers(slave(), 0x30, back);
  EXPECT_EQ(read.error(), Error::kRegisterDelay);
  EXPECT_EQ(read.info().bytes(), 1);
  const mb4::Result<void> written = chip.device.control().write_registers(slave(), 0x30, back);
  EXPECT_EQ(written.error(), Error::kRegister);
  EXPECT_EQ(written.info().bytes(), 1);
}

TEST_P(DriverBissB, NobodyHasThisId_IsAnError) {
  FaultyChip chip(biss_b_bus(GetParam()));
  configure(chip);
  std::array<std::uint8_t, 1> byte{0x12};
  EXPECT_EQ(chip.device.control().read_registers({1, 3}, 0x30, byte).error(),
            Error::kRegisterDelay);
  EXPECT_EQ(chip.device.control().write_registers({1, 3}, 0x30, byte).error(), Error::kRegister);
  EXPECT_TRUE(chip.device.read_frame().ok());
}

// With a line that is stuck high no slave takes part in the hand-over or answers; BREAK and
// the next access work again.
TEST_P(DriverBissB, LineStuck_IsAnErrorAndComesBack) {
  FaultyChip chip(biss_b_bus(GetParam(), "registers = { 0x30 = 7 }"));
  configure(chip);
  std::array<std::uint8_t, 1> byte{};
  clocked(chip.simulator.line(1))->faults().stick(true);
  chip.simulator.refresh_lines();
  const Error read = chip.device.control().read_registers(slave(), 0x30, byte).error();
  EXPECT_TRUE(read == Error::kRegister || read == Error::kRegisterDelay) << static_cast<int>(read);
  EXPECT_EQ(chip.device.control().write_registers(slave(), 0x30, byte).error(), Error::kRegister);
  clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
  ASSERT_TRUE(chip.device.control().read_registers(slave(), 0x30, byte).ok());
  EXPECT_EQ(byte[0], 7);
  EXPECT_TRUE(chip.device.read_frame().ok());
}

// A chip that sets nAGSERR = 0 at each write of 0xF4 (AGSERR_ON_INSTR_WRITE) does not look as if
// the hand-over had failed.
TEST_P(DriverBissB, AgserrAtEachWrite_IsNoError) {
  FaultyChip chip("[chip.quirks]\nAGSERR_ON_INSTR_WRITE = true\n" +
                  biss_b_bus(GetParam(), "registers = { 0x30 = 7 }"));
  configure(chip);
  std::array<std::uint8_t, 1> byte{};
  ASSERT_TRUE(chip.device.control().read_registers(slave(), 0x30, byte).ok());
  EXPECT_EQ(byte[0], 7);
}

TEST_P(DriverBissB, WrongUse_TouchesNothing) {
  FaultyChip chip(biss_b_bus(GetParam()));
  configure(chip);
  std::array<std::uint8_t, 1> byte{};
  chip.bus.plan({});
  const mb4::Result<void> command = chip.device.control().send({});
  EXPECT_EQ(command.error(), Error::kUnsupported);
  EXPECT_EQ(command.info().field, mb4::ConfigField::kChannelProtocol);
  EXPECT_EQ(command.info().number, 1);
  EXPECT_EQ(mb4::scan_bus(chip.device, 1, {}).error(), Error::kUnsupported);
  if (GetParam()) {
    EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0, 1).error(),
              Error::kInvalidArgument);
  }
  EXPECT_EQ(chip.bus.count(), 0U);
  ASSERT_TRUE(chip.device.automatic().start().ok());
  chip.bus.plan({});
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_read(slave(), 0, 1).error(), Error::kWrongMode);
  EXPECT_EQ(mb4_c::PolledAccess(chip.device).begin_write(slave(), 0, byte).error(),
            Error::kWrongMode);
  EXPECT_EQ(chip.bus.count(), 0U);
}

// The read's bytes can only be this access's: a lost instruction does not look like an access that
// has ended, not even right behind another one.
TEST_P(DriverBissB, EachTransferLost_NeverOldRegisters) {
  std::size_t count = 0;
  for (std::size_t index = 0; index == 0 || index < count; ++index) {
    FaultyChip chip(biss_b_bus(GetParam(), "registers = { 0x30 = 7, 0x31 = 8 }"));
    configure(chip);
    std::array<std::uint8_t, 1> byte{};
    ASSERT_TRUE(chip.device.control().read_registers(slave(), 0x30, byte).ok());
    if (index == 0) {
      chip.bus.plan({});
      ASSERT_TRUE(chip.device.control().read_registers(slave(), 0x31, byte).ok());
      count = chip.bus.count();
      ASSERT_TRUE(chip.device.control().read_registers(slave(), 0x30, byte).ok());
    }
    chip.bus.plan({FaultKind::kLost, index, index, 0});
    if (chip.device.control().read_registers(slave(), 0x31, byte).ok()) {
      EXPECT_EQ(byte[0], 8) << "transfer " << index << " of " << count;
    }
    // Of the polls in the middle some will do.
    if (count > 40 && index == 8) index = count - 20;
  }
}

// The slave is still in register mode when the last byte has come, and behind INIT, and after a
// read SL does not show it, with MO not at all: what follows waits.
class DriverBissBInit : public DriverBissB {};

INSTANTIATE_TEST_SUITE_P(Entry, DriverBissBInit, testing::Bool(),
                         [](const auto& test) { return test.param ? "Mo" : "HandOver"; });

TEST_P(DriverBissBInit, SlowRegisterTimeout_WhatFollowsAnAccessWaits) {
  FaultyChip chip(on_channel(1, GetParam() ? "mo = true\n" : "") +
                  device("biss-b", 28, "timeout = 2\nregister_timeout = 1000\nflag_bits = 0"));
  Config config = biss_b_config(GetParam());
  config.register_timeout_us = 1050;
  ASSERT_TRUE(chip.device.configure(config).ok());
  std::array<std::uint8_t, 1> byte{0x5A};
  for (const bool read : {false, true, true}) {
    for (const bool init : {false, true}) {
      ASSERT_TRUE((read ? chip.device.control().read_registers(slave(), 0x30, byte)
                        : chip.device.control().write_registers(slave(), 0x30, byte))
                      .ok());
      EXPECT_EQ(byte[0], 0x5A);
      if (init) {
        const mb4::Result<mb4::LineDelay> delay = chip.device.initialize();
        ASSERT_TRUE(delay.ok()) << mb4::to_string(delay.error());
        EXPECT_EQ(delay->quarters[0], 0);
      }
      ASSERT_TRUE(chip.device.read_frame().ok());
    }
  }
}

// SL = 0 is the hand-over itself, but never ends; SL = 1 is no hand-over.
TEST_P(DriverBissBInit, LineStuck_IsLineErrorAndComesBack) {
  FaultyChip chip(biss_b_bus(GetParam()));
  configure(chip);
  for (const bool level : {false, true}) {
    clocked(chip.simulator.line(1))->faults().stick(level);
    chip.simulator.refresh_lines();
    EXPECT_EQ(chip.device.initialize().error(), Error::kLineError) << level;
  }
  clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
  chip.simulator.refresh_lines();
  EXPECT_TRUE(chip.device.initialize().ok());
  EXPECT_TRUE(chip.device.read_frame().ok());
}

// Step by step, with other work between.
TEST_P(DriverBissB, StepByStep_PollSaysWhenItHasEnded) {
  FaultyChip chip(biss_b_bus(GetParam(), "registers = { 0x30 = [1, 2, 3, 4] }"));
  configure(chip);
  ASSERT_TRUE(mb4_c::PolledAccess(chip.device).begin_read(slave(), 0x30, 4).ok());
  EXPECT_EQ(chip.device.read_frame().error(), Error::kBusy);
  unsigned polls = 0;
  mb4::Result<bool> ended = false;
  while (ended && !*ended) {
    chip.simulator.advance(20 * mb4::sim::kPsPerUs);
    ended = mb4_c::PolledAccess(chip.device).poll();
    ASSERT_LT(++polls, 100U);
  }
  ASSERT_TRUE(ended.ok());
  std::array<std::uint8_t, 4> bytes{};
  ASSERT_TRUE(mb4_c::PolledAccess(chip.device).take(bytes).ok());
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 4>{1, 2, 3, 4}));
  ASSERT_TRUE(mb4_c::PolledAccess(chip.device).begin_read(slave(), 0x30, 4).ok());
  ASSERT_TRUE(chip.device.control().abort().ok());
  EXPECT_TRUE(chip.device.read_frame().ok());
}

// One flipped bit of HOLDBANK beside automatic frames starts the request at rest: here a register
// access, during which no frame runs. It ends by itself within the register limit, nothing is
// written, and what is missing is counted.
TEST_P(DriverBissB, FlippedBitAtRest_IsAGapThatIsCounted) {
  constexpr unsigned kPeriodUs = 100;
  FaultyChip chip(biss_b_bus(GetParam(), "registers = { 0x30 = [7, 8] }"));
  Config config = biss_b_config(GetParam());
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = 20 * kPeriodUs;
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.automatic().start().ok());
  constexpr std::uint8_t kWith = MB4_WITH_ALL | MB4_WITH_COUNTS;
  mb4_counts counts{};
  counts.period_ns = 1000 * kPeriodUs;
  chip.device.automatic().count(&counts);
  const auto read = [&chip] {
    chip.simulator.advance(kPeriodUs * mb4::sim::kPsPerUs - 30 * mb4::sim::kPsPerUs);
    return chip.device.automatic().poll_slave<kWith>(1);
  };
  for (int i = 0; i < 5; ++i) static_cast<void>(read());
  ASSERT_GE(counts.good, 2U);
  chip.bus.plan({FaultKind::kFlipMosi, 0, 0, 12});  // 0x41 -> 0x49
  static_cast<void>(read());
  chip.bus.plan({});
  const std::uint32_t began_us = chip.clock.now_us();
  const std::uint32_t good = counts.good;
  while (counts.good == good && chip.clock.now_us() - began_us < 100'000) {
    static_cast<void>(read());
  }
  // 4096 register clocks of 4 us, the slave's timeout and two periods.
  const std::uint32_t gap_us = chip.clock.now_us() - began_us;
  EXPECT_LE(gap_us, 4096 * 4 + 5 + 3 * kPeriodUs);
  EXPECT_GE(counts.lost + 3, gap_us / kPeriodUs);
  std::uint32_t run = 0;
  for (int i = 0; i < 20; ++i) run += read().ok() ? 1 : 0;
  EXPECT_GE(run, 10U);  // the loop is faster than the frames
  EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x30), 7);
  EXPECT_EQ(chip.simulator.slave(1)->reg_read(0x31), 8);
  EXPECT_TRUE(chip.device.verify().ok());
}

}  // namespace
