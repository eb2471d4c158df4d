// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// Several slaves on one and on two channels: registers, one frame for all, one of several.

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mb4/device.hpp"
#include "mb4/register_image.hpp"
#include "tests/driver/mb4/encoder26.hpp"
#include "tests/driver/mb4/strict_bus.hpp"
#include "tests/driver/mb4/three_slaves.hpp"

namespace {
namespace multi_slave_test {

using mb4::Config;
using mb4::Error;
using mb4::Frame;
using mb4test::Bytes;
using mb4test::FakeClock;
using mb4test::hex;
using mb4test::join;
using mb4test::kBreak;
using mb4test::kReadStatus;
using mb4test::kRunning;
using mb4test::kStartFrame;
using mb4test::StrictBus;
using mb4test::three_slaves;
using mb4test::zeros;

// The compiler checks it as well.
static_assert(mb4::validate(three_slaves()).ok());

class MultiSlave : public testing::Test {
 protected:
  void configure() {
    mb4test::expect_configure_three(bus);
    ASSERT_TRUE(device.configure(three_slaves()).ok());
  }
  void expect_frame(const Bytes& status) {
    bus.expect_write(kStartFrame);
    bus.expect_read(kReadStatus, kRunning);
    bus.expect_read(kReadStatus, status);
  }

  StrictBus bus;
  FakeClock clock;
  mb4::Device<StrictBus, FakeClock> device{bus, clock};
  Frame frame;
};

TEST(MultiSlaveImage, TwoChannels_MatchHandWorkedBytes) {
  const mb4::RegisterImage image = mb4::encode_registers(three_slaves());
  EXPECT_EQ(hex(Bytes(image.begin(), image.end())),
            hex(join({mb4test::three_configuration(), {0x00, 0x00, 0x00}})));
}

// Tables 25, 38: HOLDCDM is bit 0 of 0xE5, SINGLEBANK bit 0 of 0xE7.
TEST(MultiSlaveImage, SingleBankAndHoldCdm_HaveTheirBits) {
  Config config = three_slaves();
  config.single_bank = true;
  config.hold_cdm = true;
  EXPECT_EQ(mb4::encode_registers(config)[0xE5 - 0xC0], 0xC1);
  EXPECT_EQ(mb4::encode_registers(config)[0xE7 - 0xC0], 0x03);
}

TEST(MultiSlaveConfig, EightSlavesOnOneChannel_AreValid) {
  Config config = mb4test::encoder26();
  for (std::size_t i = 1; i < 8; ++i) {
    config.slaves[i] = config.slaves[0];
  }
  EXPECT_TRUE(mb4::validate(config).ok());
  EXPECT_EQ(mb4::frame_periods(config), 5U + 8 * 34);
  EXPECT_EQ(mb4::encode_registers(config)[0xEC - 0xC0], 0x01);
}

// The longer channel decides: 5 + 28 + 6 + 14 + 5 against 5 + 24 + 16.
TEST(MultiSlaveConfig, TwoChannels_FrameIsTheLongerOne) {
  EXPECT_EQ(mb4::frame_periods(three_slaves()), 58U);
  EXPECT_EQ(mb4::channel_of(three_slaves(), 4), 1);
  EXPECT_EQ(mb4::channel_of(three_slaves(), 5), 2);
  EXPECT_EQ(mb4::channel_of(mb4test::encoder26(), 5), 1);
}

// Page 27: with HOLDCDM the master need not be configured according to the slaves; page 30: AGSMIN
// needs complete frames all the same.
TEST(MultiSlaveConfig, ChannelWithoutSlave_NeedsHoldCdmAndNoWaitForLine) {
  Config config = mb4test::encoder26();
  config.slaves[0].enabled = false;
  EXPECT_EQ(mb4::validate(config).info().field, mb4::ConfigField::kSlaveEnabled);
  config.hold_cdm = true;
  EXPECT_EQ(mb4::validate(config).info().field, mb4::ConfigField::kSlaveEnabled);
  config.frame_start = mb4::FrameStart::kPeriodic;
  config.frame_period_clk = 2000;
  EXPECT_TRUE(mb4::validate(config).ok());
  config.hold_cdm = false;
  EXPECT_EQ(mb4::validate(config).info().field, mb4::ConfigField::kSlaveEnabled);
}

TEST(MultiSlaveConfig, OnlyChannel2_IsValid) {
  Config config = three_slaves();
  config.channels[0].protocol = mb4::Protocol::kUnused;
  config.slaves[0].enabled = false;
  config.slaves[1].enabled = false;
  EXPECT_TRUE(mb4::validate(config).ok());
}

// Slaves 1 and 2 are four bytes apart: two bursts are shorter than one. Slave 5 is far away.
TEST_F(MultiSlave, AllGood_OneFrameForAll) {
  configure();
  expect_frame(mb4test::kThreeValid);
  mb4test::expect_three_data(bus);
  bus.expect_write(mb4test::kThreeClear);
  ASSERT_TRUE(device.read_all(frame).ok());
  EXPECT_TRUE(frame.good(0x13));
  EXPECT_EQ(frame[1]->position, mb4test::kPosition);
  EXPECT_EQ(frame[2]->raw, 0x1237U);
  EXPECT_EQ(frame[5]->raw, 0xABCDEFU);
  EXPECT_EQ(frame[5]->slave, 5);
  EXPECT_EQ(frame[3].error(), Error::kInvalidArgument);
  EXPECT_TRUE(frame.status.valid(5));
}

// nE = 0 of one slave: its word is told apart, the others are read, and the frame was good, so the
// next one needs no BREAK.
TEST_F(MultiSlave, SlaveErrorOfOne_IsNoBadFrame) {
  configure();
  for (const std::uint8_t low : {std::uint8_t{0x35}, std::uint8_t{0x37}}) {
    expect_frame(mb4test::kThreeValid);
    bus.expect_read(mb4test::kReadData4, mb4test::kData4);
    bus.expect_read({0x03, 0x08, 0, 0}, {0, 0, low, 0x12});
    bus.expect_read({0x03, 0x20, 0, 0, 0}, {0, 0, 0xEF, 0xCD, 0xAB});
    bus.expect_write(mb4test::kThreeClear);
    ASSERT_TRUE(device.read_all(frame).ok());
    EXPECT_EQ(frame[2].error(), low == 0x35 ? Error::kSlaveError : Error::kNone);
    EXPECT_EQ(frame[2].reading().position, 0x1237U >> 2U);
    EXPECT_EQ(frame.good(0x13), low == 0x37);
    EXPECT_TRUE(frame.complete(0x13));
    EXPECT_TRUE(frame[1].ok());
    EXPECT_TRUE(frame[5].ok());
  }
}

// Page 34: with nSCDERR = 0 the faulty one is identified by SVALIDx; the others' data is good. The
// frame's flags are then set right by BREAK before the next one.
TEST_F(MultiSlave, CrcErrorOfOne_OthersAreRead) {
  configure();
  expect_frame({0x00, 0x6B, 0x02, 0x02, 0x00, 0x00});
  bus.expect_read(mb4test::kReadData4, mb4test::kData4);
  bus.expect_read({0x03, 0x08, 0, 0}, {0, 0, 0x34, 0x12});
  bus.expect_read({0x03, 0x20, 0, 0, 0}, {0, 0, 0xEF, 0xCD, 0xAB});
  bus.expect_write(mb4test::kThreeClear);
  ASSERT_TRUE(device.read_all(frame).ok());
  EXPECT_FALSE(frame.good(0x13));
  EXPECT_EQ(frame[1]->position, mb4test::kPosition);
  EXPECT_EQ(frame[2].error(), Error::kCrc);
  EXPECT_EQ(frame[5]->raw, 0xABCDEFU);
  bus.expect_write(kBreak);
  bus.expect_write(mb4test::kThreeClear);
  expect_frame(mb4test::kThreeValid);
  mb4test::expect_three_data(bus);
  bus.expect_write(mb4test::kThreeClear);
  ASSERT_TRUE(device.read_all(frame).ok());
  EXPECT_TRUE(frame.good(0x13));
}

// What is bad is read too: is it all 0?
TEST_F(MultiSlave, NoneGood_NothingIsTaken) {
  configure();
  expect_frame({0x00, 0x6B, 0x00, 0x00, 0x00, 0x00});
  mb4test::expect_three_data(bus);
  ASSERT_TRUE(device.read_all(frame).ok());
  for (const unsigned slave : {1U, 2U, 5U}) {
    EXPECT_EQ(frame[slave].error(), Error::kCrc);
  }
}

// "CRC error" and all valid is a contradiction: nothing is believed.
TEST_F(MultiSlave, CrcErrorWithAllValid_IsCrcForAll) {
  configure();
  expect_frame({0x00, 0x6B, 0x0A, 0x02, 0x00, 0x00});
  ASSERT_TRUE(device.read_all(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kCrc);
  EXPECT_EQ(frame[5].error(), Error::kCrc);
}

TEST_F(MultiSlave, NoDataOfOne_IsNoData) {
  configure();
  expect_frame({0x00, 0xFB, 0x08, 0x02, 0x00, 0x00});
  bus.expect_read({0x03, 0x08, 0, 0}, {0, 0, 0x37, 0x12});
  bus.expect_read({0x03, 0x20, 0, 0, 0}, {0, 0, 0xEF, 0xCD, 0xAB});
  bus.expect_write(mb4test::kThreeClear);
  ASSERT_TRUE(device.read_all(frame).ok());
  EXPECT_EQ(frame[1].error(), Error::kNoData);
  EXPECT_TRUE(frame[2].ok());
}

TEST_F(MultiSlave, LineLowAtStart_IsLineErrorOfTheCall) {
  configure();
  expect_frame({0x00, 0x3B, 0x00, 0x00, 0x00, 0x00});
  bus.expect_write(kBreak);
  EXPECT_EQ(device.read_all(frame).error(), Error::kLineError);
  EXPECT_FALSE(frame[1].ok());
}

// Bit 14 of 14 bits is set: that came from SPI.
TEST_F(MultiSlave, CorruptedSlave_IsCorruptedAloneAndRecoversNext) {
  configure();
  expect_frame(mb4test::kThreeValid);
  bus.expect_read(mb4test::kReadData4, mb4test::kData4);
  bus.expect_read({0x03, 0x08, 0, 0}, {0, 0, 0x34, 0x52});
  bus.expect_read({0x03, 0x20, 0, 0, 0}, {0, 0, 0xEF, 0xCD, 0xAB});
  bus.expect_write(mb4test::kThreeClear);
  ASSERT_TRUE(device.read_all(frame).ok());
  EXPECT_TRUE(frame[1].ok());
  EXPECT_EQ(frame[2].error(), Error::kCorrupted);
  bus.expect_write(kBreak).fail_last();
  EXPECT_EQ(device.read_all(frame).error(), Error::kTransport);
  EXPECT_FALSE(frame[1].ok());
}

TEST_F(MultiSlave, NotConfigured_IsAnErrorWithoutTransfer) {
  EXPECT_EQ(device.read_all(frame).error(), Error::kNotConfigured);
}

TEST(MultiSlaveFailure, TransportAtEachTransfer_LeavesNoReading) {
  for (std::size_t index = 0; index < 7; ++index) {
    StrictBus bus;
    FakeClock clock;
    mb4::Device<StrictBus, FakeClock> device(bus, clock);
    mb4test::expect_configure_three(bus);
    bus.expect_write(kStartFrame);
    bus.expect_read(kReadStatus, kRunning);
    bus.expect_read(kReadStatus, mb4test::kThreeValid);
    mb4test::expect_three_data(bus);
    bus.expect_write(mb4test::kThreeClear);
    bus.fail_at(mb4test::kConfigureTransfers + index);
    ASSERT_TRUE(device.configure(three_slaves()).ok());
    Frame frame;
    EXPECT_EQ(device.read_all(frame).error(), Error::kTransport) << index;
    for (std::size_t slave = 1; slave <= 8; ++slave) {
      EXPECT_FALSE(frame[slave].ok()) << index;
    }
  }
}

// Reading one of several clears the flags of all: slave 5 must not pass this frame for a later one.
TEST_F(MultiSlave, OneOfSeveral_ReadsItsDataAndClearsAllFlags) {
  configure();
  expect_frame(mb4test::kThreeValid);
  bus.expect_read({0x03, 0x08, 0, 0}, {0, 0, 0x37, 0x12});
  bus.expect_write(mb4test::kThreeClear);
  EXPECT_EQ(device.read_frame(2)->raw, 0x1237U);
}

TEST_F(MultiSlave, CrcErrorOfAnother_DoesNotSpoilThisOne) {
  configure();
  expect_frame({0x00, 0x6B, 0x02, 0x00, 0x00, 0x00});
  bus.expect_read(mb4test::kReadData4, mb4test::kData4);
  bus.expect_write(mb4test::kThreeClear);
  EXPECT_TRUE(device.read_frame(1).ok());
}

TEST_F(MultiSlave, OwnCrcError_IsCrcWhateverTheOtherFlagSays) {
  configure();
  expect_frame({0x00, 0x2B, 0x08, 0x02, 0x00, 0x00});
  bus.expect_read(mb4test::kReadData4, mb4test::kData4);
  EXPECT_EQ(device.read_frame(1).error(), Error::kCrc);
}

// After a timeout both lines must be high: SL1 is bit 0, SL2 bit 2 of 0xF8 (table 67).
TEST_F(MultiSlave, LineOfChannel2StaysLow_IsLineError) {
  configure();
  clock.step_us = 1000;
  bus.expect_write(kStartFrame);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_read(kReadStatus, kRunning);
  bus.expect_write(kBreak);
  for (int look = 0; look < 3; ++look) {
    bus.expect_read(join({{0x05}, zeros(9)}), join({zeros(9), {0x51}}));
  }
  EXPECT_EQ(device.read_all(frame).error(), Error::kLineError);
}

// Eight slaves with 6 bytes each, gaps of 2 bytes: three share a burst of 23 bytes, as more would
// be longer than 25; or all, if the caller allows it. With 5 bytes each the gaps are too wide.
// Slaves 1 and 8 alone: two bursts, as for slaves that are left out.
TEST(ReadData, NeighboursWithSmallGap_ShareOneBurst) {
  Config config = mb4test::encoder26();
  std::array<mb4_word, 8> words{};
  const auto bursts = [&](std::uint8_t bits, std::uint8_t count, bool wide, std::uint16_t flags) {
    config.slaves[0].data_bits = bits;
    for (std::uint8_t i = 0; i < 8; ++i) {
      config.slaves[i] = config.slaves[0];
      mb4::detail::set_word(config, static_cast<std::uint8_t>(i + 1), words[i]);
    }
    if (count == 2) words[1] = words[7];
    mb4_cyclic read{};
    mb4_plan plan{};
    std::array<std::uint32_t, MB4_PLAN_WORDS(8)> tx{};
    std::array<std::uint32_t, MB4_PLAN_WORDS(8)> rx{};
    mb4_plan_memory(&plan, tx.data(), rx.data());
    read.words = words.data();
    read.count = count;
    read.wide = wide;
    mb4_cyclic_add_data(&read, &plan, flags, MB4_WITH_ALL);
    std::string list;
    for (std::uint8_t i = 0; i < plan.frames; ++i) {
      const std::uint8_t* frame = mb4_plan_tx(&plan, i);
      list += hex(Bytes(frame, frame + (frame[0] == 0x09 ? 1 : 2))) + ":" +
              std::to_string(plan.size[i]) + " ";
    }
    return list;
  };
  const auto all = [](const std::vector<std::pair<Bytes, int>>& expected) {
    std::string list;
    for (const auto& [head, size] : expected) list += hex(head) + ":" + std::to_string(size) + " ";
    return list;
  };
  EXPECT_EQ(bursts(48, 8, true, 0xFFFF), all({{{0x09}, 63}}));
  EXPECT_EQ(bursts(48, 8, false, 0xFFFF),
            all({{{0x09}, 23}, {{0x03, 0x18}, 24}, {{0x03, 0x30}, 16}}));
  EXPECT_EQ(bursts(40, 3, false, 0xFFFF), all({{{0x09}, 6}, {{0x03, 0x08}, 7}, {{0x03, 0x10}, 7}}));
  EXPECT_EQ(bursts(64, 8, false, 0xFFFF),
            all({{{0x09}, 25}, {{0x03, 0x18}, 18}, {{0x03, 0x28}, 18}, {{0x03, 0x38}, 10}}));
  const std::vector<std::pair<Bytes, int>> two{{{0x09}, 7}, {{0x03, 0x38}, 8}};
  EXPECT_EQ(bursts(48, 2, true, 0xFFFF), all(two));
  EXPECT_EQ(bursts(48, 8, true, mb4::flag_of(1) | mb4::flag_of(8)), all(two));
}

}  // namespace multi_slave_test
}  // namespace
