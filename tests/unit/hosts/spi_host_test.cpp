// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Timing of the SPI host against items I201 to I209 (datasheet page 11), with pins that record
// their edges.
#include "sim/hosts/spi_host.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "mb4_regs.hpp"
#include "sim/masters/mb4/pins.hpp"

namespace mb4test {

using namespace mb4::sim;
namespace reg = mb4::regs;

namespace {

class RecordingPins final : public HostPins {
 public:
  struct Change {
    Time time;
    Pin pin;
    bool level;
  };
  RecordingPins() { levels_[index(Pin::kNcs)] = true; }
  Time now() const override { return now_; }
  void run_until(Time time) override { now_ = std::max(now_, time); }
  void set_pin(Pin pin, bool level) override {
    if (levels_[index(pin)] == level) return;
    levels_[index(pin)] = level;
    changes.push_back({now_, pin, level});
    // A slave that shifts back what it got, one byte later, changing on falling edges.
    if (pin == Pin::kAle && level) in_.push_back(levels_[index(Pin::kDb0)]);
    if (pin == Pin::kAle && !level && in_.size() >= 8) {
      levels_[index(Pin::kDb1)] = in_[in_.size() - 8];
    }
  }
  bool pin(Pin pin) const override { return levels_[index(pin)]; }
  std::vector<Time> times(Pin pin, bool level) const {
    std::vector<Time> result;
    for (const Change& change : changes) {
      if (change.pin == pin && change.level == level) result.push_back(change.time);
    }
    return result;
  }

  std::vector<Change> changes;

 private:
  static std::size_t index(Pin pin) { return static_cast<std::size_t>(pin); }

  std::array<bool, 32> levels_{};
  std::vector<bool> in_;
  Time now_ = 0;
};

class SpiFrequencies : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SpiFrequencies, TwoFrames_KeepEveryLimit) {
  RecordingPins pins;
  SpiHost host(pins, SpiTiming::for_frequency(GetParam()), kSpiPins);
  const std::array<std::uint8_t, 4> tx{reg::kSpiOpcodeReadRegisters, 0xA5, 0x00, 0xFF};
  host.transfer(tx, {});
  host.transfer(tx, {});
  const auto rise = pins.times(Pin::kAle, true);
  const auto fall = pins.times(Pin::kAle, false);
  const auto select = pins.times(Pin::kNcs, false);
  const auto deselect = pins.times(Pin::kNcs, true);
  ASSERT_EQ(rise.size(), 64U);
  ASSERT_EQ(fall.size(), 64U);
  EXPECT_GE(rise[0] - select[0], 10'000U);      // I201
  EXPECT_GE(deselect[0] - fall[31], 10'000U);   // I202
  EXPECT_GE(select[1] - deselect[0], 10'000U);  // I209
  const Time period = (kPsPerSecond + GetParam() - 1) / GetParam();
  for (std::size_t i = 0; i < 32; ++i) {
    EXPECT_GE(fall[i] - rise[i], 10'000U);  // I204
    if (i + 1 < 32) {
      EXPECT_GE(rise[i + 1] - fall[i], 10'000U);  // I203
    }
    if (i + 1 < 32 && i != 15) {
      EXPECT_EQ(rise[i + 1] - rise[i], period);
    }
  }
  EXPECT_GE(fall[15] - rise[15], 100'000U);  // I204 between address and data of 0x03
  for (const auto& change : pins.changes) {
    if (change.pin != Pin::kDb0) continue;
    for (const Time edge : rise) {  // I205, I206
      const Time apart = change.time > edge ? change.time - edge : edge - change.time;
      EXPECT_GE(apart, 7'500U);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Hz, SpiFrequencies,
                         testing::Values(1'000'000U, 10'000'000U, 12'345'678U, 50'000'000U));

TEST(SpiHost, OtherOpcodes_AreNotStretched) {
  for (const std::uint8_t opcode :
       {reg::kSpiOpcodeWriteRegisters, reg::kSpiOpcodeReadStatus, reg::kSpiOpcodeWriteInstruction,
        reg::kSpiOpcodeReadRegisters0, reg::kSpiOpcodeWriteRegisters0}) {
    RecordingPins pins;
    SpiHost host(pins, SpiTiming::for_frequency(50'000'000), kSpiPins);
    const std::array<std::uint8_t, 3> tx{opcode, 0x00, 0x00};
    host.transfer(tx, {});
    const auto rise = pins.times(Pin::kAle, true);
    EXPECT_EQ(rise[23] - rise[0], 23U * 20'000U);
  }
}

TEST(SpiHost, FullDuplex_SendsMsbFirstAndReturnsWhatCameBack) {
  RecordingPins pins;
  SpiHost host(pins, SpiTiming::for_frequency(10'000'000), kSpiPins);
  const std::array<std::uint8_t, 3> tx{0x81, 0x3C, 0x55};
  std::array<std::uint8_t, 3> rx{};
  host.transfer(tx, rx);
  EXPECT_EQ(rx[1], 0x81);
  EXPECT_EQ(rx[2], 0x3C);
}

TEST(SpiHost, ByteByByte_IsTheSameWaveform) {
  RecordingPins whole;
  RecordingPins steps;
  const std::array<std::uint8_t, 3> tx{reg::kSpiOpcodeReadRegisters, reg::kAddrRevision, 0x00};
  SpiHost(whole, SpiTiming::for_frequency(10'000'000), kSpiPins).transfer(tx, {});
  SpiHost host(steps, SpiTiming::for_frequency(10'000'000), kSpiPins);
  host.select(true);
  for (const std::uint8_t byte : tx) host.byte(byte);
  host.select(false);
  ASSERT_EQ(whole.changes.size(), steps.changes.size());
  for (std::size_t i = 0; i < whole.changes.size(); ++i) {
    EXPECT_EQ(whole.changes[i].time, steps.changes[i].time);
    EXPECT_EQ(whole.changes[i].pin, steps.changes[i].pin);
  }
}

// The host drives MOSI at the beginning of each byte, whatever other code has done to the pin.
TEST(SpiHost, MosiDrivenByOthersBetweenTwoBytes_NextByteIsTheHosts) {
  RecordingPins pins;
  SpiHost host(pins, SpiTiming::for_frequency(1'000'000), kSpiPins);
  host.select(true);
  host.byte(0x00);
  pins.set_pin(Pin::kDb0, true);
  host.byte(0x00);
  EXPECT_FALSE(pins.pin(Pin::kDb0));
  EXPECT_EQ(host.byte(0x00), 0x00);  // the byte before, shifted back
}

}  // namespace
}  // namespace mb4test
