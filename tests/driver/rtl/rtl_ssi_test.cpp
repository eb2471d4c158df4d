// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// SSI by the driver on the Verilated chip: length, Gray code, flags, CRC, blind register writes of
// extended SSI, and channels of different protocols (pages 14, 16, 23 to 26).

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "drivers/c/mb4_c_access.hpp"
#include "sim/lines/clocked/clocked_line.hpp"
#include "sim/lines/registers/control_slave.hpp"
#include "tests/driver/rtl/protocol_bus.hpp"

namespace {

using namespace mb4test;  // NOLINT: scenarios and configurations
using mb4::Config;
using mb4::Error;
using mb4::Flags;
using mb4::Frame;
using mb4::Protocol;

Config ssi_config(unsigned bits, bool gray, std::uint32_t crc = 0, Flags flags = Flags::kNone) {
  Config config = empty_config(Protocol::kSsi);
  add(config, 1, bits, crc, flags);
  config.slaves[0].gray = gray;
  return config;
}

TEST(DriverSsi, EveryLength_BinaryAndGray) {
  for (unsigned bits = 1; bits <= 64; ++bits) {
    const std::uint64_t word = 0x9E3779B97F4A7C15ULL >> (64 - bits);
    for (const bool gray : {false, true}) {
      FaultyChip chip(on_channel(1) + device("ssi", bits,
                                             std::string("timeout = 3\nflag_bits = 0\n") +
                                                 (gray ? "gray = true\n" : "")));
      ASSERT_TRUE(chip.simulator.slave(1)->set_data(word));
      ASSERT_TRUE(chip.device.configure(ssi_config(bits, gray)).ok());
      const mb4::Result<mb4::Reading> reading = chip.device.read_frame();
      ASSERT_TRUE(reading.ok()) << bits;
      EXPECT_EQ(reading->position, word) << bits << gray;
      EXPECT_EQ(reading->raw, word);
    }
  }
}

// configure(), stop() and BREAK in a frame that runs; the slave then waits for the rest of its
// timeout, or the frame goes on. A read that follows at once must not take the rest of the word for
// a new one: SSI without CRC would not tell.
TEST(DriverSsi, EndsInAFrame_NextWordIsWhole) {
  constexpr std::uint64_t kWord = 0x5A5A5A5;
  enum class How : std::uint8_t { kConfigure, kStop, kBreak };
  for (const char* host : {"", "[host]\ninterface = \"axi\"\n"}) {
    for (const How how : {How::kConfigure, How::kStop, How::kBreak}) {
      for (unsigned phase = 0; phase < 40; ++phase) {
        FaultyChip chip(host + on_channel(1) + device("ssi", 27, "timeout = 90\nflag_bits = 0\n"));
        ASSERT_TRUE(chip.simulator.slave(1)->set_data(kWord));
        ASSERT_TRUE(chip.device.configure(ssi_config(27, false)).ok());
        ASSERT_TRUE(chip.device.automatic().start().ok());
        chip.simulator.advance((150 + 5 * phase) * mb4::sim::kPsPerUs);
        if (how == How::kConfigure) {
          ASSERT_TRUE(chip.device.configure(ssi_config(27, false)).ok());
        } else if (how == How::kStop) {
          ASSERT_TRUE(chip.device.automatic().stop().ok());
        } else {
          ASSERT_TRUE(chip.device.break_transmission().ok());
        }
        const mb4::Result<mb4::Reading> reading = chip.device.read_frame();
        ASSERT_TRUE(reading.ok()) << mb4::to_string(reading.error());
        EXPECT_EQ(reading->position, kWord) << host << static_cast<unsigned>(how) << phase;
      }
    }
  }
}

// The chip converts the whole word; error and warning bit behind a position in Gray code, and the
// CRC over the bits on the line, come out right all the same.
TEST(DriverSsi, GrayWithFlagsAndCrc_EachComesOutRight) {
  for (const std::uint32_t crc : {0x0U, 0x43U, 0x190D9U}) {
    for (unsigned flags = 0; flags < 4; ++flags) {
      FaultyChip chip(on_channel(1) + device("ssi", 27,
                                             "gray = true\ntimeout = 3\nflag_bits = 2\ncrc = " +
                                                 std::to_string(crc)));
      ASSERT_TRUE(chip.device.configure(ssi_config(27, true, crc, Flags::kErrorWarning)).ok());
      for (const std::uint32_t position : {0x0000001U, 0x1ABCDEFU, 0x0FFFFFFU}) {
        ASSERT_TRUE(chip.simulator.slave(1)->set_data(position << 2 | flags));
        const mb4::Result<mb4::Reading> reading = chip.device.read_frame();
        const bool error = (flags & 2U) == 0;
        ASSERT_EQ(reading.error(), error ? mb4::Error::kSlaveError : mb4::Error::kNone);
        EXPECT_EQ(reading.reading().position, position);
        EXPECT_EQ(reading.reading().slave_error, error);
        EXPECT_EQ(reading.reading().slave_warning, (flags & 1U) == 0);
        EXPECT_EQ(reading.reading().crc_stored, crc != 0);
      }
    }
  }
}

// Page 31, Table 37: rates, back to back; the interrupt's call.
TEST(DriverSsi, AutomaticFrames_AreNewEachTime) {
  for (const mb4::FrameStart start : {mb4::FrameStart::kBackToBack, mb4::FrameStart::kPeriodic}) {
    FaultyChip chip(on_channel(1) + device("ssi", 25,
                                           "timeout = 3\nflag_bits = 0\ngray = true\n"
                                           "source = \"ramp\"\n"));
    Config config = ssi_config(25, true);
    config.frame_start = start;
    config.frame_period_clk = start == mb4::FrameStart::kPeriodic ? 2000 : 0;
    ASSERT_TRUE(chip.device.configure(config).ok());
    ASSERT_TRUE(chip.device.automatic().start().ok());
    std::optional<std::uint64_t> last;
    for (unsigned i = 0; i < 20; ++i) {
      chip.simulator.advance(150 * mb4::sim::kPsPerUs);
      const mb4::Result<mb4::Reading> reading = chip.device.automatic().poll_slave(1);
      ASSERT_TRUE(reading.ok());
      EXPECT_TRUE(!last || reading->position > *last);
      last = reading->position;
      EXPECT_LE(chip.simulator.slave(1)->frames() - *last, 8U);
    }
  }
}

TEST(DriverSsi, LineLow_IsLineError) {
  FaultyChip chip(on_channel(1) + device("ssi", 13, ""));
  ASSERT_TRUE(chip.device.configure(ssi_config(13, false)).ok());
  clocked(chip.simulator.line(1))->faults().stick(false);
  chip.simulator.refresh_lines();
  EXPECT_EQ(chip.device.read_frame().error(), Error::kLineError);
}

// The parameter: with automatic frames.
class DriverExtendedSsi : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Ags, DriverExtendedSsi, testing::Bool());

TEST_P(DriverExtendedSsi, Write_ReachesTheEncoder) {
  FaultyChip chip(on_channel(1) + device("ssi", 13, "control = true\ntimeout = 3\ndata = 0x1234"));
  ASSERT_TRUE(chip.device.configure(ssi_config(13, false)).ok());
  if (GetParam()) {
    ASSERT_TRUE(chip.device.automatic().start().ok());
  }
  for (const std::size_t count : {1U, 3U, 64U}) {
    std::array<std::uint8_t, 64> bytes{};
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(0x35 * i + count);
    const mb4::Span<const std::uint8_t> data(bytes.data(), count);
    ASSERT_TRUE(chip.device.control().write_registers({1, 0}, 0x30, data).ok()) << count;
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(chip.simulator.slave(1)->reg_read(static_cast<std::uint8_t>(0x30 + i)), bytes[i]);
    }
  }
  Frame frame;
  // A write in front of the first frame has seen zeros: words that have waited are dropped.
  if (GetParam()) static_cast<void>(chip.device.automatic().next(frame));
  ASSERT_TRUE(
      (GetParam() ? chip.device.automatic().next(frame) : chip.device.read_all(frame)).ok());
  ASSERT_TRUE(frame[1].ok());
  EXPECT_EQ(frame[1]->position, 0x1234U);
}

TEST_P(DriverExtendedSsi, ReadAndScan_AreUnsupported) {
  FaultyChip chip(on_channel(1) + device("ssi", 13, "control = true\ntimeout = 3\n"));
  ASSERT_TRUE(chip.device.configure(ssi_config(13, false)).ok());
  if (GetParam()) {
    ASSERT_TRUE(chip.device.automatic().start().ok());
  }
  chip.bus.plan({});
  const mb4::Result<void> read = mb4_c::PolledAccess(chip.device).begin_read({1, 0}, 0x30, 1);
  EXPECT_EQ(read.error(), Error::kUnsupported);
  EXPECT_EQ(read.info().field, mb4::ConfigField::kChannelProtocol);
  EXPECT_EQ(read.info().number, 1);
  std::array<std::uint8_t, 2> bytes{};
  EXPECT_EQ(chip.device.control().read_registers({1, 0}, 0x30, bytes).error(), Error::kUnsupported);
  EXPECT_EQ(mb4::scan_bus(chip.device, 1, {}).error(), Error::kUnsupported);
  EXPECT_EQ(chip.bus.count(), 0U);
}

// Nothing acknowledges: an addressed command fails, a broadcast is sent.
TEST_P(DriverExtendedSsi, Commands_AreBroadcastsOnly) {
  FaultyChip chip(on_channel(1) + device("ssi", 13, "control = true\ntimeout = 3\n"));
  ASSERT_TRUE(chip.device.configure(ssi_config(13, false)).ok());
  if (GetParam()) {
    ASSERT_TRUE(chip.device.automatic().start().ok());
  }
  mb4::Command command;
  command.code = 2;
  EXPECT_TRUE(chip.device.control().send(command).ok());
  // A fast bus sees the end before the slave has seen its last CDM bit, at the end of the frame.
  chip.simulator.advance(20 * mb4::sim::kPsPerUs);
  EXPECT_EQ(clocked(chip.simulator.slave(1))->control()->counters().commands, 1U);
  command.ids = 1;
  command.test_acknowledge = true;
  EXPECT_EQ(chip.device.control().send(command).error(), Error::kCommand);
}

TEST(DriverSsi, Initialize_ResetsFlagsAlone) {
  FaultyChip chip(on_channel(1) + device("ssi", 13, ""));
  ASSERT_TRUE(chip.device.configure(ssi_config(13, false)).ok());
  const mb4::Result<mb4::LineDelay> delay = chip.device.initialize();
  ASSERT_TRUE(delay.ok());
  EXPECT_EQ(delay->quarters[0], 0);
  EXPECT_TRUE(chip.device.read_frame().ok());
}

// ---- Channels of different protocols ------------------------------------------------------------

constexpr Protocol kProtocols[] = {Protocol::kBissB, Protocol::kBissC, Protocol::kSsi};
constexpr const char* kNames[] = {"biss-b", "biss-c", "ssi"};
constexpr const char* kKeys[] = {"crc = 0x43\ntimeout = 2\n",
                                 "crc = 0x43\nregisters = { 0x44 = [1, 2, 3, 4] }\n",
                                 "gray = true\ntimeout = 3\n"};

class DriverPairings : public testing::TestWithParam<std::tuple<unsigned, unsigned>> {
 protected:
  static std::string channel(unsigned number, unsigned protocol, unsigned bits) {
    return on_channel(number, "delay_ns = " + std::to_string(130 * number) + "\n") +
           device(kNames[protocol], bits,
                  std::string(kKeys[protocol]) + "flag_bits = 0\nsource = \"ramp\"\n");
  }
  static std::string scenario() {
    const auto [first, second] = GetParam();
    return channel(1, first, 25) + channel(2, second, 34);
  }
  static Config config() {
    const auto [first, second] = GetParam();
    Config config = empty_config(kProtocols[first], kProtocols[second]);
    add(config, 1, 25, first == 2 ? 0 : 0x43);
    add(config, 5, 34, second == 2 ? 0 : 0x43);
    config.slaves[0].gray = first == 2;
    config.slaves[4].gray = second == 2;
    return config;
  }
};

std::string pairing(const testing::TestParamInfo<std::tuple<unsigned, unsigned>>& test) {
  constexpr const char* kShort[] = {"BissB", "BissC", "Ssi"};
  return std::string(kShort[std::get<0>(test.param)]) + kShort[std::get<1>(test.param)];
}

INSTANTIATE_TEST_SUITE_P(All, DriverPairings,
                         testing::Combine(testing::Range(0U, 3U), testing::Range(0U, 3U)), pairing);

TEST_P(DriverPairings, FramesOfBoth_AreRight) {
  FaultyChip chip(scenario());
  ASSERT_TRUE(chip.device.configure(config()).ok());
  for (std::uint64_t i = 0; i < 100; ++i) {
    Frame frame;
    ASSERT_TRUE(chip.device.read_all(frame).ok());
    ASSERT_TRUE(frame.good(0x11));
    EXPECT_EQ(frame[1]->position, i);
    EXPECT_EQ(frame[5]->position, i);
  }
  ASSERT_TRUE(chip.device.automatic().start().ok());
  for (unsigned i = 0; i < 20; ++i) {
    Frame frame;
    ASSERT_TRUE(chip.device.automatic().next(frame).ok());
    ASSERT_TRUE(frame.good(0x11));
    EXPECT_EQ(frame[1]->position, frame[5]->position);
  }
}

// The same calls on either channel, whatever it speaks, one after the other; INIT between.
TEST_P(DriverPairings, RegistersOfBoth_AreReachedByTheSameCalls) {
  FaultyChip chip(scenario());
  ASSERT_TRUE(chip.device.configure(config()).ok());
  for (unsigned round = 0; round < 2; ++round) {
    for (const std::uint8_t channel : {std::uint8_t{1}, std::uint8_t{2}}) {
      const bool ssi = config().channels[channel - 1U].protocol == Protocol::kSsi;
      if (ssi) continue;
      std::array<std::uint8_t, 3> bytes{static_cast<std::uint8_t>(channel + round), 0x5A, 0xA5};
      ASSERT_TRUE(chip.device.control().write_registers({channel, 0}, 0x48, bytes).ok());
      std::array<std::uint8_t, 3> back{};
      ASSERT_TRUE(chip.device.control().read_registers({channel, 0}, 0x48, back).ok());
      EXPECT_EQ(back, bytes);
    }
    const mb4::Result<mb4::LineDelay> delay = chip.device.initialize();
    ASSERT_TRUE(delay.ok()) << mb4::to_string(delay.error());
    for (const unsigned channel : {0U, 1U}) {
      const bool measured = mb4::any_channel_is(config(), Protocol::kBissC) &&
                            config().channels[channel].protocol != Protocol::kSsi;
      EXPECT_EQ(delay->quarters[channel] != 0, measured);
    }
    Frame frame;
    ASSERT_TRUE(chip.device.read_all(frame).ok());
    EXPECT_TRUE(frame.good(0x11));
  }
}

}  // namespace
