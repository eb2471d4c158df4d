// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Nothing old and nothing that was not sent is a position: a bus that stores nothing, an encoder
// whose data is switched off, a pin that starts frames of an encoder that is not there.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "drivers/c/mb4_c_access.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "tests/driver/rtl/fault_bus.hpp"
#include "tests/support/chip_fixture.hpp"

namespace {

using mb4::Config;
using mb4::Error;
using mb4::Frame;
using mb4::SpiCheck;
using mb4test::Fault;
using mb4test::FaultKind;
using mb4test::FaultyChip;
namespace sim = mb4::sim;

// ---- A bus that stores nothing, or late ---------------------------------------------------------

// Words whose CRC takes part of a byte, all of it, two bytes, or is not there; two of each, on one
// line, so that a burst brings both.
struct Words {
  std::string name;
  unsigned data_bits;
  std::uint32_t crc;
};

class DriverStale : public testing::TestWithParam<Words> {
 protected:
  static std::string scenario() {
    const std::string slave =
        "[[channel.slave]]\nprotocol = \"biss-c\"\ncontrol = true\nflag_bits = 0\nsource = "
        "\"ramp\"\nstep = 1\ndata_bits = " +
        std::to_string(GetParam().data_bits) + "\ncrc = " + std::to_string(GetParam().crc) + "\n";
    return "[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\n" + slave + slave;
  }
  static Config config(SpiCheck check, bool automatic) {
    Config config = mb4test::config26(10'000'000);
    config.spi_check = check;
    config.slaves[0].data_bits = static_cast<std::uint8_t>(GetParam().data_bits);
    config.slaves[0].flags = mb4::Flags::kNone;
    config.slaves[0].crc_polynomial = GetParam().crc;
    config.slaves[1] = config.slaves[0];
    if (automatic) {
      config.frame_start = mb4::FrameStart::kPeriodic;
      config.frame_period_clk = 20 * 100;
    }
    return config;
  }
};

// One object for all reads, so that its buffers hold what came before. In steps, beside an access
// and without one, and by single frames.
TEST_P(DriverStale, NothingStored_IsNeverAnOldPosition) {
  for (const SpiCheck check : {SpiCheck::kFull, SpiCheck::kFullAndRelease}) {
    for (const unsigned way : {0U, 1U, 2U, 3U}) {
      for (const FaultKind kind : {FaultKind::kStoresNot, FaultKind::kStoresLate}) {
        FaultyChip chip(scenario());
        mb4::FrameRead read;
        mb4::Operation op;
        std::uint64_t last[3] = {0, 0, 0};
        unsigned good = 0;
        ASSERT_TRUE(chip.device.configure(config(check, way != 3)).ok());
        if (way != 3) {
          ASSERT_TRUE(chip.device.automatic().start().ok());
        }
        const auto judge = [&](unsigned slave, const mb4::Result<mb4::Reading>& reading) {
          if (!reading) return;
          // The ramp counts the frames; a word of the frame before the last one is the newest that
          // can wait, and the bank may be held for some frames after a fault.
          EXPECT_GT(reading->position + 1, last[slave]) << "old";
          EXPECT_LE(chip.simulator.slave(slave)->frames() - reading->position, 8U) << "old";
          last[slave] = reading->position + 1;
          ++good;
        };
        const auto once = [&] {
          if (way == 2) {
            judge(1, chip.device.automatic().poll_slave(1));
            judge(2, chip.device.automatic().poll_slave(2));
            return;
          }
          if (way == 3) {
            ASSERT_TRUE(chip.device.plan_read_all(op, read).ok());
            do {
              chip.simulator.advance(op.pause_us() * sim::kPsPerUs);
            } while (!chip.device.finish(op, op.run(chip.bus), chip.clock.now_us()));
          } else {
            ASSERT_TRUE(chip.device.automatic().plan(read).ok());
            while (!chip.device.automatic().finish(read, read.run(chip.bus), chip.clock.now_us())) {
            }
          }
          Frame frame;
          if (read.result(frame)) {
            judge(1, frame[1]);
            judge(2, frame[2]);
          }
        };
        for (unsigned at = 0; at < 24; ++at) {
          SCOPED_TRACE("check " + std::to_string(static_cast<int>(check)) + ", way " +
                       std::to_string(way) + ", kind " + std::to_string(static_cast<int>(kind)) +
                       ", transfer " + std::to_string(at));
          if (way == 1 && at % 8 == 0) {
            static_cast<void>(chip.device.control().abort());
            ASSERT_TRUE(chip.device.automatic().restart().ok());
            ASSERT_TRUE(mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x00, 64).ok());
          }
          for (unsigned i = 0; i < 5; ++i) {
            chip.simulator.advance(110 * sim::kPsPerUs);
            chip.bus.plan(i == 2 ? Fault{kind, at, at, 0} : Fault{});
            once();
          }
          chip.bus.plan({});
        }
        EXPECT_GT(good, 24 * 4U);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Words, DriverStale,
                         testing::Values(Words{"Crc6", 24, 0x43}, Words{"Crc8", 32, 0x12F},
                                         Words{"Crc16", 40, 0x190D9}, Words{"NoCrc", 32, 0},
                                         Words{"NoCrcOddBits", 26, 0},
                                         Words{"NoRoom", 64, 0x190D9}),
                         [](const auto& test) { return test.param.name; });

// ---- An encoder whose data is switched off ------------------------------------------------------

class DriverNoWord : public testing::TestWithParam<SpiCheck> {};

// Broadcast command 00 (BiSS C, single-cycle data off): the slave acknowledges each frame and
// passes its SLI on. Each read of a frame says so, in each way to read; addressed command 00 ends
// it.
TEST_P(DriverNoWord, DataSwitchedOff_IsToldByEachRead) {
  const std::string kSlave =
      "[[channel.slave]]\nprotocol = \"biss-c\"\ncontrol = true\ndata_bits = 28\nsource = "
      "\"ramp\"\nstep = 4\nstart = 7\n";
  mb4test::Chip chip("[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\n" + kSlave);
  Config config = mb4test::config26(10'000'000);
  config.spi_check = GetParam();
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = 20 * 100;
  mb4::Command off;
  off.code = 0;
  mb4::Command on;
  on.ids = 0x01;  // addressed, code 0: data on
  on.code = 0;
  Frame frame;
  ASSERT_TRUE(chip.device.configure(config).ok());
  std::array<std::uint32_t, 16> table{};
  EXPECT_EQ(chip.device.automatic().crc_table(1, table).ok(), GetParam() != SpiCheck::kOff);
  ASSERT_TRUE(chip.device.automatic().start().ok());
  const auto sent = chip.device.control().send(off);
  ASSERT_TRUE(sent.ok()) << mb4::to_string(sent.error());
  // Frames that have ended before.
  chip.simulator.advance(110 * sim::kPsPerUs);
  static_cast<void>(chip.device.automatic().poll(frame));
  mb4_counts counts{};
  chip.device.automatic().count(&counts);
  // Both looks of a read on a bus of words may meet the slave's timeout, in which SL is 0: docs/
  // driver.md, "Left to the user". The word is kCrc then, or the alarm finds the line low. On SPI
  // and the parallel bus one look lasts longer.
  const bool fast = mb4test::test_host() == "axi" || mb4test::test_host() == "wb";
  unsigned bad = 0, low = 0;
  const auto judge = [&](Error error, int i) {
    bad += error == Error::kCrc ? 1 : 0;
    low += error == Error::kLineError ? 1 : 0;
    EXPECT_TRUE(error == Error::kNoWord ||
                (fast && (error == Error::kCrc || error == Error::kLineError)))
        << i << ": " << mb4::to_string(error);
  };
  for (int i = 0; i < 20; ++i) {
    chip.simulator.advance(110 * sim::kPsPerUs);
    judge(chip.device.automatic().poll_slave(1).error(), i);
    chip.simulator.advance(110 * sim::kPsPerUs);
    // Without a stored CRC the alarm says it after a while: the last frame was bad.
    const mb4::Result<void> polled = chip.device.automatic().poll(frame);
    judge(polled ? frame[1].error() : polled.error(), i);
  }
  EXPECT_LE(bad + low, fast ? 4U : 0U);
  EXPECT_EQ(counts.no_word, 40U - bad - low);
  EXPECT_EQ(counts.crc, bad);
  // nSCDERR = 0 of the frame that was told may end the first wait at once.
  Error told = Error::kNoData;
  for (int i = 0; i < 2 && told == Error::kNoData; ++i) {
    const mb4::Result<void> next = chip.device.automatic().next(frame);
    told = next ? frame[1].error() : next.error();
  }
  EXPECT_EQ(told, Error::kNoWord);
  ASSERT_TRUE(chip.device.automatic().stop().ok());
  chip.simulator.advance(210 * sim::kPsPerUs);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(chip.device.read_frame().error(), Error::kNoWord);
    ASSERT_TRUE(chip.device.read_all(frame).ok());
    EXPECT_EQ(frame[1].error(), Error::kNoWord);
  }
  ASSERT_TRUE(chip.device.automatic().start().ok());
  ASSERT_TRUE(chip.device.control().send(on).ok());
  chip.simulator.advance(210 * sim::kPsPerUs);
  EXPECT_TRUE(chip.device.automatic().next(frame).ok());
  EXPECT_TRUE(chip.device.automatic().next(frame).ok());
  EXPECT_TRUE(frame[1].ok());
  ASSERT_TRUE(chip.device.automatic().stop().ok());
  chip.simulator.advance(210 * sim::kPsPerUs);
  EXPECT_TRUE(chip.device.read_frame().ok());
}

// Position 0 with a right CRC, and a bad frame of it, are no such word. With a start value whose
// CRC of all zeros is all ones the chip itself finds the word that was not sent right.
TEST_P(DriverNoWord, PositionZero_IsAPosition) {
  mb4test::Chip chip(
      "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\ndata_bits = 28\n"
      "flag_bits = 0\ndata = 0\n");
  Config config = mb4test::config26(10'000'000);
  config.spi_check = GetParam();
  config.slaves[0].flags = mb4::Flags::kNone;
  ASSERT_TRUE(chip.device.configure(config).ok());
  ASSERT_TRUE(chip.device.read_frame().ok());
  EXPECT_EQ(chip.device.read_frame()->raw, 0U);
  clocked(chip.simulator.line(1))->faults().flip_next_frame({20});
  EXPECT_EQ(chip.device.read_frame().error(), Error::kCrc);
  EXPECT_EQ(chip.device.read_frame()->raw, 0U);
}

INSTANTIATE_TEST_SUITE_P(Checks, DriverNoWord,
                         testing::Values(SpiCheck::kOff, SpiCheck::kCrc, SpiCheck::kFull,
                                         SpiCheck::kFullAndRelease),
                         [](const auto& test) {
                           return "Check" + std::to_string(static_cast<int>(test.param));
                         });

// ---- Frames by pin GETSENS ----------------------------------------------------------------------

class DriverOnPin : public testing::TestWithParam<bool> {};  // the level of the dead line

// A drive gives a pulse each period and reads behind it. With pin_period_us the reads say within 17
// periods that the encoder is gone, and count what is lost; without it nothing says so.
TEST_P(DriverOnPin, Unplugged_IsAnAlarm) {
  constexpr std::uint32_t kPeriodUs = 100;
  for (const bool known : {true, false}) {
    mb4test::Chip chip(
        "[host]\nsclk_hz = 10_000_000\n[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = "
        "\"biss-c\"\ndata_bits = 28\nsource = \"ramp\"\nstep = 4\n");
    Config config = mb4test::config26(10'000'000);
    config.frame_start = mb4::FrameStart::kOnPin;
    config.pin_period_us = known ? kPeriodUs : 0;
    config.spi_check = SpiCheck::kFull;
    ASSERT_TRUE(chip.device.configure(config).ok());
    ASSERT_TRUE(chip.device.automatic().start().ok());
    mb4_counts counts{};
    chip.device.automatic().count(&counts);
    std::uint64_t due = chip.simulator.now();
    const auto tick = [&] {
      due += kPeriodUs * sim::kPsPerUs;
      chip.simulator.set_pin(sim::Pin::kGetsens, true);
      chip.simulator.advance(100 * sim::kPsPerNs);
      chip.simulator.set_pin(sim::Pin::kGetsens, false);
      chip.simulator.advance(20 * sim::kPsPerUs);
      const Error error = chip.device.automatic().poll_slave(1).error();
      chip.simulator.advance(due - chip.simulator.now());
      return error;
    };
    for (int i = 0; i < 100; ++i) EXPECT_EQ(tick(), Error::kNone) << i;
    clocked(chip.simulator.line(1))->faults().stick(GetParam());
    chip.simulator.refresh_lines();
    unsigned alarms = 0;
    unsigned first = 0;
    for (unsigned i = 1; i <= 2000; ++i) {
      const Error error = tick();
      const bool alarm = error == Error::kTimeout || error == Error::kLineError;
      EXPECT_TRUE(alarm || error == Error::kNoData) << mb4::to_string(error);
      alarms += alarm ? 1 : 0;
      if (alarm && first == 0) first = i;
    }
    if (!known) {
      EXPECT_EQ(alarms, 0U);
      continue;
    }
    EXPECT_LE(first, 17U);
    EXPECT_EQ(alarms, 2000 - first + 1);
    clocked(chip.simulator.line(1))->faults().stick(std::nullopt);
    chip.simulator.refresh_lines();
    ASSERT_TRUE(chip.device.automatic().restart().ok());
    due = chip.simulator.now();
    for (int i = 0; i < 10; ++i) EXPECT_EQ(tick(), Error::kNone) << i;
    // The frames of the 2,000 ticks, and the time of the restart.
    EXPECT_GE(counts.lost, 2000U);
    EXPECT_LE(counts.lost, 2003U);
    EXPECT_EQ(counts.sequence, counts.good + counts.lost);
  }
}

INSTANTIATE_TEST_SUITE_P(Level, DriverOnPin, testing::Bool(),
                         [](const auto& test) { return test.param ? "High" : "Low"; });

}  // namespace
